"""A robot starts on whatever a disk has made of its database."""

from __future__ import annotations

import random
import shutil
from collections import Counter
from pathlib import Path

import pytest

from bench.support.flips import NOW, WAYS, damage, damaged_copies, reopen, use
from robotside.records import Records
from robotside.records.database.files import DatabaseFiles
from robotside.station.station import Station
from tests.fakes import FakeRobot

COPIES = 48
"""Of 600 that `python -m bench flips` starts."""


@pytest.fixture
async def used(tmp_path: Path) -> Path:
    return (await use(tmp_path / "used")).parent


def live(records: Records) -> Station:
    station = Station(FakeRobot(), records, now=1000.0, clock=lambda: NOW.seconds, rng=random.Random(1))
    for number in range(3):
        station.step(1000.0 + number / 60)
    return station


@pytest.mark.slow
async def test_a_robot_starts_on_every_damaged_database_and_has_what_its_backup_had(
    used: Path, tmp_path: Path
) -> None:
    mended: Counter[str] = Counter()
    for seed, way, state in damaged_copies(used, tmp_path / "copies", range(COPIES)):
        with reopen(state) as records:
            live(records)
            if any("was put in its place" in problem for problem in records.problems):
                mended[way] += 1
                assert len(records.places.all()) == 40, (seed, way)
                assert records.stopped_by == "Anna", (seed, way)
                assert list(state.glob("records-damaged-*.sqlite3")), (seed, way)
    assert set(mended) >= set(WAYS) - {"bit", "byte"}, "of one bit or byte not every copy need be mended"


@pytest.mark.slow
async def test_a_robot_starts_when_its_backups_are_damaged_too(used: Path, tmp_path: Path) -> None:
    outcomes = set()
    for seed, _, state in damaged_copies(used, tmp_path / "copies", range(8, 16)):
        path = state / "records.sqlite3"
        path.write_bytes(b"SQLite format 3\0" + b"\xff" * 5000)
        for backup in DatabaseFiles(path).backups():
            damage(backup, seed)
        with reopen(state) as records:
            live(records)
            outcomes.add(records.problems[0].rpartition("; ")[2])
    assert "no backup of it can be read, so it starts empty." in outcomes
    assert any("was put in its place" in outcome for outcome in outcomes)


async def test_a_robot_starts_empty_when_all_backups_are_damaged_and_says_so(used: Path) -> None:
    path = used / "records.sqlite3"
    backup = DatabaseFiles(path).backups()[-1]
    shutil.copy(backup, backup.with_name("records-20000101-000000-000000.sqlite3"))
    for file in (path, *DatabaseFiles(path).backups()):
        file.write_bytes(b"no database" * 100)
    with reopen(used) as records:
        live(records)
        (said,) = records.problems
        assert said.endswith("; no backup of it can be read, so it starts empty.")
        assert said in [event.text for event in records._ledger.rows("events").values()]
        assert records.places.all() == []
    with reopen(used) as records:
        assert records.problems == []


async def test_text_that_is_no_text_is_damage(used: Path) -> None:
    """The check of SQLite itself tells of it in words that Python cannot read."""
    path = used / "records.sqlite3"
    content = path.read_bytes()
    path.write_bytes(content.replace(b"CREATE TABLE places", b"CREATE TABLE pl\xc3\xffes"))
    with reopen(used) as records:
        assert "was put in its place" in records.problems[0]


async def test_a_version_byte_that_would_let_nothing_be_written_is_damage(used: Path) -> None:
    path = used / "records.sqlite3"
    content = bytearray(path.read_bytes())
    content[18] = 7
    path.write_bytes(content)
    with reopen(used) as records:
        assert "its header names no known format" in records.problems[0]
        assert records.trouble == ""


async def test_damage_costs_no_older_backup(used: Path) -> None:
    path = used / "records.sqlite3"
    before = [backup.name for backup in DatabaseFiles(path).backups()]
    for seed in range(8):
        damage(path, seed + 2)
        with reopen(used):
            pass
    assert {backup.name for backup in DatabaseFiles(path).backups()} >= set(before)
