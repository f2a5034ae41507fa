"""The records over restarts, on every kind of database."""

from __future__ import annotations

import asyncio
import math
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import msgspec
import pytest
from sqlalchemy import text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import OperationalError

from bridge.codec import to_json
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event, Mission, Place, ScheduledTask, TaskOrder, TaskRun, Waypoint
from bridge.msgs.std_msgs import Time
from robotside.records import Job, Records
from robotside.records.database import schema
from robotside.records.database.storage import engine_of
from robotside.records.opening import SKIPPED_AFTER_CRASH, CannotOpen, open_records
from tests.robotside.records.conftest import Open

OFFICE = Place(
    name="Büro 12 🚪",
    kind="office",
    floor="1",
    x=4.25,
    y=-2.0,
    yaw=math.pi,
    tag="04:a2",
    note="Klopfen!",
    height=-1.25,
)
ORDER = TaskOrder(task="go_to", goals=[Waypoint(1.0, 2.0)], speed=0.4)
MIGRATIONS = Path(schema.__file__).with_name("migrations")
NOW = Time(1_795_279_047, 123_456_789)


async def fill(records: Records) -> Job:
    with records.together() as job:
        records.places.set(OFFICE)
        records.places.set(Place(name="Nowhere"))
        records.missions.set(Mission(stamp=NOW, waypoints=[Waypoint(1.5, 2.5)], laps=3, name="Night"))
        records.set_setting("follow_link", "off")
        records.schedule.set(ScheduledTask(order=ORDER, every=60.0, next=NOW))
        records.queue.add(ORDER)
        records.queue.add(msgspec.structs.replace(ORDER, task="hold"))
        run = records.runs.begin(TaskRun(order=ORDER, started=NOW, state="RUNNING", by="Anna"), '{"lap": 2}')
        records.runs.note(
            msgspec.structs.replace(run, distance=12.5, visited=3, code="way_blocked", actor_id="a"),
            '{"lap": 3}',
        )
        event = Event(
            stamp=NOW,
            level="warn",
            kind="task",
            text="'Hé' \\ %s :x",
            position=Point(1.0, 2.0, math.nan),
            code="task_paused",
            actor_id="tablet-7",
            parameters=[KeyValue("name", 'Zoë "7"'), KeyValue("task", "patrol")],
        )
        records.events.add(event, lambda _: None)
        records.note_stop("Anna")
    assert await job.kept(10.0) == ""
    return job


def everything(records: Records) -> bytes:
    parts: list[msgspec.Struct] = [
        *records.places.all(),
        records.missions.current,
        *records.schedule.all(),
        records.queue.current,
        *records.runs.before(),
        *records.events.since(0, ""),
    ]
    under_way = records.runs.under_way
    words = f"{records.setting('follow_link')} {records.stopped_by} {under_way and under_way.course}"
    return b"\n".join([*map(to_json, parts), words.encode()])  # type: ignore[arg-type]


async def test_everything_is_there_again_after_a_restart(start: Open) -> None:
    records = start()
    assert records.problems == []
    await fill(records)
    before, identity = everything(records), records.events.identity
    records.close()
    again = start()
    assert (everything(again), again.events.identity, again.problems) == (before, identity, [])
    assert math.isnan(again.events.since(0, "")[0].position.z)
    assert math.isnan(again.places.all()[1].yaw)
    again.close()


async def test_what_was_changed_and_deleted_is_so_after_a_restart(start: Open) -> None:
    records = start()
    await fill(records)
    with records.together() as job:
        office = records.places.all()[0]
        records.places.set(msgspec.structs.replace(office, x=9.0))
        records.places.delete(2)
        records.queue.pop()
        records.note_stop("")
        records.events.acknowledge([1], "Anna", NOW, lambda _: None)
    assert await job.kept(10.0) == ""
    before = everything(records)
    records.close()
    again = start()
    assert everything(again) == before
    assert [place.x for place in again.places.all()] == [9.0]
    assert again.places.set(Place(name="Third")).id == 3
    again.close()


async def test_after_a_crash_the_numbers_of_events_leave_room_for_those_that_were_told_and_not_kept(
    start: Open, url: str | None
) -> None:
    if url:
        pytest.skip("The same for all.")
    records = start()
    await fill(records)
    records.close()
    records = start()
    records._close()  # no orderly end
    again = start()
    told: list[Event] = []
    with again.together() as job:
        again.events.add(Event(text="new"), told.append)
        again.runs.begin(TaskRun())
    await job.kept(10.0)
    assert [event.id for event in told] == [2 + SKIPPED_AFTER_CRASH]
    again.close()


async def test_a_commit_is_on_the_disk_and_readers_do_not_wait_for_writers(tmp_path: Path) -> None:
    engine = engine_of(make_url(f"sqlite:///{tmp_path / 'x.sqlite3'}"))
    with engine.connect() as connection:
        assert connection.execute(text("PRAGMA synchronous")).scalar() == 2
        assert connection.execute(text("PRAGMA journal_mode")).scalar() == "wal"
    engine.dispose()


async def test_a_second_robot_side_is_refused_until_the_first_one_ends(start: Open, url: str | None) -> None:
    first = start()
    with pytest.raises(CannotOpen, match="Another robot side keeps its records in "):
        start()
    first.close()
    start().close()


async def test_a_second_robot_side_is_told_that_the_records_are_taken(tmp_path: Path) -> None:
    first = open_records(tmp_path, None, print)
    with pytest.raises(
        CannotOpen, match="Another robot side keeps its records in .*; end it or name another --state."
    ):
        open_records(tmp_path, None, print, patience=0.1)
    first.close()
    open_records(tmp_path, None, print, patience=0.1).close()


