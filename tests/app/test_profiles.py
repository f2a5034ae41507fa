"""Robots of several kinds before the app: each gets the screen that is made for it, and is driven in its own words."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from app.link.feeds import Post
from app.screens.drive.drive import DriveScreen
from bridge.msgs.geometry_msgs import Pose, PoseWithCovariance, PoseWithCovarianceStamped, Twist
from bridge.msgs.pilothouse_msgs import (
    Compass,
    FlightState,
    Manoeuvre,
    RobotInfo,
    TaskStatus,
)
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

TRUCK = RobotInfo(
    name="Commander-1",
    kind="ackermann",
    model="commander",
    max_speed=5.0,
    max_yaw_rate=1.4,
    max_steering=0.5,
    manoeuvres=["twist", "steer", "rest"],
)
BOAT = RobotInfo(
    name="Minnow-1",
    kind="boat",
    model="dory",
    max_speed=2.0,
    max_yaw_rate=0.6,
    max_steering=0.6,
    manoeuvres=["twist", "steer", "course", "hover", "rest"],
    tasks=["hold", "follow_heading", "go_home"],
)
DRONE = RobotInfo(
    name="Drone-1",
    kind="quadrotor",
    model="ardrone",
    max_speed=4.0,
    max_yaw_rate=1.75,
    max_climb=1.0,
    max_tilt=0.35,
    manoeuvres=["twist", "tilt", "hover", "take_off", "land", "rest"],
    tasks=["hold", "go_home", "take_off", "land"],
)
SCOUT = RobotInfo(name="Scout-1", kind="wheels", model="scout", max_speed=1.0, max_yaw_rate=2.0)


@pytest.fixture
def meet(driving: Glass, robot: FakeRobot) -> Callable[[RobotInfo], Any]:
    """Have the robot say what it is, and give the screen that comes."""

    def meet(info: RobotInfo) -> Any:
        before = driving.app.screens["drive"]
        robot.publish("/robot/info", info)
        driving.until(lambda: driving.app.screens["drive"] is not before, "the screen of before")
        screen = driving.app.screens["drive"]
        driving.until(lambda: screen.stick.state == "live", "nothing to drive by")
        return screen

    return meet


def manoeuvres(robot: FakeRobot) -> list[Manoeuvre]:
    return [message for topic, message in robot.heard if topic == "/cmd_manoeuvre"]


def orders(robot: FakeRobot) -> list[Any]:
    return [request.order for service, request in robot.asked if service == "/task/start"]


def test_a_truck_is_steered_and_comes_to_rest(
    driving: Glass, robot: FakeRobot, meet: Callable[..., Any]
) -> None:
    screen = meet(TRUCK)
    assert screen.speed.maximum_speed == pytest.approx(3.0), "six tenths of what it can"
    screen.stick.lean(1.0, 0.0)
    driving.until(lambda: manoeuvres(robot), "it heard nothing")
    said = manoeuvres(robot)[-1]
    assert (said.kind, said.speed, said.steering) == ("steer", pytest.approx(3.0), 0.0)
    assert said.header.stamp.seconds > 0
    screen.rest()
    driving.until(lambda: robot.twists()[-3:] == [Twist()] * 3, "it was not told to rest")


def test_a_boat_of_any_model_has_a_lever_and_a_course(
    driving: Glass, robot: FakeRobot, meet: Callable[..., Any]
) -> None:
    screen = meet(BOAT)
    said: list[Any] = []
    screen.session.link.drive = said.append
    screen.stick.lean(1.0, 1.0)
    assert (said[-1].kind, said[-1].steering) == ("steer", pytest.approx(0.6))
    assert said[-1].throttle == pytest.approx(0.6), "the slider says how much of it"
    screen.stick.rest()
    assert said[-1] == Twist()
    (dial,) = screen.hands.places["top_right"]
    dial.show(Compass(heading=10.0))
    screen.tick()
    assert dial.state == "live"
    dial.asked = 45.0
    dial.dispatch("on_course", math.radians(45))
    driving.until(lambda: orders(robot), "no course")
    order = orders(robot)[-1]
    assert (order.task, order.heading) == ("follow_heading", pytest.approx(math.radians(45)))
    driving.until(lambda: dial.outcome == "accepted", "the dial does not say what became of it")


def test_a_drone_is_flown_with_two_thumbs_and_takes_off_by_a_slide(
    driving: Glass, robot: FakeRobot, meet: Callable[..., Any]
) -> None:
    screen = meet(DRONE)
    said: list[Any] = []
    screen.session.link.drive = said.append
    left, right = (stick for stick, _ in screen.sticks)
    assert [pad for _, pad in screen.sticks] == ["left", "right"]
    left.lean(1.0, 0.0)
    right.lean(1.0, 0.0)
    assert (said[-1].kind, said[-1].twist.linear.z) == ("tilt", pytest.approx(0.6))
    assert said[-1].pitch == pytest.approx(0.6 * 0.35)
    right.rest()
    assert said[-1].linear.z == pytest.approx(0.6)
    left.rest()
    assert said[-1] == Twist()
    up, down = screen.hands.places["confirm"]
    assert (up.text, down.text) == ("take off", "land")
    assert not up.collide_widget(down)
    for phase, states in (("landed", ("live", "disabled")), ("flying", ("disabled", "live"))):
        screen.session.feeds.put("/flight", Post(FlightState(phase=phase), screen.session.now(), 1))
        screen.tick()
        assert (up.state, down.state) == states, phase
    up.dispatch("on_confirm")
    driving.until(lambda: orders(robot), "it was not asked to take off")
    assert orders(robot)[-1].task == "take_off"
    driving.until(lambda: up.outcome == "accepted", "the slide does not say what became of it")
    robot.refusals["/task/start"] = "There is no ground here."
    down.dispatch("on_confirm")
    driving.until(lambda: down.outcome == "refused", "a refusal is not said where it was asked")


def test_a_scout_is_driven_by_a_stick_or_sent_to_a_goal(
    driving: Glass, robot: FakeRobot, meet: Callable[..., Any]
) -> None:
    screen = meet(SCOUT)
    stick, pad = screen.hands.places["stick"]
    stick.lean(1.0, 0.0)
    screen.switch.choose("Goal")
    driving.stage.frames(2)
    assert stick.forward == 0.0, "it rests when the other one comes"
    assert screen.sticks == [], "a gamepad has nothing to push"
    assert stick.right < 0 < pad.x
    assert screen.speed.right < 0, "it says nothing of a goal, which takes its room"
    assert pad.width > 300
    pose = Pose()
    pad.show(PoseWithCovarianceStamped(pose=PoseWithCovariance(pose)))
    pad.press("north")
    pad.press("go")
    driving.until(lambda: orders(robot), "no goal")
    (goal,) = orders(robot)[-1].goals
    assert (orders(robot)[-1].task, goal.x, goal.y) == ("go_to", 0.0, 0.25)
    driving.until(lambda: pad.outcome == "accepted", "the pad does not say what became of it")
    robot.publish("/task/status", TaskStatus(task_id=3, task="go_to", state="RUNNING"))
    robot.publish("/task/status", TaskStatus(task_id=3, task="go_to", state="CANCELED"))
    driving.until(lambda: pad.says[0] == "Canceled", "it says that a robot goes that stands")
    screen.switch.choose("Stick")
    assert [one for one, _ in screen.sticks] == [stick]
    assert pad.right < 0 < screen.speed.x


def test_slow_on_the_slider_turns_slower_too_but_never_below_half_and_steers_as_far_as_ever(
    driving: Glass, robot: FakeRobot, meet: Callable[..., Any]
) -> None:
    screen = meet(SCOUT)
    screen.stick.lean(0.0, 1.0)

    def turns(speed: float) -> float:
        screen.speed.maximum_speed = speed
        assert screen.stick.max_yaw_rate == screen.hands.reach.yaw_rate, "the stick says what it means"
        return screen.hands.reach.yaw_rate

    assert [turns(speed) for speed in (1.0, 0.5, 0.1)] == pytest.approx([2.0, 1.5, 1.1])
    screen = meet(TRUCK)
    screen.speed.maximum_speed = 0.5
    assert screen.hands.reach.steering == pytest.approx(0.5)


def test_the_screen_of_before_rests_and_is_heard_no_longer(
    driving: Glass, robot: FakeRobot, meet: Callable[..., Any]
) -> None:
    before = driving.app.screens["drive"]
    assert isinstance(before, DriveScreen)
    before.stick.lean(1.0, 0.0)
    screen = meet(DRONE)
    assert before.stick.forward == 0.0
    assert before.parent is None
    assert screen.parent is not None
    assert not before.dashboard.active
    robot.publish("/robot/info", DRONE)
    driving.stage.frames(5)
    assert driving.app.screens["drive"] is screen, "the same robot says the same again"


def test_a_layout_that_is_asked_for_is_kept_whatever_the_robot_is() -> None:
    from app.application import PilothouseApp

    app = PilothouseApp(layout="minnow", discover=False)
    assert app.layouts.of("ardrone", "quadrotor").name == "minnow"
    assert PilothouseApp(discover=False).layouts.of("ardrone", "quadrotor").name == "ardrone"
