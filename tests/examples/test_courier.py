"""Deliveries between named offices, ordered by each protocol: coffee, then a parcel back."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from examples import courier
from examples.courier import NotDelivered, deliver, place
from examples.demo.robot import RobotProcess
from examples.demo.witness import Witness
from examples.protocols.ways import way_to
from tests.robotside.gateways.mqtt.broker import Broker

pytestmark = pytest.mark.slow

ROOM_3 = (2.0, 2.9)
RECEPTION = (-10.2, 1.6)
DOCK = (-11.6, -1.2, 0.0)
REACHED_DISTANCE = 0.5
"""A place counts as reached within this [m]."""


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.kill()


@pytest.fixture
def robot(tmp_path: Path, broker: Broker) -> Iterator[RobotProcess]:
    options = ("--robot", "sim:scout", "--world", "office", "--speed", "10", "--name", "Rex")
    gateways = ("--gateway", f"mqtt={broker.url}?role=drive")
    state = ("--state", str(tmp_path / "state"))
    with RobotProcess(*options, *gateways, *state, log=tmp_path / "robot.log") as process:
        yield process


def test_coffee_and_a_parcel_ordered_by_one_protocol_each_arrive(
    robot: RobotProcess, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(courier, "LOOK_PERIOD", 0.05)
    monkeypatch.setattr(courier, "DELIVERY_TIMEOUT", 300.0)
    witness = Witness(robot.url)
    try:
        for url, what, places, goal in (
            (robot.url, "coffee", ("reception", "room_3"), ROOM_3),
            (f"{broker.url}/pilothouse/Rex", "parcel", ("room_3", "reception"), RECEPTION),
        ):
            said: list[str] = []
            name = f"courier by {url.partition(':')[0]}"
            with way_to(url, name) as way:
                if goal is ROOM_3:
                    place(way, *DOCK)
                run = deliver(way, what, places, say=said.append, confirm=True)
            assert (run["state"], run["visited"], run["by"]) == ("SUCCEEDED", 2, name)
            assert run["reason"] == f"Delivered at {places[1]}."
            assert run["order"]["message"] == what
            assert witness.distance(*goal) <= REACHED_DISTANCE
            assert said[1:] == [f"It has been at {place}." for place in places]
    finally:
        witness.close()


def test_an_office_that_there_is_not_is_refused_by_each_protocol(robot: RobotProcess, broker: Broker) -> None:
    for url in (robot.url, f"{broker.url}/pilothouse/Rex"):
        with way_to(url, "courier") as way:
            place(way, *DOCK)
            with pytest.raises(NotDelivered, match="moon"):
                deliver(way, "coffee", ("reception", "moon"))
            way.call("/control/release", {})
