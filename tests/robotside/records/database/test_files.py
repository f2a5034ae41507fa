"""The file and its backups."""

from __future__ import annotations

import math
import os
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from robotside.records.database.files import MAX_DAMAGED, DatabaseFiles
from robotside.records.opening import open_records

DAY = 86_400.0


def database(path: Path, text: str = "x") -> Path:
    with closing(sqlite3.connect(path)) as made:
        made.execute("CREATE TABLE IF NOT EXISTS t (x)")
        made.execute("INSERT INTO t VALUES (?)", (text,))
        made.commit()
    return path


def content(path: Path) -> list[str]:
    with closing(sqlite3.connect(path)) as kept:
        return [row[0] for row in kept.execute("SELECT x FROM t")]


def test_the_newest_backups_and_one_of_each_day_are_kept(tmp_path: Path) -> None:
    now = [1_795_000_000.0]
    files = DatabaseFiles(database(tmp_path / "records.sqlite3"), lambda: now[0], backups=7)
    for _ in range(40):
        now[0] += DAY / 4
        files.back_up()
    kept = [backup.name for backup in files.backups()]
    assert len(kept) == 7
    assert len({name[:16] for name in kept}) in (4, 5), (
        "four are of today and yesterday, three of the days before"
    )
    assert content(files.backups()[-1]) == ["x"]
    assert not list(files.backups_in.glob("*.new*"))


def test_a_backup_is_whole_while_somebody_writes(tmp_path: Path) -> None:
    path = database(tmp_path / "records.sqlite3")
    with closing(sqlite3.connect(path)) as writer:
        writer.execute("PRAGMA journal_mode=WAL")
        writer.execute("INSERT INTO t VALUES ('kept')")
        writer.commit()
        writer.execute("INSERT INTO t VALUES ('on its way')")
        backup = DatabaseFiles(path).back_up()
    assert backup is not None
    assert content(backup) == ["x", "kept"]
    assert [each.name for each in backup.parent.iterdir()] == [backup.name]


def test_a_backup_that_cannot_be_made_leaves_nothing_half(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    files = DatabaseFiles(database(tmp_path / "records.sqlite3"))
    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(OSError, match="No space left"):
        files.back_up()
    assert list(files.backups_in.iterdir()) == []


def test_of_broken_files_the_newest_are_kept(tmp_path: Path) -> None:
    now = [1_795_000_000.0]
    files = DatabaseFiles(tmp_path / "records.sqlite3", lambda: now[0])
    for number in range(MAX_DAMAGED + 2):
        now[0] += 1.0
        files.path.write_text(f"{number}")
        files.set_aside()
    kept = sorted(tmp_path.glob("records-damaged-*.sqlite3"))
    assert [path.read_text() for path in kept] == ["2", "3", "4"]


def test_a_whole_file_has_no_fault_and_neither_has_none(tmp_path: Path) -> None:
    files = DatabaseFiles(tmp_path / "records.sqlite3")
    assert files.fault() == ""
    database(files.path)
    assert files.fault() == ""
    files.path.write_bytes(b"no database" * 100)
    assert files.fault() == "file is not a database"


def test_who_wants_no_backups_has_none(tmp_path: Path) -> None:
    files = DatabaseFiles(database(tmp_path / "records.sqlite3"), backups=0)
    assert files.back_up() is None
    assert files.backups() == []


def test_how_old_the_newest_backup_is_tells_when_the_next_one_is_due(tmp_path: Path) -> None:
    now = [0.0]
    files = DatabaseFiles(database(tmp_path / "records.sqlite3"), lambda: now[0])
    assert files.backup_age() == math.inf
    backup = files.back_up()
    assert backup is not None
    os.utime(backup, (1000.0, 1000.0))
    now[0] = 1600.0
    assert files.backup_age() == 600.0
    now[0] = 900.0
    assert files.backup_age() == math.inf


def modes(directory: Path) -> dict[str, int]:
    return {path.name: path.stat().st_mode & 0o777 for path in [directory, *directory.rglob("*")]}


def test_only_their_owner_reads_the_files_whatever_the_umask(tmp_path: Path) -> None:
    before = os.umask(0)
    try:
        records = open_records(tmp_path / "state", None, lambda *_: None)
        DatabaseFiles(tmp_path / "state" / "records.sqlite3").back_up()
        found = modes(tmp_path / "state")
        records.close()
    finally:
        os.umask(before)
    assert {"records.sqlite3", "records.sqlite3-wal", "records.sqlite3-shm", "records.sqlite3.lock"} <= set(
        found
    )
    assert {name: mode for name, mode in found.items() if mode != 0o600} == {"state": 0o700, "backups": 0o700}


def test_what_older_programs_let_everybody_read_is_tightened_at_the_start(tmp_path: Path) -> None:
    state = tmp_path / "state"
    open_records(state, None, lambda *_: None).close()
    files = DatabaseFiles(state / "records.sqlite3")
    backup = files.back_up()
    aside = database(state / "records-damaged-20260101-000000-000000.sqlite3")
    assert backup is not None
    for path in (files.path, backup, aside):
        path.chmod(0o644)
    open_records(state, None, lambda *_: None).close()
    assert {path.stat().st_mode & 0o777 for path in (files.path, backup, aside)} == {0o600}


def test_a_state_directory_that_was_there_stays_as_it_is(tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    open_records(tmp_path, None, lambda *_: None).close()
    assert tmp_path.stat().st_mode & 0o777 == 0o755
