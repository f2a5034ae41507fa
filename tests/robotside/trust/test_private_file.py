"""Private files: whole or not at all, and for nobody else."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from robotside.trust.private_file import write_private


def test_a_file_is_for_its_owner_alone_whatever_was_there(tmp_path: Path) -> None:
    file = tmp_path / "new" / "file"
    write_private(file, b"one")
    file.chmod(0o666)
    write_private(file, b"two")
    assert (file.read_bytes(), stat.S_IMODE(file.stat().st_mode)) == (b"two", 0o600)
    assert list(file.parent.iterdir()) == [file]


def test_what_cannot_be_written_whole_leaves_the_file_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "file"
    write_private(file, b"one")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        write_private(file, b"two")
    assert file.read_bytes() == b"one"
    assert list(tmp_path.iterdir()) == [file]


def test_what_a_crash_left_half_written_is_written_over(tmp_path: Path) -> None:
    file = tmp_path / "file"
    (tmp_path / ".file.new").write_bytes(b"half")
    write_private(file, b"one")
    assert file.read_bytes() == b"one"
