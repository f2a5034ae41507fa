"""A robot that carries an arm before the app: a switch wherever it is driven, orders that reach it, and what became of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from app.link.capabilities import Capabilities
from app.link.channels import CAPABILITIES
from app.screens.drive.dive import DiveScreen
from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmState, MoveArmRequest, MoveArmResponse, TagRead
from tests.app import fakes
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.screens.drive.test_dive import AQUA
from tests.app.test_profiles import DRONE, SCOUT

HOME = Float64Array([0.0, -1.05, 0.35, 0.70])
STATE = ArmState(
    angles=HOME, wanted=HOME, gripper=0.05, pose="home", poses=["rest", "home"], tip=Point(0.2, 0.0, 0.4)
)


@pytest.fixture
def robot(monkeypatch: pytest.MonkeyPatch, port: int) -> Any:
    """One with an arm."""
    monkeypatch.setitem(fakes.REQUESTS, "/arm/move", MoveArmRequest)
    monkeypatch.setitem(fakes.RESPONSES, "/arm/move", MoveArmResponse)
    robot = FakeRobot(port)
    yield robot
    robot.close()


def orders(robot: FakeRobot) -> list[Any]:
    asked: list[tuple[str, Any]] = list(robot.asked)
    return [request.order for service, request in asked if service == "/arm/move"]


def armed(driving: Glass) -> Any:
    """The drive screen with the arm on the glass."""
    driving.until(lambda: driving.app.screens["drive"].hands.arm.carried, "no arm")
    screen = driving.app.screens["drive"]
    screen.switch.choose("Arm")
    driving.stage.frames(3)
    return screen


def told(driving: Glass, robot: FakeRobot, condition: Callable[[], Any]) -> None:
    """The robot goes on telling of its arm until that holds."""

    def look() -> Any:
        robot.publish("/arm", STATE)
        return condition()

    driving.until(look, "not with all that it tells")


def test_a_finger_drags_the_tip_and_is_told_that_it_does_not_reach_and_stop_takes_it_away(
    driving: Glass, robot: FakeRobot
) -> None:
    screen = armed(driving)
    panel = screen.hands.arm.panel
    told(driving, robot, lambda: panel.state == "live" and panel.tip)
    assert (screen.stick, panel in screen.grips) == (None, True)
    robot.refusals["/arm/move"] = "The arm does not reach (0.30, 0.00, 0.45)."
    x, y = panel.tip_on_glass
    finger = driving.stage.touch(x, y)
    finger.touch_down()
    finger.touch_move(x + 30, y + 20)
    finger.touch_up()
    driving.until(lambda: panel.outcome == "refused", "the panel does not say it")
    (order,) = orders(robot)
    assert order.point.x == pytest.approx(0.2 + 30 / panel.side.scale, abs=0.005)
    assert any("does not reach (0.30, 0.00, 0.45)" in text for text in driving.banners())
    robot.refusals.clear()
    panel.press_gripper()
    driving.until(lambda: panel.outcome == "accepted", "the gripper's answer")
    assert orders(robot)[-1].gripper == 0.0
    driving.app.session.stop()
    told(driving, robot, lambda: panel.state == "disabled")


def test_every_layout_has_the_switch(driving: Glass, robot: FakeRobot) -> None:
    for info, names in ((SCOUT, ["Stick", "Goal", "Arm"]), (DRONE, ["Stick", "Arm"])):
        before = driving.app.screens["drive"]
        robot.publish("/robot/info", info)
        driving.until(
            lambda before=before: driving.app.screens["drive"] is not before, "the screen of before"
        )
        screen = armed(driving)
        assert [name for name, _ in screen.switch.options] == names
        panel = screen.hands.arm.panel
        assert panel.right <= driving.app.shell.stop.x
        assert panel.top <= screen.switch.y
        screen.switch.choose("Stick")
        driving.stage.frames(1)
        assert panel.right < 0, "only one of them is on the glass"


def test_three_columns_open_it_over_the_instruments(driving: Glass, robot: FakeRobot) -> None:
    robot.publish("/robot/info", AQUA)
    driving.until(lambda: isinstance(driving.app.screens["drive"], DiveScreen), "not in three columns")
    screen = driving.app.screens["drive"]
    driving.until(lambda: any(action.name == "arm" for action in screen.column.actions), "no line for it")
    (legs,) = screen.places["legs"]
    screen.column.dispatch("on_action", "arm")
    panel = screen.hands.arm.panel
    assert (panel.parent, legs.right < 0, panel in screen.grips) == (screen, True, True)
    screen.column.dispatch("on_action", "arm")
    assert (panel.parent, legs.x > 0, panel in screen.grips) == (None, True, False)


def test_what_is_taken_off_goes_and_what_is_read_is_said(driving: Glass, robot: FakeRobot) -> None:
    screen = armed(driving)
    panel, session = screen.hands.arm.panel, driving.app.session
    offer = session.robot.capabilities
    bare = Capabilities(offer.topics, offer.services - {"/arm/move"}, True, offer.names, offer.drive)
    session.robot.capabilities = bare
    screen.on_post(CAPABILITIES, type("Said", (), {"value": bare})())
    driving.stage.frames(2)
    assert (panel.parent, screen.switch.parent, screen.hands.chosen) == (None, None, "")
    assert screen.stick is not None
    robot.publish("/tag", TagRead(tag="tree-7"))
    driving.until(lambda: "Tag read: tree-7" in driving.banners(), "nothing is said of the tag")
    robot.publish("/tag", TagRead(tag=""))
    driving.until(lambda: "Tag read: tree-7" not in driving.banners(), "it is still said")
