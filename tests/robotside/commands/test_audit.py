"""The audit log on the command line."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from robotside.__main__ import main
from robotside.records import Records
from robotside.records.audit import Entry
from robotside.records.opening import open_records


def used(state: Path) -> Records:
    records = open_records(state, None, lambda *_: None)
    for number in range(3):
        records.audit.record(Entry("call /stop", name=f"Anna {number}"), 1000.0 + number)
    return records


def test_all_rows_are_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    used(tmp_path).close()
    assert main(["audit", "--state", str(tmp_path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("number,time,")
    assert [line.split(",")[3] for line in lines[1:]] == ["Anna 0", "Anna 1", "Anna 2"]


def test_they_are_written_to_a_file_and_checked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    used(tmp_path).close()
    file = tmp_path / "audit.csv"
    assert main(["audit", "--state", str(tmp_path), "--csv", str(file), "--verify"]) == 0
    said = capsys.readouterr().out
    assert "3 rows are in" in said
    assert "All 3 rows are as they were written; the last is 3 with the hash" in said
    assert len(file.read_text().splitlines()) == 4


def test_it_works_beside_a_robot_that_is_served(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    used(tmp_path).close()
    records = open_records(tmp_path, None, lambda *_: None)
    assert main(["audit", "--state", str(tmp_path), "--verify"]) == 0
    records.close()


def test_a_row_that_was_changed_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    used(tmp_path).close()
    with closing(sqlite3.connect(tmp_path / "records.sqlite3")) as database:
        database.execute("UPDATE audit SET name = 'Ben' WHERE id = 2")
        database.commit()
    assert main(["audit", "--state", str(tmp_path), "--verify"]) == 1
    assert capsys.readouterr().out == "Row 2 is missing or not as it was written.\n"


def test_an_empty_log_is_said_to_be_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    open_records(tmp_path, None, lambda *_: None).close()
    assert main(["audit", "--state", str(tmp_path), "--verify"]) == 0
    assert capsys.readouterr().out == "The audit log is empty.\n"


@pytest.mark.parametrize("content", [None, b"no database" * 100, b""])
def test_what_cannot_be_read_is_one_sentence(
    tmp_path: Path, content: bytes | None, capsys: pytest.CaptureFixture[str]
) -> None:
    if content is not None:
        (tmp_path / "records.sqlite3").write_bytes(content)
    assert main(["audit", "--state", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith("robotside: The")
    assert "/audit.csv" in said
    assert said.count("\n") == 1


def test_a_file_that_cannot_be_written_is_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    used(tmp_path).close()
    assert main(["audit", "--state", str(tmp_path), "--csv", "/nowhere/audit.csv"]) == 2
    assert "'/nowhere/audit.csv' cannot be written: No such file or directory." in capsys.readouterr().err
