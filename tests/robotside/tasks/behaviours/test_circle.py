"""Round an intruder: from every side that can be reached, never nearer than it may, and honest about the rest."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event, Waypoint
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal
from robotside.tasks.behaviours.circle import CLEARANCE, SIDES, Side, in_order
from robotside.tasks.behaviours.situation import Seen
from tests.fakes import Box, FakeRobot, Pillar
from tests.robotside.scene import Scene

CORNER = Box(-9.0, -5.5, -6.5, -4.0)
"""On the map, so that the hall looks like itself from one place only."""


class Round:
    """A patrol that finds an intruder; the robot's true place is looked at all the time."""

    def __init__(self, state: Path, at: tuple[float, float], *boxes: Box) -> None:
        self.scene = Scene(
            FakeRobot(start=(-4.0, 0.0, 0.0), boxes=(CORNER, *boxes), pillars=[Pillar(*at)]), state
        )
        self.scene.run(4.0)
        self.at, self.nearest = at, math.inf
        self.faced: list[float] = []
        """Directions from which it stood and looked at it [rad]."""
        self.scene.set(Waypoint(-4.0, 0.5), on_intruder="circle")
        self.scene.start()
        self.scene.station.autonomy.situation.intruders.append(Seen(1, *at))
        self._go_round()

    def _go_round(self) -> None:
        for _ in range(3000):
            self.scene.run(0.1)
            x, y, yaw = self.scene.robot.pose
            self.nearest = min(self.nearest, math.hypot(x - self.at[0], y - self.at[1]))
            bearing = math.atan2(self.at[1] - y, self.at[0] - x)
            if abs(math.remainder(bearing - yaw, math.tau)) < 0.1:
                self.faced.append(math.remainder(bearing + math.pi, math.tau))
            if self.told:
                return

    @property
    def told(self) -> list[Event]:
        return [
            msg for _, msg in self.scene.said if isinstance(msg, Event) and msg.code == Code.INTRUDER_CIRCLED
        ]

    def looked_from(self, side: str) -> bool:
        angle = SIDES.index(side) * math.tau / len(SIDES)
        return any(abs(math.remainder(faced - angle, math.tau)) < 0.15 for faced in self.faced)


def values(event: Event) -> dict[str, str]:
    return {pair.key: pair.value for pair in event.parameters}


@pytest.mark.slow
def test_in_the_open_it_is_seen_from_all_sides_and_never_approached(tmp_path: Path) -> None:
    run = Round(tmp_path, (3.0, 0.0))
    assert [event.text for event in run.told] == ["Intruder 1 was seen from all 6 sides; going on."]
    assert all(map(run.looked_from, SIDES))
    assert run.nearest - run.scene.robot.info.radius >= CLEARANCE
    run.scene.station.close()


@pytest.mark.slow
def test_at_a_wall_the_sides_that_it_could_not_see_are_named_and_the_others_are_seen(tmp_path: Path) -> None:
    run = Round(tmp_path, (3.0, 4.6))
    said = run.told[0]
    assert said.text == "Intruder 1 was seen from 4 of 6 sides; not: north-east, north-west."
    assert values(said) == {"id": "1", "sides": "4", "count": "6", "missing": "north-east, north-west"}
    assert [side for side in SIDES if run.looked_from(side)] == ["east", "west", "south-west", "south-east"]
    assert run.nearest - run.scene.robot.info.radius >= CLEARANCE
    run.scene.station.close()


@pytest.mark.slow
def test_from_behind_a_wall_nothing_is_seen(tmp_path: Path) -> None:
    run = Round(tmp_path, (3.0, 0.0), Box(1.9, -1.5, 2.1, 1.5))
    assert "west" in values(run.told[0])["missing"].split(", ")
    assert run.nearest - run.scene.robot.info.radius >= CLEARANCE
    run.scene.station.close()


def side(number: int) -> Side:
    angle = number * math.tau / len(SIDES)
    return Side(number, Goal("It", 2.0 * math.cos(angle), 2.0 * math.sin(angle)))


@pytest.mark.parametrize(
    ("numbers", "start", "order"),
    [
        ([0, 1, 2, 3, 4, 5], (5.0, 0.3), [0, 1, 2, 3, 4, 5]),
        ([0, 1, 2, 3], (5.0, 0.3), [0, 1, 2, 3]),
        ([0, 1, 2, 3], (-5.0, 0.3), [3, 2, 1, 0]),
        ([0, 1, 4, 5], (5.0, -4.0), [4, 5, 0, 1]),
        ([], (0.0, 5.0), []),
    ],
)
def test_the_sides_are_visited_one_beside_the_other(
    numbers: list[int], start: tuple[float, float], order: list[int]
) -> None:
    found = in_order([side(number) for number in numbers], Pose2(*start, 0.0), 2.0)
    assert [one.number for one in found] == order
