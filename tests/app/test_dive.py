"""A swimmer before the app: its screen comes by itself, its hands make one order, its actions reach the robot."""

from __future__ import annotations

from typing import Any

import pytest

from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo, StartTaskRequest
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

AQUA = RobotInfo(
    name="Aqua-1",
    kind="hexapod",
    model="aqua",
    max_speed=0.7,
    max_yaw_rate=0.8,
    max_climb=0.3,
    max_tilt=0.5,
    cameras=["front", "rear"],
    tasks=["hold", "surface", "go_home"],
    manoeuvres=["twist", "course", "tilt", "hover", "surface", "rest"],
)
TAB, ENTER = 9, 13
"""Key codes."""


@pytest.fixture
def diving(driving: Glass, robot: FakeRobot) -> Any:
    robot.publish("/robot/info", AQUA)
    driving.until(lambda: hasattr(driving.app.screens["drive"], "column"), "not in three columns")
    screen = driving.app.screens["drive"]
    driving.until(lambda: screen.column.actions and screen.column.actions[0].able, "no actions")
    return screen


def test_a_swimmer_has_three_columns_with_what_it_knows(diving: Any) -> None:
    assert [action.name for action in diving.column.actions] == [
        *("task.surface", "task.hold", "lights", "record", "camera", "snapshot", "task.go_home")
    ]
    assert diving.instruments.places["motion"][0].under_water


def test_its_hands_make_one_order_of_all_that_they_say(driving: Glass, robot: FakeRobot, diving: Any) -> None:
    driving.until(lambda: diving.stick.state == "live", "no stick")
    stick, lift, tilt = (one for one, _ in diving.sticks)
    said: list[Any] = []
    diving.session.link.drive = said.append
    stick.lean(1.0, 0.0)
    lift.lean(-1.0, 0.0)
    tilt.lean(0.0, -1.0)
    order = said[-1]
    assert isinstance(order, Manoeuvre)
    assert (order.kind, order.speed, order.twist.linear.z) == ("tilt", 0.7, -0.3)
    assert order.roll == pytest.approx(0.5)
    diving.rest()
    assert not any(part for part in (stick.forward, lift.forward, tilt.left))


def test_two_switches_reach_every_action_and_the_robot_hears_of_it(
    driving: Glass, robot: FakeRobot, diving: Any
) -> None:
    driving.stage.key(ENTER)
    assert not any(name == "/task/start" for name, _ in robot.asked)
    assert diving.column.current == "task.surface"
    driving.stage.key(TAB)
    assert diving.column.current == "task.hold"
    driving.stage.run_for(0.6)
    driving.stage.key(ENTER)
    driving.until(lambda: any(name == "/task/start" for name, _ in robot.asked), "not asked")
    (request,) = (request for name, request in robot.asked if name == "/task/start")
    assert isinstance(request, StartTaskRequest)
    assert request.order.task == "hold"


def test_the_next_camera_is_watched(driving: Glass, diving: Any) -> None:
    watched: list[Any] = []
    diving.session.link.watch = watched.append
    driving.tap(next(key for key in diving.column.grid.children if key.name == "Camera"))
    driving.until(lambda: watched == ["rear"], "not watched")
