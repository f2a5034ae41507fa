"""A person's name leaves a robot, its backups included."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Event
from robotside.__main__ import main
from robotside.records.audit import Entry
from robotside.records.database.audit_rows import first_bad, read_file
from robotside.records.database.files import DatabaseFiles
from robotside.records.opening import open_records


def used(state: Path) -> DatabaseFiles:
    records = open_records(state, None, lambda *_: None)
    records.events.add(Event(text="STOP pressed by Benedikt."), lambda _: None)
    records.audit.record(Entry("call /stop", name="Benedikt", address="192.0.2.9"), 1000.0)
    records.audit.record(Entry("stop", name="Benedikt (not proven)", address="192.0.2.9"), 1001.0)
    records.close()
    files = DatabaseFiles(state / "records.sqlite3")
    files.back_up()
    shutil.copy(files.path, state / "records-damaged-20260101-000000-000000.sqlite3")
    return files


def test_an_erased_name_is_in_no_file_of_the_state_directory(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = used(tmp_path)
    assert main(["erase", "Benedikt", "--state", str(tmp_path)]) == 0
    said = capsys.readouterr().out
    assert said.startswith("'Benedikt' is erased; ")
    for path in tmp_path.rglob("*"):
        assert path.is_dir() or b"Benedikt" not in path.read_bytes(), path
    assert len(files.backups()) == 1
    assert first_bad(read_file(files.path)) is None
    assert b"pressed by erased." in files.path.read_bytes()


def test_a_robot_that_is_served_is_ended_first(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    used(tmp_path)
    records = open_records(tmp_path, None, lambda *_: None)
    assert main(["erase", "Benedikt", "--state", str(tmp_path)]) == 2
    assert "Another robot side keeps its records in" in capsys.readouterr().err
    records.close()


@pytest.mark.parametrize("name", ["", " "])
def test_nobody_has_no_name(tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    used(tmp_path)
    assert main(["erase", name, "--state", str(tmp_path)]) == 2
    assert "is empty" in capsys.readouterr().err


def test_where_there_is_no_database_none_is_made(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["erase", "Ben", "--state", str(tmp_path)]) == 2
    assert "There is no database in" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
