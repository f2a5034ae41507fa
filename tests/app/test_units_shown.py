"""Units are for people: whatever the operator chose, the robot is told the same, in SI."""

from __future__ import annotations

from typing import Any

import pytest

from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.core.quantities import SYSTEMS, quantities


@pytest.fixture(autouse=True)
def metric_afterwards() -> Any:
    yield
    quantities.system = "metric"


def pushed(glass: Glass) -> tuple[float, ...]:
    """What a finger half way up the stick commands, with how fast the slider lets it."""
    glass.stage.frames(4)
    drive = glass.app.screens["drive"]
    stick = drive.stick
    touch = glass.hold(stick)
    touch.touch_move(stick.center_x + stick.width / 8, stick.center_y + stick.height / 4)
    glass.stage.frames(3)
    twist = stick.twist
    touch.touch_up()
    glass.stage.frames(3)
    return twist.linear.x, twist.linear.y, twist.angular.z, drive.speed.maximum_speed


def test_no_choice_of_units_changes_what_a_stick_commands(driving: Glass, robot: FakeRobot) -> None:
    told = {}
    for system in SYSTEMS:
        quantities.system = system
        told[system] = pushed(driving)
    assert told["metric"][0] > 0.05
    assert set(told.values()) == {told["metric"]}
    assert driving.app.screens["drive"].speed.maximum_speed == told["metric"][3]


def test_no_choice_of_units_changes_where_a_point_is(driving: Glass, robot: FakeRobot) -> None:
    driving.app.show("mission")
    mission = driving.app.screens["mission"]
    mission.mode = "points"
    for number, system in enumerate(SYSTEMS, 1):
        quantities.system = system
        mission.map.dispatch("on_add", 3.25, 4.5)
        driving.stage.frames(2)
        assert len(driving.app.session.mission.draft.points) == number
    points = driving.app.session.mission.draft.points
    assert {tuple(point[:2]) for point in points} == {(3.25, 4.5)}
