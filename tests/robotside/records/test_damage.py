"""Databases that are broken, locked, read-only, or on a full disk."""

from __future__ import annotations

import asyncio
import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from sqlalchemy import event

from bridge.msgs.pilothouse_msgs import Event, Place
from robotside.records import Records
from robotside.records.database import storage as storage_module
from robotside.records.database.files import DatabaseFiles
from robotside.records.database.sqlite_store import SKIPPED_AFTER_RESTORE
from robotside.records.opening import CannotOpen, open_records

OFFICE, LAB = Place(name="Office 12", x=4.0), Place(name="Lab", x=8.0)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """What could not be written is tried again soon."""
    monkeypatch.setattr("robotside.records.database.writer.RETRY_PERIOD", 0.05)


async def opened(state: Path, patience: float = 0.2) -> Records:
    return open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe, patience=patience)


async def keep(records: Records, place: Place) -> str:
    with records.together() as job:
        records.places.set(place)
    return await job.kept(10.0)


async def until(condition: Callable[[], object]) -> None:
    async with asyncio.timeout(60):
        while not condition():  # noqa: ASYNC110 - another thread brings it about
            await asyncio.sleep(0.01)


def spoil(path: Path) -> None:
    """Write over the middle of every page but the first ones."""
    content = bytearray(path.read_bytes())
    content[4096 + 100 :] = b"\x5a" * (len(content) - 4096 - 100)
    path.write_bytes(content)


def damaged(state: Path) -> list[Path]:
    return list(state.glob("records-damaged-*.sqlite3"))


async def with_backup(state: Path) -> int:
    """Make a backup with the office, keep the laboratory after it; returns the last event's number."""
    records = await opened(state)
    assert await keep(records, OFFICE) == ""
    records.events.add(Event(text="before"), lambda _: None)
    await until(lambda: DatabaseFiles(state / "records.sqlite3").backups())
    records.close()
    DatabaseFiles(state / "records.sqlite3").back_up()
    records = await opened(state)
    assert await keep(records, LAB) == ""
    records.close()
    return max(event.id for event in records.events.since(0, ""))


async def test_a_broken_database_is_set_aside_and_its_newest_backup_put_in_its_place(tmp_path: Path) -> None:
    last = await with_backup(tmp_path)
    path = tmp_path / "records.sqlite3"
    newest = DatabaseFiles(path).backups()[-1]
    spoil(path)
    broken = path.read_bytes()
    records = await opened(tmp_path)
    (problem,) = records.problems
    (aside,) = damaged(tmp_path)
    assert problem.startswith("The database was damaged (")
    assert problem.endswith(
        f"is set aside as {aside.name}; the backup {newest.name} was put in its place, what was stored after it is lost."
    )
    assert aside.read_bytes() == broken
    assert records.places.named("Office 12") is not None
    told: list[Event] = []
    with records.together() as job:
        records.events.add(Event(text="after"), told.append)
        records.places.set(Place(name="New"))
    assert await job.kept(10.0) == ""
    assert told[0].id > last + SKIPPED_AFTER_RESTORE - 10, (
        "numbers that somebody may have heard are not used again"
    )
    records.close()


@pytest.mark.parametrize("content", [b"This is no database.", b"SQLite format 3\0" + b"\xff" * 5000])
async def test_without_a_backup_it_starts_empty_and_says_so(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "records.sqlite3").write_bytes(content)
    records = await opened(tmp_path)
    assert "there was no backup, so it starts empty." in records.problems[0]
    assert await keep(records, OFFICE) == ""
    records.close()
    records = await opened(tmp_path)
    assert (records.problems, len(records.places.all())) == ([], 1)
    records.close()


