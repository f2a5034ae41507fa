"""Every topic that a simulated robot publishes or offers, with all that it can carry, stands in the table of topics."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.core.topics import topic
from bridge.msgs import Msg
from bridge.server.client_list import CLIENT_TOPICS
from robotside.door.station_door import StationDoor
from robotside.station.station import Station
from scripts.topic_table import BEGIN, END
from sim.catalogue import catalogue
from sim.payloads import laden
from sim.robot import make, model_of
from tests.fakes import FakeClient
from tests.robotside.scene import records_at

DOCUMENT = Path(__file__).parents[3] / "docs" / "bridge.md"
ROBOTS = {entry["name"]: entry for entry in catalogue()["robots"]}


def documented() -> dict[str, str]:
    """The type of each line of the table in the documentation, by its name."""
    table = DOCUMENT.read_text().partition(BEGIN)[2].partition(END)[0]
    rows = re.findall(r"^\| `(/[^`]+)` \| (\S+) \|", table, flags=re.MULTILINE)
    assert len(rows) > 50
    return dict(rows)


def line_of(name: str, table: dict[str, str]) -> str | None:
    """The documented type of a topic; `NAME` in the table stands for the name of a part."""
    if name in table:
        return table[name]
    families = [line for line in table if "NAME" in line]
    return next(
        (table[line] for line in families if re.fullmatch(line.replace("NAME", r"[A-Za-z]\w*"), name)), None
    )


def loads() -> Iterator[tuple[str, tuple[str, ...]]]:
    """Each robot with all its payloads, or with one at a time where it cannot lift all of them."""
    for name, entry in ROBOTS.items():
        every = tuple(entry["payloads"])
        try:
            laden(model_of(name), every)
        except ValueError:
            yield from ((name, (one,)) for one in every)
        else:
            yield name, every


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "payloads"),
    list(loads()),
    ids=lambda one: one if isinstance(one, str) else f"{len(one)} payloads",
)
def test_all_that_a_robot_tells_stands_in_the_table_with_its_type(
    name: str, payloads: tuple[str, ...], tmp_path: Path
) -> None:
    robot = make(name, ROBOTS[name]["home"], payloads=payloads)
    station = Station(robot, records_at(tmp_path), now=1000.0, clock=lambda: 1000.0, rng=random.Random(1))
    door = StationDoor(station)
    told: dict[str, Msg] = {}
    station.bus.subscribe(None, told.__setitem__)
    for offered in door.topics:
        door.subscribe(FakeClient(), offered, lambda *_: None)
    for step in range(1, 40):
        station.step(1000.0 + step / 20)
    station.close()
    table = documented()
    offered = {one.name: one.type for one in door.topics.values() if door.offers(one.name)}
    published = {each: type(msg) for each, msg in told.items()}
    assert len(published) > 20
    assert any(each.startswith("/temperature/") for each in published)
    assert {each: line_of(each, table) for each in (*offered, *published)} == {
        each: kind.MSGTYPE for each, kind in (offered | published).items()
    }
    assert all(topic(each).type is kind for each, kind in (offered | published).items())


def test_what_the_server_adds_stands_in_the_table_too() -> None:
    table = documented()
    assert {one.name: table.get(one.name) for one in CLIENT_TOPICS} == {
        one.name: one.type.MSGTYPE for one in CLIENT_TOPICS
    }


def test_what_no_robot_has_is_in_no_line() -> None:
    for name in ("/temperature", "/temperature/", "/temperature/a/b", "/camera/image", "/nothing"):
        with pytest.raises(KeyError):
            topic(name)
