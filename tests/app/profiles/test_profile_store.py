"""Profiles on the disk: written whole or not at all, the one before kept, and a faulty file never lost."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from app.layout.layout import LayoutError, load
from app.layout.views import Panel, View
from app.profiles.profile_store import MAX_BYTES, ProfileStore, file_name
from widgets import CATALOGUE

PATROL = replace(load("patrol", CATALOGUE), name="mine", views=(View("A", (Panel("Compass", "/pose"),)),))


@pytest.fixture
def store(tmp_path: Path) -> ProfileStore:
    return ProfileStore(tmp_path / "profiles", CATALOGUE)


def test_a_profile_is_found_again_as_it_was_saved(store: ProfileStore) -> None:
    assert store.names() == []
    store.save(PATROL)
    assert (store.names(), store.load("mine")) == (["mine"], PATROL)


def test_the_profile_before_is_kept_beside_the_new_one(store: ProfileStore) -> None:
    store.save(PATROL)
    before = store.path("mine").read_text()
    store.save(replace(PATROL, title="Other"))
    assert store.path("mine").with_suffix(".bak").read_text() == before
    assert store.load("mine").title == "Other"


def test_a_file_with_faults_is_put_aside_before_it_is_replaced_each_time(store: ProfileStore) -> None:
    for text in ("title = 3", "colour = 4"):
        store.save(PATROL)
        store.path("mine").write_text(text)
        store.save(PATROL)
    aside = sorted(path.read_text() for path in store.folder.glob("mine.faulty*"))
    assert aside == ["colour = 4", "title = 3"]
    assert store.names() == ["mine"]


def test_a_file_that_cannot_be_written_leaves_the_one_before(
    store: ProfileStore, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    store.save(PATROL)
    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OSError, match="No space"):
        store.save(replace(PATROL, title="Other"))
    assert store.load("mine") == PATROL
    assert sorted(path.name for path in store.folder.iterdir()) == ["mine.toml"]


@pytest.mark.parametrize("kind", ["pipe", "device", "folder"])
def test_what_is_no_ordinary_file_is_refused_at_once_in_a_sentence(
    store: ProfileStore, tmp_path: Path, kind: str
) -> None:
    path = Path("/dev/zero") if kind == "device" else tmp_path / "layout.toml"
    if kind == "pipe":
        os.mkfifo(path)  # whoever opens it waits for somebody who writes
    elif kind == "folder":
        path.mkdir()
    with pytest.raises(LayoutError, match="cannot be read: (it is no ordinary file|Is a directory)"):
        store.text(path)


@pytest.mark.parametrize(
    ("content", "sentence", "line"),
    [
        (b"title = \xff", "no UTF-8 text", 1),
        (b"\n\ntitle = \xff", "no UTF-8 text", 3),
        (b"#" * (MAX_BYTES + 1), "has more than 200 kB", 0),
        (b"title = 3", "title must be a text", 1),
    ],
)
def test_a_file_of_any_origin_is_refused_in_a_sentence(
    store: ProfileStore, tmp_path: Path, content: bytes, sentence: str, line: int
) -> None:
    path = tmp_path / "odd.toml"
    path.write_bytes(content)
    with pytest.raises(LayoutError, match=sentence) as caught:
        store.read("odd", store.text(path))
    assert caught.value.faults[0].line == line


def test_a_file_that_is_not_there_is_said(store: ProfileStore, tmp_path: Path) -> None:
    with pytest.raises(LayoutError, match=r"Layout gone cannot be read: No such file or directory\."):
        store.text(tmp_path / "gone.toml")


def test_a_file_is_named_after_the_title_and_never_leaves_its_folder(store: ProfileStore) -> None:
    assert file_name("../../etc/passwd") == "etc-passwd"
    assert file_name("Wärme & Rauch") == "w-rme-rauch"
    assert file_name("中") == "profile"
    store.save(PATROL)
    assert store.unused("Mine") == "mine-2"