@pytest.mark.parametrize(("left", "why"), [(b"", "it is empty"), (None, "it is gone")])
async def test_what_a_power_cut_left_empty_or_nothing_of_starts_from_its_backup_and_says_so(
    tmp_path: Path, left: bytes | None, why: str
) -> None:
    await with_backup(tmp_path)
    path = tmp_path / "records.sqlite3"
    path.unlink()
    if left is not None:
        path.write_bytes(left)
    records = await opened(tmp_path)
    (problem,) = records.problems
    assert problem.startswith(f"The database was damaged ({why}) and ")
    assert problem.endswith(
        f"; the backup {DatabaseFiles(path).backups()[-1].name} was put in its place, what was stored after it is lost."
    )
    assert records.places.named("Office 12") is not None
    records.close()


@pytest.mark.parametrize("how", ["gone", "cut", "replaced", "log"])
async def test_a_file_that_is_taken_away_while_it_is_used_is_noticed_before_anything_is_acknowledged(
    tmp_path: Path, how: str
) -> None:
    records = await opened(tmp_path)
    troubles: list[str] = []
    records.on_trouble(troubles.append)
    assert await keep(records, OFFICE) == ""
    path = tmp_path / "records.sqlite3"
    if how == "cut":
        path.write_bytes(path.read_bytes()[:100])
    elif how == "replaced":
        path.rename(tmp_path / "elsewhere")
        path.write_bytes((tmp_path / "elsewhere").read_bytes())
    else:
        path.with_name(f"{path.name}{'-wal' if how == 'log' else ''}").unlink()
    assert await keep(records, LAB) == ""
    await until(lambda: any("a new one was written, nothing is lost." in said for said in troubles))
    left = shutil.copytree(tmp_path, tmp_path / "as a kill leaves it")
    again = await opened(left)
    assert [place.name for place in again.places.all()] == ["Office 12", "Lab"]
    again.close()
    records.close()


async def test_a_broken_backup_is_passed_over_for_an_older_one(tmp_path: Path) -> None:
    await with_backup(tmp_path)
    spoil(DatabaseFiles(tmp_path / "records.sqlite3").backups()[-1])
    spoil(tmp_path / "records.sqlite3")
    records = await opened(tmp_path)
    assert DatabaseFiles(tmp_path / "records.sqlite3").backups()[-2].name in records.problems[0]
    records.close()


