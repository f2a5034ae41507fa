"""Who did what is kept, in order, and nothing waits for it."""

from __future__ import annotations

import asyncio
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Place
from robotside.records import Records, audit
from robotside.records.audit import Entry
from robotside.records.database.audit_rows import PRUNED, read_file
from robotside.records.opening import open_records
from tests.robotside.records.conftest import Open
from tests.robotside.records.test_damage import until

STOP = Entry("call /stop", "done", "id-7", "Anna", "drive", "rosbridge", "192.0.2.1")


def file_of(state: Path) -> Path:
    return state / "records.sqlite3"


def opened(state: Path) -> Records:
    return open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe, patience=0.2)


async def test_rows_are_chained_over_restarts(start: Open) -> None:
    for number in range(3):
        records = start()
        records.audit.record(STOP, 1000.0 + number)
        records.close()
    records = start()
    rows = records.audit.rows()
    assert [(row.id, row.stamp) for row in rows] == [(1, 1000 * 10**9), (2, 1001 * 10**9), (3, 1002 * 10**9)]
    assert (rows[0].name, rows[0].operation, rows[0].address) == ("Anna", "call /stop", "192.0.2.1")
    assert records.audit.verify() is None
    records.close()


async def test_a_row_is_in_the_transaction_of_what_was_done(tmp_path: Path) -> None:
    records = opened(tmp_path)
    with records.together() as job:
        records.places.set(Place(name="Office 12"))
        records.audit.record(STOP, 1000.0)
    tables = [put.table for put in job.puts]
    assert tables.count("audit") == 1
    assert await job.kept(10.0) == ""
    with closing(sqlite3.connect(file_of(tmp_path))) as database:
        assert database.execute("SELECT operation FROM audit").fetchall() == [("call /stop",)]
    records.close()


async def test_what_somebody_changes_in_the_file_shows(tmp_path: Path) -> None:
    records = opened(tmp_path)
    for number in range(5):
        records.audit.record(STOP, 1000.0 + number)
    records.close()
    with closing(sqlite3.connect(file_of(tmp_path))) as database:
        database.execute("DELETE FROM audit WHERE id = 3")
        database.commit()
    records = opened(tmp_path)
    assert records.audit.verify() == 3
    records.close()


async def test_rows_that_were_cut_off_at_the_end_while_it_runs_show(tmp_path: Path) -> None:
    records = opened(tmp_path)
    for number in range(5):
        records.audit.record(STOP, 1000.0 + number)
    await until(lambda: not records._ledger.rows("audit"))
    with closing(sqlite3.connect(file_of(tmp_path))) as database:
        database.execute("DELETE FROM audit WHERE id > 3")
        database.commit()
    assert records.audit.verify() == 4
    records.close()


async def test_the_oldest_are_let_go_of_and_the_chain_still_holds(
    start: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(audit, "MAX_ROWS", 30)
    monkeypatch.setattr(audit, "PRUNE_PERIOD", 10)
    records = start()
    for number in range(100):
        records.audit.record(STOP, 1000.0 + number)
    records.close()
    records = start()
    rows = records.audit.rows()
    assert (rows[0].operation, rows[0].name, rows[0].address) == (PRUNED, "", "")
    assert [row.id for row in rows] == list(range(70, 101))
    assert records.audit.verify() is None
    records.audit.record(STOP, 2000.0)
    records.close()
    records = start()
    assert records.audit.rows()[-1].id == 101
    assert records.audit.verify() is None
    records.close()


async def test_an_erased_name_is_nowhere_in_the_file_and_the_chain_holds(tmp_path: Path) -> None:
    records = opened(tmp_path)
    ben = Entry("auth", "done", "id-8", "Benedikt", "drive", "http", "192.0.2.9")
    records.audit.record(STOP, 1000.0)
    records.audit.record(ben, 1001.0)
    await until(lambda: not records._ledger.rows("audit"))
    records.audit.record(ben, 1002.0)
    records.audit.erase("Benedikt")
    records.close()
    assert b"Benedikt" not in file_of(tmp_path).read_bytes()
    records = opened(tmp_path)
    assert [(row.name, row.person_id) for row in records.audit.rows()] == [
        ("Anna", "id-7"),
        ("erased", "id-8"),
        ("erased", "id-8"),
    ]
    assert records.audit.verify() is None
    records.close()


async def test_rows_that_wait_for_a_disk_are_bounded_and_what_is_missing_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.records.database.writer.RETRY_PERIOD", 0.05)
    monkeypatch.setattr(audit, "MAX_UNWRITTEN", 20)
    records = open_records(tmp_path, None, asyncio.get_running_loop().call_soon_threadsafe, patience=0.02)
    with closing(sqlite3.connect(file_of(tmp_path))) as other:
        other.execute("BEGIN IMMEDIATE")
        for number in range(50):
            records.audit.record(STOP, 1000.0 + number)
        await until(lambda: records.trouble)
        assert len(records._ledger.rows("audit")) == 20
    await until(lambda: not records._ledger.rows("audit"))
    records.audit.record(STOP, 2000.0)
    records.close()
    records = opened(tmp_path)
    assert [row.outcome for row in records.audit.rows()][-2:] == ["30 rows could not be kept", "done"]
    assert records.audit.verify() is None
    records.close()


async def test_a_log_that_fails_is_said_once_and_costs_nothing(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    records = Records.in_memory()

    def fail(*_: object) -> None:
        raise RuntimeError("broken")

    monkeypatch.setattr(audit, "chained", fail)
    for _ in range(3):
        records.audit.record(STOP, 1000.0)
    assert len(caplog.records) == 1


async def test_a_database_that_breaks_in_use_keeps_its_audit_log(tmp_path: Path) -> None:
    records = opened(tmp_path)
    records.audit.record(STOP, 1000.0)
    await until(lambda: not records._ledger.rows("audit"))
    moved = file_of(tmp_path).rename(tmp_path / "elsewhere")
    file_of(tmp_path).write_bytes(moved.read_bytes())
    records.audit.record(STOP, 1001.0)
    await until(lambda: list(tmp_path.glob("records-damaged-*")))
    records.close()
    assert [row.stamp for row in read_file(file_of(tmp_path))][-1] == 1001 * 10**9


async def test_that_a_backup_was_restored_is_in_the_audit_log(tmp_path: Path) -> None:
    opened(tmp_path).close()
    file_of(tmp_path).write_bytes(b"no database" * 100)
    records = opened(tmp_path)
    (row,) = records.audit.rows()
    assert row.operation == "records"
    assert row.outcome.startswith("The database was damaged")
    records.close()
