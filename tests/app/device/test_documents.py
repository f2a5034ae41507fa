"""Where a person finds the files of this app, and how one is opened."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.device import documents as module
from app.device.documents import documents, open_file


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
    return tmp_path


def test_it_is_a_folder_of_its_own_among_the_documents(home: Path) -> None:
    (home / "Documents").mkdir()
    assert documents(home / "own") == home / "Documents" / "Pilothouse"


def test_where_there_are_no_documents_it_is_the_apps_own_folder(home: Path) -> None:
    assert documents(home / "own") == home / "own"


@pytest.mark.parametrize(
    ("line", "wanted"),
    [
        ('XDG_DOCUMENTS_DIR="$HOME/Dokumente"', "Dokumente/Pilothouse"),
        ('XDG_DOCUMENTS_DIR="$HOME/"', "Documents/Pilothouse"),
        ("XDG_DOCUMENTS_DIR=nonsense", "Documents/Pilothouse"),
        ('XDG_MUSIC_DIR="$HOME/Dokumente"', "Documents/Pilothouse"),
    ],
)
def test_the_desktops_own_name_for_documents_counts(home: Path, line: str, wanted: str) -> None:
    for name in ("Dokumente", "Documents", ".config"):
        (home / name).mkdir()
    (home / ".config" / "user-dirs.dirs").write_text(f"# made by the desktop\n{line}\n")
    assert documents(home / "own") == home / wanted


def test_a_file_is_opened_by_the_desktops_own_opener(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    ran: list[list[str]] = []

    class Opener:
        def __init__(self, command: list[str], **_: object) -> None:
            ran.append(command)

        def wait(self) -> int:
            return 0

    monkeypatch.setattr(module.subprocess, "Popen", Opener)
    monkeypatch.setattr(module.sys, "platform", "linux")
    open_file(tmp_path / "a b.mcap")
    assert ran == [["xdg-open", str(tmp_path / "a b.mcap")]]


def test_a_desktop_without_an_opener_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(module.sys, "platform", "linux")
    with pytest.raises(FileNotFoundError):
        open_file(tmp_path / "a.mcap")