async def test_a_database_that_breaks_while_it_is_used_is_written_anew_and_nothing_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    records = await opened(tmp_path)
    troubles: list[str] = []
    records.on_trouble(troubles.append)
    assert await keep(records, OFFICE) == ""
    real, broken = storage_module.write, [True]

    def write(*arguments: object) -> None:
        if broken.pop() if broken else False:
            raise sqlite3.DatabaseError("database disk image is malformed")
        real(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(storage_module, "write", lambda *a: _as_sqlalchemy(write, *a))
    assert await keep(records, LAB) == ""
    await until(lambda: troubles)
    (aside,) = damaged(tmp_path)
    assert troubles == [
        f"The database was damaged and is set aside as {aside.name}; a new one was written, nothing is lost."
    ]
    records.close()
    records = await opened(tmp_path)
    assert [place.name for place in records.places.all()] == ["Office 12", "Lab"]
    records.close()


def _as_sqlalchemy(call: object, *arguments: object) -> None:
    from sqlalchemy.exc import DatabaseError

    try:
        call(*arguments)  # type: ignore[operator]
    except sqlite3.DatabaseError as error:
        raise DatabaseError("INSERT", None, error) from error


async def test_a_locked_database_refuses_what_is_asked_keeps_what_happened_and_goes_on_when_it_is_free(
    tmp_path: Path,
) -> None:
    records = await opened(tmp_path, patience=0.05)
    troubles, heard = list[str](), list[Event]()
    records.on_trouble(troubles.append)
    with closing(sqlite3.connect(tmp_path / "records.sqlite3")) as other:
        other.execute("BEGIN IMMEDIATE")
        said = "The database is locked by another program: nothing was stored. End that one."
        assert await keep(records, OFFICE) == said
        records.events.add(Event(text="something happened"), heard.append)
        await until(lambda: heard)
        assert (records.places.all(), troubles) == ([], [said])
    await until(lambda: len(troubles) > 1)
    assert troubles[1] == ""
    assert await keep(records, OFFICE) == ""
    records.close()
    records = await opened(tmp_path)
    assert [event.text for event in records.events.since(0, "")] == ["something happened"]
    records.close()


async def test_a_full_disk_is_a_sentence_and_what_was_kept_stays(tmp_path: Path) -> None:
    records = await opened(tmp_path)
    assert await keep(records, OFFICE) == ""
    pages = [0]

    def limit(connection: sqlite3.Connection) -> None:
        connection.execute(f"PRAGMA max_page_count={pages[0] or 1_000_000}")

    engine = records._close.__self__._store._storage.engine  # type: ignore[attr-defined]
    event.listen(engine, "begin", lambda connection: limit(connection.connection.driver_connection))
    pages[0] = 1
    said = "The disk is full: nothing was stored. Make room on the robot's computer."
    for number in range(200):
        problem = await keep(records, Place(name=f"{number}", note="x" * 300))
        if problem:
            break
    assert problem == said
    assert records.places.named(f"{number}") is None
    pages[0] = 0
    assert await keep(records, LAB) == ""
    records.close()
    records = await opened(tmp_path)
    assert len(records.places.all()) == number + 2
    records.close()


async def test_a_database_that_is_locked_at_the_start_is_a_sentence(tmp_path: Path) -> None:
    (await opened(tmp_path)).close()
    with closing(sqlite3.connect(tmp_path / "records.sqlite3")) as other:
        other.execute("PRAGMA locking_mode=EXCLUSIVE")
        other.execute("BEGIN EXCLUSIVE")
        with pytest.raises(CannotOpen, match="The database is locked by another program"):
            await opened(tmp_path)
    (await opened(tmp_path)).close()


async def test_a_directory_that_is_a_file_is_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "state").write_text("")
    with pytest.raises(CannotOpen, match="Nothing can be stored in '.*': file exists; --state names another"):
        await opened(tmp_path / "state")


async def test_what_waits_at_the_end_is_written(tmp_path: Path) -> None:
    records = await opened(tmp_path)
    for number in range(100):
        records.places.set(Place(name=f"{number}"))
    records.close()
    records = await opened(tmp_path)
    assert len(records.places.all()) == 100
    records.close()


async def test_a_disk_that_is_full_at_the_start_costs_no_robot_and_is_said_until_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    records = await opened(tmp_path)
    assert await keep(records, OFFICE) == ""
    records.close()
    real, full = storage_module.write, [True]

    def write(*arguments: object) -> None:
        if full:
            raise sqlite3.OperationalError("database or disk is full")
        real(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(storage_module, "write", lambda *a: _as_sqlalchemy(write, *a))
    records = await opened(tmp_path)
    troubles: list[str] = []
    records.on_trouble(troubles.append)
    said = "The disk is full: nothing was stored. Make room on the robot's computer."
    assert records.problems == [said]
    assert records.places.named("Office 12") is not None
    assert await keep(records, LAB) == said
    full.clear()
    await until(lambda: troubles == [""])
    assert await keep(records, LAB) == ""
    records.close()
    with closing(sqlite3.connect(tmp_path / "records.sqlite3")) as database:
        assert database.execute("SELECT value FROM facts WHERE name = 'clean'").fetchone() == ("1",)


async def test_what_could_not_be_written_is_written_at_the_end_if_it_can_be_then(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.records.database.writer.RETRY_PERIOD", 60.0)
    records = await opened(tmp_path, patience=0.05)
    with closing(sqlite3.connect(tmp_path / "records.sqlite3")) as other:
        other.execute("BEGIN IMMEDIATE")
        heard: list[Event] = []
        records.events.add(Event(text="happened"), heard.append)
        await until(lambda: heard)
    records.close()
    records = await opened(tmp_path)
    assert [event.text for event in records.events.since(0, "")] == ["happened"]
    records.close()
