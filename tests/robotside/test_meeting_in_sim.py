"""Robots that meet in one world give way to each other."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import StartTaskRequest, TaskOrder, Waypoint
from robotside.door.station_door import StationDoor
from robotside.station.station import Station
from sim.robot import SimRobot, make_several
from sim.world.tables import Start
from tests.fakes import FakeClient
from tests.robotside.scene import records_at

pytestmark = pytest.mark.slow

TICK = 1 / 30


class Meeting:
    """Two robots that want past each other, each with a robot side of its own."""

    def __init__(self, robots: list[SimRobot], state: Path) -> None:
        self.robots, self.now = robots, 1000.0
        self.anna = FakeClient("anna", self.now)
        self.stations = [
            Station(
                robot,
                records_at(state / str(number)),
                now=self.now,
                clock=lambda: self.now,
                rng=random.Random(1),
            )
            for number, robot in enumerate(robots)
        ]
        self.closest = math.inf

    def run(self, seconds: float) -> None:
        end = self.now + seconds
        while self.now < end:
            self.now += TICK
            self.anna.last_heard = self.now
            for station in self.stations:
                station.step(self.now)

    def send(self, number: int, goal: Waypoint) -> None:
        order = StartTaskRequest(order=TaskOrder(task="go_to", goals=[goal]))
        answer = StationDoor(self.stations[number]).call(self.anna, "/task/start", order)
        assert answer.success, answer.message  # type: ignore[union-attr]

    def finish(self, limit: float) -> None:
        end = self.now + limit
        while self.now < end and any(station.autonomy.engine.active for station in self.stations):
            self.run(0.25)

    @property
    def states(self) -> list[str]:
        return [station.autonomy.engine.status.state for station in self.stations]

    @property
    def bumps(self) -> list[int]:
        return [vehicle.bumper.bumps for vehicle in self.robots[0].simulation.vehicles]


@pytest.mark.parametrize(
    ("names", "world", "places"),
    [
        (("patrol", "scout"), "office", ((-3.0, 0.0), (6.0, 0.0))),
        (("scout", "scout"), "office", ((-3.0, 0.0), (6.0, 0.0))),
        (("patrol", "patrol"), "office", ((-3.0, 0.0), (6.0, 0.0))),
        (("commander", "patrol"), "parking_lot", ((-12.0, 7.5), (6.0, 7.0))),
    ],
)
def test_two_that_come_towards_each_other_pass_without_contact(
    names: tuple[str, str], world: str, places: tuple[tuple[float, float], ...], tmp_path: Path
) -> None:
    (ax, ay), (bx, by) = places
    starts = [Start(x=ax, y=ay, yaw=0.0), Start(x=bx, y=by, yaw=180.0)]
    robots = make_several(list(zip(names, starts, strict=True)), world, seed=2, camera=False)
    meeting = Meeting(robots, tmp_path)
    meeting.run(3.5)
    meeting.send(0, Waypoint(bx, by))
    meeting.send(1, Waypoint(ax, ay))
    meeting.finish(60.0)
    states, bumps = meeting.states, meeting.bumps
    for station in meeting.stations:
        station.close()
    assert bumps == [0, 0]
    assert states == ["SUCCEEDED", "SUCCEEDED"]
