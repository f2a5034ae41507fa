"""Android's share sheet, as Android's own classes would be called."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from app.device.sharing import FOLDER, AndroidSharing, sharing


class JavaException(Exception):
    pass


class Intent:
    ACTION_SEND, EXTRA_STREAM, FLAG_GRANT_READ_URI_PERMISSION = "send", "stream", 1

    def __init__(self, action: str) -> None:
        self.action, self.kind, self.flags, self.extras = action, "", 0, {}

    def setType(self, kind: str) -> None:
        self.kind = kind

    def putExtra(self, name: str, value: Any) -> None:
        self.extras[name] = value

    def addFlags(self, flags: int) -> None:
        self.flags |= flags

    @staticmethod
    def createChooser(send: Intent, title: str) -> tuple[str, Intent, str]:
        return "chooser", send, title


class Phone:
    """Has the module `jnius` of a phone; what is put into Download lies in a folder."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: Path, version: int) -> None:
        self.folder, self.begun, self.deleted, self.lax, self.refuses = folder, [], [], [], False
        self.rows: list[dict[str, str]] = []
        values = SimpleNamespace
        resolver = SimpleNamespace(
            insert=self._insert,
            openFileDescriptor=self._open,
            delete=lambda *given: self.deleted.append(given),
        )
        activity = SimpleNamespace(
            getContentResolver=lambda: resolver,
            getExternalFilesDir=lambda _: SimpleNamespace(getAbsolutePath=lambda: str(folder)),
            startActivity=self.begun.append,
        )
        classes: dict[str, Any] = {
            "org.kivy.android.PythonActivity": values(mActivity=activity),
            "android.os.Build$VERSION": values(SDK_INT=version),
            "android.content.ContentValues": self._values,
            "android.provider.MediaStore$Downloads": values(EXTERNAL_CONTENT_URI="downloads"),
            "android.os.StrictMode$VmPolicy$Builder": lambda: values(build=lambda: "lax"),
            "android.os.StrictMode": values(setVmPolicy=self.lax.append),
            "android.net.Uri": values(fromFile=lambda file: f"file:{file}"),
            "java.io.File": str,
            "android.content.Intent": Intent,
            "java.lang.String": str,
        }
        jnius = ModuleType("jnius")
        jnius.__dict__.update(
            autoclass=classes.__getitem__, cast=lambda _, value: value, JavaException=JavaException
        )
        monkeypatch.setitem(sys.modules, "jnius", jnius)

    def _values(self) -> Any:
        row: dict[str, str] = {}
        self.rows.append(row)
        return SimpleNamespace(put=row.__setitem__)

    def _insert(self, _: str, __: Any) -> str:
        if self.refuses:
            raise JavaException("no room")
        return "content:7"

    def _open(self, _: str, how: str) -> Any:
        assert how == "w"
        number = os.open(self.folder / self.rows[-1]["_display_name"], os.O_WRONLY | os.O_CREAT)
        return SimpleNamespace(detachFd=lambda: number)


@pytest.fixture
def zip_(tmp_path: Path) -> Path:
    path = tmp_path / "own" / "study_1.zip"
    path.parent.mkdir()
    path.write_bytes(b"PK")
    return path


def test_a_copy_in_download_is_handed_to_whoever_is_chosen_for_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, zip_: Path
) -> None:
    phone = Phone(monkeypatch, tmp_path, version=34)
    AndroidSharing().share(zip_)
    assert (tmp_path / "study_1.zip").read_bytes() == b"PK"
    assert phone.rows == [
        {"_display_name": "study_1.zip", "mime_type": "application/zip", "relative_path": FOLDER}
    ]
    ((how, send, title),) = phone.begun
    assert (how, title, send.action, send.kind, send.flags) == (
        "chooser", "study_1.zip", "send", "application/zip", 1,
    )  # fmt: skip
    assert send.extras == {"stream": "content:7"}
    assert phone.lax == []


def test_before_android_10_it_is_a_file_on_the_shared_storage(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, zip_: Path
) -> None:
    phone = Phone(monkeypatch, tmp_path, version=28)
    out = AndroidSharing()
    out.share(zip_)
    ((_, send, _),) = phone.begun
    assert send.extras == {"stream": f"file:{tmp_path / 'study_1.zip'}"}
    assert phone.lax == ["lax"]
    out.forget()
    assert not (tmp_path / "study_1.zip").exists()
    assert zip_.exists()


def test_its_own_copies_in_download_are_deleted(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    phone = Phone(monkeypatch, tmp_path, version=34)
    AndroidSharing().forget()
    assert phone.deleted == [
        ("downloads", "relative_path=? AND mime_type=?", ["Download/Pilothouse/", "application/zip"])
    ]


def test_what_android_refuses_is_an_error_in_words(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, zip_: Path
) -> None:
    phone = Phone(monkeypatch, tmp_path, version=34)
    phone.refuses = True
    with pytest.raises(OSError, match="Android does not share it: no room"):
        AndroidSharing().share(zip_)
    assert phone.begun == []


def test_on_a_computer_the_folder_is_looked_into() -> None:
    assert sharing() is None