async def test_a_file_by_url_is_kept_as_one_beside_the_state_is(tmp_path: Path) -> None:
    url = f"sqlite:///{tmp_path / 'elsewhere' / 'mine.db'}"
    open_records(tmp_path / "state", url, print).close()
    first = open_records(tmp_path / "state", url, print)
    with pytest.raises(CannotOpen, match="Another robot side"):
        open_records(tmp_path / "other", url, print, patience=0.0)
    first.close()
    assert (tmp_path / "elsewhere" / "mine.db").exists()


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("oracle://x", "There is no database 'oracle://x'; allowed are sqlite:///FILE and postgresql"),
        ("nonsense", "There is no database 'nonsense'; allowed are"),
        ("bad:://robot:secret@host/x", "There is no database 'bad:://...@host/x'; allowed are"),
        (
            "sqlite://",
            "The database 'sqlite://' would be gone with the process; name a file, as sqlite:///FILE.",
        ),
        ("postgresql+psycopg://robot:secret@127.0.0.1:1/x", "The database server cannot be reached"),
    ],
)
def test_a_url_that_is_none_is_one_sentence_without_its_password(tmp_path: Path, url: str, said: str) -> None:
    with pytest.raises(CannotOpen) as refusal:
        open_records(tmp_path, url, print)
    assert str(refusal.value).startswith(said)
    assert "secret" not in str(refusal.value)


def test_what_an_older_program_left_is_taken_over_once(tmp_path: Path) -> None:
    mission = Mission(NOW, [Waypoint(1.0, 2.0)], [Waypoint(0.0, 0.0)], "random")
    (tmp_path / "mission.json").write_bytes(to_json(mission))
    (tmp_path / "left.json").write_text('{"stopped_by": "Anna", "task": "Patrol"}')
    records = open_records(tmp_path, None, print)
    assert to_json(records.missions.current) == to_json(mission)
    assert (records.stopped_by, records.problems) == ("Anna", [])
    records.close()
    assert sorted(path.name for path in tmp_path.glob("*.json*")) == ["left.json.taken", "mission.json.taken"]
    (tmp_path / "mission.json").write_bytes(to_json(Mission()))
    records = open_records(tmp_path, None, print)
    assert to_json(records.missions.current) == to_json(mission)
    records.close()


def test_what_an_older_program_left_broken_is_said_and_counts_as_stopped(tmp_path: Path) -> None:
    (tmp_path / "mission.json").write_text('{"waypoints": [{"x": "left"}]')
    (tmp_path / "left.json").write_text("{")
    records = open_records(tmp_path, None, print)
    assert records.problems[0].startswith("The stored mission was damaged and is left as mission.json.taken:")
    assert (records.missions.current, records.stopped_by) == (Mission(), "somebody")
    records.close()


def test_rows_that_cannot_be_read_are_left_out_and_said(tmp_path: Path) -> None:
    open_records(tmp_path, None, print).close()
    with closing(sqlite3.connect(tmp_path / "records.sqlite3")) as database:
        database.execute("INSERT INTO missions VALUES (7, 'x', '{')")
        database.commit()
    records = open_records(tmp_path, None, print)
    assert records.problems == ["1 of the missions in the database cannot be read (7) and are left out."]
    records.close()


async def test_a_server_that_was_away_is_found_again(start: Open, url: str | None) -> None:
    if not url or "postgresql" not in url:
        pytest.skip("Of a server that can be told to cut its connections.")
    records = start()
    await fill(records)
    engine = engine_of(make_url(url))
    with engine.connect() as connection:
        others = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid != pg_backend_pid() AND backend_type = 'client backend'"
        connection.execute(text(others))
    engine.dispose()
    with records.together() as job:
        records.places.set(Place(name="Lab"))
    assert await job.kept(10.0) == ""
    records.close()
    again = start()
    assert len(again.places.all()) == 3
    again.close()


NEXT = """
revision, down_revision, branch_labels, depends_on = "0006", "0005", None, None

def upgrade():
    from alembic import op
    op.execute("CREATE TABLE later (id INTEGER)")
"""


async def test_before_a_migration_the_database_is_copied_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    state, program = tmp_path / "state", tmp_path / "program"
    records = open_records(state, None, asyncio.get_running_loop().call_soon_threadsafe)
    await fill(records)
    records.close()
    shutil.rmtree(state / "backups", ignore_errors=True)
    shutil.copytree(MIGRATIONS, program / "migrations")
    (program / "migrations" / "versions" / "v0006_next.py").write_text(NEXT)
    monkeypatch.setattr(schema, "__file__", str(program / "schema.py"))
    open_records(state, None, print).close()
    first = min((state / "backups").iterdir())
    with (
        closing(sqlite3.connect(first)) as before,
        closing(sqlite3.connect(state / "records.sqlite3")) as now,
    ):
        assert before.execute("SELECT version_num FROM alembic_version").fetchall() == [("0005",)]
        assert before.execute("SELECT count(*) FROM places").fetchall() == [(2,)]
        assert now.execute("SELECT version_num FROM alembic_version").fetchall() == [("0006",)]


async def test_of_two_who_write_the_second_finds_it_locked_before_it_has_looked_at_anything(
    tmp_path: Path,
) -> None:
    engine = engine_of(make_url(f"sqlite:///{tmp_path / 'x.sqlite3'}"), patience=0.0)
    with engine.begin(), pytest.raises(OperationalError, match="locked"), engine.begin():
        pytest.fail("it began")
    engine.dispose()
