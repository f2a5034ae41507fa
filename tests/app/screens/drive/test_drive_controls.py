"""DriveControls of the drive screen: what is held follows what slider, limits and kind of the robot come to mean."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import msgspec
import pytest

from app.link.channels import OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post
from app.link.link import Link
from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Event, FlightState, Limits, RobotInfo, TaskOrder, TaskStatus
from bridge.msgs.std_msgs import Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.app.screens.drive.test_dive import AQUA as SWIMMER
from tests.app.test_profiles import BOAT, DRONE, TRUCK

SLOW: dict[str, tuple[float, Callable[[Any], float]]] = {
    "commander": (1.0, lambda said: said.speed),
    "dory": (0.4, lambda said: said.throttle * BOAT.max_speed),
    "ardrone": (0.8, lambda said: said.pitch / DRONE.max_tilt * DRONE.max_speed),
}
"""By model what the slider is drawn to, and how the speed is read from what is told [m/s]."""


class Told:
    """A link that keeps what the robot is told to do by hand."""

    def __init__(self, link: Any) -> None:
        self.orders: list[Any] = []
        link.drive = link.amend = self.orders.append

    @property
    def last(self) -> Any:
        return self.orders[-1]


@pytest.fixture
def meet(driving: Glass, robot: FakeRobot) -> Callable[[RobotInfo], Any]:
    """Have the robot say what it is, and give the screen that comes and what is told from there."""

    def meet(info: RobotInfo) -> tuple[Any, Told]:
        before = driving.app.screens["drive"]
        robot.publish("/robot/info", info)
        driving.until(lambda: driving.app.screens["drive"] is not before, "the screen of before")
        screen = driving.app.screens["drive"]
        driving.until(lambda: screen.stick.state == "live", "nothing to drive by")
        return screen, Told(screen.session.link)

    return meet


def hear(screen: Any, channel: str, message: Any) -> None:
    post = Post(message, screen.session.now(), 1)
    screen.session.feeds.put(channel, post)
    screen.on_post(channel, post)


def test_the_slider_acts_at_once_on_a_stick_that_is_held(meet: Callable[..., Any]) -> None:
    for info in (TRUCK, BOAT, DRONE):
        screen, told = meet(info)
        slow, reads = SLOW[info.model]
        for stick, _ in screen.sticks:
            stick.lean(1.0, 0.0)
        assert reads(told.last) == pytest.approx(0.6 * info.max_speed), info.model
        screen.speed.maximum_speed = slow
        assert reads(told.last) == pytest.approx(slow), f"{info.model} drives on as fast as before"
        screen.rest()
        count = len(told.orders)
        screen.speed.maximum_speed = info.max_speed
        assert told.last == Twist()
        assert len(told.orders) == count, "what is let go stays so"


def test_a_limit_and_a_kind_that_come_while_a_stick_is_held_act_at_once(meet: Callable[..., Any]) -> None:
    screen, told = meet(TRUCK)
    screen.stick.lean(1.0, 0.0)
    hear(screen, "/limits", Limits(max_speed=0.7))
    assert told.last.speed == pytest.approx(0.7)
    hear(screen, "/robot/info", msgspec.structs.replace(TRUCK, manoeuvres=["twist"]))
    assert told.last == Twist.planar(0.7, 0.0), "it is told in words that it knows no more"


def test_the_mission_screen_calls_what_was_started_by_its_own_name(meet: Callable[..., Any]) -> None:
    screen, _ = meet(BOAT)
    mission = screen.app.screens["mission"]
    order = TaskOrder(task="follow_heading", heading=0.0)
    outcome = Outcome("start", "1", "accepted", latency=0.3, fields={"order": order})
    mission.on_post(OUTCOME, Post(outcome, screen.session.now(), 1))
    assert mission.panel.tasks.sentence == "Accepted: start heading 090° (300 ms)"


def test_the_slide_that_lands_never_ends_a_landing(
    meet: Callable[..., Any], driving: Glass, robot: FakeRobot
) -> None:
    screen, _ = meet(DRONE)
    _, down = screen.hands.places["confirm"]
    hear(screen, "/flight", FlightState(phase="flying"))
    for state, text, use in (("RUNNING", "land", "disabled"), ("PAUSED", "resume landing", "live")):
        screen.session.deliver(
            "/task/status", Post(TaskStatus(task_id=1, task="land", state=state), screen.session.now(), 1)
        )
        screen.tick()
        assert (down.text, down.state) == (text, use), state
    down.dispatch("on_confirm")
    driving.until(lambda: "/task/resume" in robot.services(), "the landing does not go on")
    driving.until(lambda: down.outcome == "accepted", "the slide does not say what became of it")
    assert "/task/cancel" not in robot.services()


def test_what_stands_on_the_ground_takes_no_push_and_says_what_to_do_first(
    meet: Callable[..., Any], driving: Glass
) -> None:
    screen, _ = meet(DRONE)
    (left, _), (right, _) = screen.sticks
    hear(screen, "/flight", FlightState(phase="landed"))
    screen.tick()
    assert (left.state, right.state, left.caption) == ("disabled", "disabled", "take off first")
    right.dispatch("on_in_vain")
    assert driving.banners() == ["It stands on the ground: take off first."]
    for phase in ("taking_off", "flying", "landing"):
        hear(screen, "/flight", FlightState(phase=phase))
        screen.tick()
        assert (left.state, right.state, left.caption) == ("live", "live", "climb · turn"), phase
    assert driving.banners() == []
    hear(screen, "/flight", FlightState(phase="turned_over"))
    screen.tick()
    assert (left.state, right.state, left.caption) == ("disabled", "disabled", "on its back")
    assert [slide.state for slide in screen.hands.places["confirm"]] == ["disabled", "disabled"]


def test_of_several_sticks_each_says_what_it_does(meet: Callable[..., Any]) -> None:
    screen, _ = meet(SWIMMER)
    (stick,), (lift,) = screen.hands.places["stick"], screen.hands.places["lift"]
    assert (stick.caption, lift.caption) == ("ahead · turn", "climb")


def test_while_a_task_drives_slider_and_lever_say_so_and_how_fast(meet: Callable[..., Any]) -> None:
    screen, _ = meet(BOAT)
    way = Odometry(twist=TwistWithCovariance(Twist.planar(1.9, 0.0)))
    screen.session.feeds.put("/odom", Post(way, screen.session.now(), 1))
    for state, driven in (
        ("RUNNING", "task: 1.9\u00a0m/s"),
        ("PAUSED", ""),
        ("RUNNING", "task: 1.9\u00a0m/s"),
    ):
        hear(screen, "/task/status", TaskStatus(task_id=1, task="patrol", state=state))
        screen.tick()
        assert (screen.speed.driven, screen.stick.led) == (driven, bool(driven)), state
    assert screen.speed.ids.limits.text == screen.speed.driven
    assert screen.speed.ids.fader.opacity < 1, "it looks as if it were the slider's doing"


def test_the_tilt_of_a_tablet_says_what_the_stick_would_and_is_chosen_beside_it(
    meet: Callable[..., Any],
) -> None:
    for info, says in ((TRUCK, lambda said: said.steering < 0), (BOAT, lambda said: said.throttle > 0)):
        screen, told = meet(info)
        hands = screen.hands
        hands.tablet = True
        screen.meet()
        assert list(hands.choices)[-1] == screen.switch.options[-1][0] == "Tilt", info.model
        assert hands.circle is None, "it leads nothing before it is chosen"
        hands.chosen = "Tilt"
        circle = hands.circle
        circle.state, circle.clutched = "live", True
        circle.steer((0.5, 0.5), (0.5, 0.5))
        assert says(told.last), info.model
        hands.tablet = False
        screen.meet()
        assert (told.last, hands.circle, circle.parent) == (Twist(), None, None)
    screen, _ = meet(DRONE)
    screen.hands.tablet = True
    screen.meet()
    assert screen.hands.choices == {}, "it has a circle"
    assert screen.hands.circle is not None


@pytest.mark.parametrize("pushed", [True, False])
def test_a_push_that_the_robot_refuses_until_it_is_let_go_is_said_to_who_pushes(
    driving: Glass, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch, pushed: bool
) -> None:
    # a real push ends by itself on a machine that stands still for a moment
    monkeypatch.setattr(Link, "driving", pushed)
    code, said = Code.DRIVE_NOT_RELEASED, "Release it, then push it again."
    robot.happen(Event(id=1, stamp=Time.at(time.time()), kind="command", level="warn", code=code, text=said))
    driving.until(lambda: driving.app.session.logbook.events, "nothing came")
    driving.stage.frames(2)
    assert (said in driving.banners()) == pushed
