"""Messages as rows that every kind of database can store."""

from __future__ import annotations

import math

import pytest
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.engine import Dialect
from sqlalchemy.schema import CreateTable

from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event, Place, TaskRun
from robotside.records.database.rows import TABLES
from robotside.records.database.tables import Base


def test_what_is_no_number_is_stored_as_nothing_and_comes_back_as_nan() -> None:
    assert TABLES["places"].to_row(Place())["yaw"] is None
    row = TABLES["events"].to_row(Event(position=Point(1.0, math.inf, math.nan)))
    assert (row["x"], row["y"], row["z"]) == (1.0, None, None)
    event = TABLES["events"].from_row(TABLES["events"].model(id=1, **row))
    assert math.isnan(event.position.y)


def test_the_character_that_postgresql_cannot_store_is_left_out() -> None:
    assert TABLES["runs"].to_row(TaskRun(reason="a\0b"))["reason"] == "ab"
    assert "\0" not in TABLES["missions"].to_row(TABLES["missions"].from_row(mission("a\0b")))["content"]


def mission(name: str) -> object:
    from robotside.records.database.tables import MissionRow

    return MissionRow(id=1, name=name, content='{"name": "a\\u0000b"}')


@pytest.mark.parametrize(
    "dialect",
    [sqlite.dialect(), postgresql.dialect()],  # type: ignore[no-untyped-call]
    ids=lambda dialect: dialect.name,
)
def test_every_table_can_be_said_to_every_kind_of_database(dialect: Dialect) -> None:
    said = [str(CreateTable(table).compile(dialect=dialect)) for table in Base.metadata.sorted_tables]
    assert len(said) == len(TABLES) + 1, "those that are read, and the audit log"
