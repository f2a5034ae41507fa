"""Android's share sheet, as Android's own classes would be called."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from app.device.sharing import FOLDER, AndroidSharing, sharing
from tests.app.device.java import Handle, JavaException, install, java

SEND = "android.content.Intent.ACTION_SEND"
STREAM = "android.content.Intent.EXTRA_STREAM"
INTENT = "android.content.Intent"


class Intent:
    """What was put into one."""

    def __init__(self, action: str) -> None:
        self.action, self.kind, self.flags, self.extras = action, "", 0, {}
        self.java = java(
            INTENT,
            setType=lambda kind: setattr(self, "kind", kind),
            putExtra=self.extras.__setitem__,
            addFlags=lambda flags: setattr(self, "flags", self.flags | flags),
        )


class Phone:
    """Has the module `jnius` of a phone; what is put into Download lies in a folder."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, folder: Path, version: int) -> None:
        self.folder, self.begun, self.deleted, self.lax, self.refuses = folder, [], [], [], False
        self.rows: list[dict[str, str]] = []
        self.intents: list[Intent] = []
        resolver = java(
            "android.content.ContentResolver",
            insert=self._insert,
            openFileDescriptor=self._open,
            delete=lambda *given: self.deleted.append(given),
        )
        activity = java(
            "android.app.Activity",
            getContentResolver=resolver,
            getExternalFilesDir=java("java.io.File", getAbsolutePath=str(folder)),
            startActivity=self.begun.append,
        )
        chosen = lambda send, title: ("chooser", self.intents[-1], title)  # noqa: E731 - as Android's maker of them
        install(
            monkeypatch,
            java("org.kivy.android.PythonActivity", mActivity=activity),
            java("android.os.Build$VERSION", SDK_INT=version),
            java("android.content.ContentValues", new=self._values),
            java("android.provider.MediaStore$Downloads", EXTERNAL_CONTENT_URI=Handle("downloads")),
            java(
                "android.os.StrictMode$VmPolicy$Builder",
                new=lambda: java("android.os.StrictMode$VmPolicy$Builder", build=Handle("lax")),
            ),
            java("android.os.StrictMode", setVmPolicy=self.lax.append),
            java("android.net.Uri", fromFile=lambda file: Handle(f"file:{file}")),
            java("java.io.File", new=Handle),
            java(INTENT, new=self._intent, createChooser=chosen, FLAG_GRANT_READ_URI_PERMISSION=1),
            java("java.lang.String", new=Handle),
        )

    def _intent(self, action: str) -> Any:
        self.intents.append(Intent(action))
        return self.intents[-1].java

    def _values(self) -> Any:
        row: dict[str, str] = {}
        self.rows.append(row)
        return java("android.content.ContentValues", put=row.__setitem__)

    def _insert(self, _: str, __: Any) -> str:
        if self.refuses:
            raise JavaException("no room")
        return Handle("content:7")

    def _open(self, _: str, how: str) -> Any:
        assert how == "w"
        number = os.open(self.folder / self.rows[-1]["_display_name"], os.O_WRONLY | os.O_CREAT)
        return java("android.os.ParcelFileDescriptor", detachFd=number)


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
        "chooser", "study_1.zip", SEND, "application/zip", 1,
    )  # fmt: skip
    assert send.extras == {STREAM: "content:7"}
    assert phone.lax == []


def test_before_android_10_it_is_a_file_on_the_shared_storage(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, zip_: Path
) -> None:
    phone = Phone(monkeypatch, tmp_path, version=28)
    out = AndroidSharing()
    out.share(zip_)
    ((_, send, _),) = phone.begun
    assert send.extras == {STREAM: f"file:{tmp_path / 'study_1.zip'}"}
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
