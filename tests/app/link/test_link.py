"""The link: messages come in, commands go out, and a cut cable leaves nothing old behind."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from app.core.settings_store import Settings
from app.link.feeds import Feeds, Mailbox, Post
from app.link.link import Link
from app.session.logbook import marks
from app.session.session import Session
from bridge.core.identity import public_id
from bridge.core.network_thread import NetworkThread
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped, Twist
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, Mission, Waypoint
from tests.app.fakes import FakeRobot

PATIENCE = 10.0
"""A fault, not a delay, uses this up [s]."""
AHEAD = Twist.planar(0.3, 0.0)


class Operator:
    """A session without glass: takes out what the mailbox holds until something is the case."""

    def __init__(
        self, url: str, folder: Path, *, wants_control: bool, client_id: str = "me", name: str = "tablet"
    ) -> None:
        self.network = NetworkThread()
        self.woken = threading.Event()
        self.mailbox = Mailbox(self.woken.set)
        self.settings = Settings(folder)
        self.link = Link(
            url,
            self.mailbox,
            self.network,
            client_id=client_id,
            client_name=name,
            marks=marks(self.settings),
        )
        self.session = Session(
            self.link,
            Feeds(time.monotonic),
            self.settings,
            now=time.monotonic,
            client_id=client_id,
            wants_control=wants_control,
        )
        self.said: list[tuple[str, Any]] = []
        self.session.listeners.append(lambda channel, post: self.said.append((channel, post.value)))
        self.link.start()

    def until(self, condition: Callable[[], Any], *, beating: bool = True) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < end, f"never came; last was {self.said[-3:]}"
            self.turn(beating=beating)

    def turn(self, *, beating: bool = True) -> None:
        if beating:
            self.link.beat()
        for channel, post in self.mailbox.drain():
            self.session.deliver(channel, post)

    def texts(self) -> list[str]:
        return [value.text for channel, value in self.said if channel == "event"]

    def close(self) -> None:
        self.link.close()
        self.network.close()
        self.settings.close()


@pytest.fixture
def robot() -> Iterator[FakeRobot]:
    robot = FakeRobot()
    yield robot
    robot.close()


@pytest.fixture
def connect(robot: FakeRobot, tmp_path: Path) -> Iterator[Callable[..., Operator]]:
    made: list[Operator] = []

    def one(*, wants_control: bool = True) -> Operator:
        made.append(Operator(robot.url, tmp_path, wants_control=wants_control))
        return made[-1]

    yield one
    for operator in made:
        operator.close()


def test_who_connects_takes_control_where_it_is_free(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    operator.until(lambda: operator.session.control == "mine")
    assert robot.services() == ["/control/acquire"]
    assert operator.session.robot.name == "Fake-1"


def test_who_watches_asks_for_nothing(robot: FakeRobot, connect: Callable[..., Operator]) -> None:
    operator = connect(wants_control=False)
    operator.until(lambda: operator.session.control == "free")
    assert robot.services() == []


def test_control_of_another_is_not_taken_and_forbids_the_stick(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.control = ControlStatus(driver="tablet-B", driver_id="b")
    robot.publish("/control/status", robot.control)
    operator = connect()
    operator.until(lambda: operator.session.control == "other")
    assert not operator.session.may_drive
    assert robot.services() == []
    robot.publish("/control/status", ControlStatus())
    operator.until(lambda: robot.services() == ["/control/acquire"])


def test_a_refusal_is_told_with_the_robots_reason(robot: FakeRobot, connect: Callable[..., Operator]) -> None:
    robot.refusals["/task/start"] = "The mission has no points."
    operator = connect()
    operator.until(lambda: operator.session.control == "mine")
    operator.session.command("start")
    operator.until(
        lambda: "start" in operator.session.outcomes and operator.session.outcomes["start"].phase == "refused"
    )
    assert operator.session.outcomes["start"].sentence == "Refused: start patrol. The mission has no points."


def test_a_sent_draft_is_stored_only_when_the_robot_accepts_it(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    operator.until(lambda: operator.session.control == "mine" and operator.session.mission.stored is not None)
    operator.session.mission.add(1.0, 2.0)
    robot.refusals["/mission/set"] = "Point 1 is inside a wall."
    operator.session.send_mission()
    assert operator.session.mission.state == "sent"
    operator.until(lambda: operator.session.mission.state == "draft")
    assert "inside a wall" in operator.session.mission.outcome
    robot.refusals.clear()
    operator.session.send_mission()
    operator.until(lambda: operator.session.mission.state == "stored")


@pytest.mark.parametrize("told_first", [True, False])
def test_a_draft_sent_before_the_earlier_one_is_answered_is_sent_after_it(
    robot: FakeRobot, connect: Callable[..., Operator], told_first: bool
) -> None:
    operator = connect()
    operator.until(lambda: operator.session.control == "mine" and operator.session.mission.stored is not None)
    mission = operator.session.mission
    robot.hold_answers()
    mission.add(1.0, 2.0)
    first = mission.draft
    operator.session.send_mission()
    operator.until(lambda: "/mission/set" in robot.services())
    mission.add(3.0, 4.0)
    operator.session.send_mission()
    robot.objection = lambda _, request: "At most 1 point." if len(request.mission.waypoints) > 1 else None
    if told_first:
        robot.publish("/mission", first.message())
        operator.until(lambda: mission.stored == first)
    assert mission.state == "sent"
    robot.give_answers()
    operator.until(lambda: mission.state == "draft")
    assert mission.stored == first
    assert "At most 1 point." in mission.outcome
    if not told_first:
        robot.publish("/mission", first.message())
        operator.until(lambda: operator.session.feeds.latest("/mission") == first.message())
    assert (mission.state, mission.stored) == ("draft", first)
    asked = [len(request.mission.waypoints) for name, request in robot.asked if name == "/mission/set"]
    assert asked[-1] == 2
    robot.objection = lambda *_: None
    operator.session.send_mission()
    operator.until(lambda: mission.state == "stored")
    assert len(robot.asked[-1][1].mission.waypoints) == 2


def test_a_draft_of_yesterday_is_there_again_and_not_replaced(
    robot: FakeRobot, connect: Callable[..., Operator], tmp_path: Path
) -> None:
    first = connect()
    first.until(lambda: first.session.mission.stored is not None)
    first.session.mission.add(3.0, 4.0)
    first.close()
    robot.publish("/mission", Mission(waypoints=[Waypoint(9.0, 9.0)]))
    second = connect()
    second.until(lambda: second.session.mission.stored is not None)
    assert second.session.mission.draft.points == ((3.0, 4.0),)
    assert second.session.mission.state == "draft"


def test_stop_is_confirmed_by_the_robot_and_lets_the_stick_go(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    operator.until(lambda: operator.session.control == "mine")
    operator.link.drive(AHEAD)
    operator.until(lambda: AHEAD in robot.twists())
    operator.link.stop()
    operator.until(lambda: operator.session.robot_stop.phase == "stopped")
    operator.until(lambda: robot.twists()[-3:] == [Twist()] * 3)
    assert robot.services().count("/stop") >= 1
    assert not operator.session.may_drive
    operator.session.command("stop_release")
    operator.until(lambda: operator.session.robot_stop.phase == "ready")


def test_stop_is_repeated_while_the_robot_does_not_rest_until_it_is_let_go(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.refusals["/stop"] = "STOP is pressed, but the robot cannot be reached."
    operator = connect()
    operator.until(lambda: operator.session.control == "mine")
    operator.link.stop()
    operator.until(lambda: "/stop" in robot.services())
    held = {"driver": "tablet", "driver_id": public_id("me")}
    robot.publish("/control/status", ControlStatus(mode="STOPPED", stopped=True, at_rest=False, **held))
    operator.until(lambda: operator.session.robot_stop.latched)
    asked = robot.services().count("/stop")
    operator.until(lambda: robot.services().count("/stop") > asked + 3)
    operator.until(lambda: operator.session.robot_stop.phase == "no_answer")
    operator.session.release_stop()
    operator.until(lambda: "/stop/release" in robot.services())
    holds(operator, 0.6)
    assert not operator.link.commands.stopping
    assert [name for name in robot.services() if name.startswith("/stop")][-1] == "/stop/release"


def drives(operator: Operator, robot: FakeRobot) -> None:
    """The stick is pushed and held, and the robot moves."""
    operator.until(lambda: operator.session.control == "mine" and operator.session.may_drive)
    operator.link.drive(AHEAD)
    operator.until(lambda: robot.twists().count(AHEAD) > 2)


def holds(operator: Operator, seconds: float) -> None:
    """The stick stays where it is and the glass is alive."""
    end = time.monotonic() + seconds
    operator.until(lambda: time.monotonic() > end)


def test_every_drive_command_says_when_it_was_meant_by_the_robots_clock(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.clock = lambda: time.time() - 5000.0
    operator = connect()
    drives(operator, robot)
    holds(operator, 0.5)
    moving = [(stamp, came) for twist, stamp, came in robot.stamps if twist != Twist()]
    assert len(moving) > 5
    stamps = [stamp for stamp, _ in moving]
    assert all(stamp is not None and math.isfinite(stamp) for stamp in stamps)
    assert max(abs(came - stamp) for stamp, came in moving) < 1.0
    assert stamps == sorted(set(stamps))


def test_without_the_robots_clock_nothing_moves(robot: FakeRobot, connect: Callable[..., Operator]) -> None:
    robot.clock = lambda: math.nan
    operator = connect()
    operator.until(lambda: operator.session.control == "mine" and not operator.link.silent)
    assert not operator.session.may_drive
    end = time.monotonic() + 0.4
    while time.monotonic() < end:
        operator.link.drive(AHEAD)
        operator.turn()
    assert operator.session.connected
    assert AHEAD not in robot.twists()


def test_a_stick_held_over_a_silent_link_must_be_pushed_anew(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    drives(operator, robot)
    robot.faint()
    operator.until(lambda: operator.link.silent)
    holds(operator, 0.2)
    robot.wake()
    operator.until(lambda: not operator.link.silent and robot.twists()[-3:] == [Twist()] * 3)
    robot.heard.clear()
    holds(operator, 0.3)
    assert robot.twists() == []
    operator.link.drive(AHEAD)
    operator.until(lambda: AHEAD in robot.twists())


def test_a_stick_pushed_while_stop_is_unanswered_moves_nothing(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.refusals["/stop"] = "The brake does not answer."
    operator = connect()
    drives(operator, robot)
    operator.link.stop()
    operator.until(lambda: "/stop" in robot.services() and robot.twists()[-3:] == [Twist()] * 3)
    robot.heard.clear()
    end = time.monotonic() + 0.4
    while time.monotonic() < end:
        operator.link.drive(AHEAD)
        operator.turn()
    assert operator.link.commands.stopping
    assert robot.twists() == []


def test_a_stick_held_over_a_short_cut_must_be_pushed_anew(
    robot: FakeRobot, connect: Callable[..., Operator], monkeypatch: pytest.MonkeyPatch
) -> None:
    operator = connect()
    drives(operator, robot)
    # a clock that is never unknown: the cut alone has to do it
    monkeypatch.setattr(operator.link._client, "robot_time", time.time)
    heard = operator.link.health._heard
    robot.publish("/pose", PoseWithCovarianceStamped())
    operator.until(lambda: operator.link.health._heard > heard)
    robot.cut()
    operator.until(lambda: not operator.session.connected)
    robot.heard.clear()
    operator.until(lambda: operator.session.connected)
    holds(operator, 0.3)
    assert AHEAD not in robot.twists()


def test_a_link_closed_under_a_pushed_stick_says_rest_at_last(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    drives(operator, robot)
    operator.link.close()
    assert robot.until(lambda: robot.twists()[-1] == Twist())


def test_control_that_is_given_up_under_a_pushed_stick_leaves_a_robot_told_to_rest(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    drives(operator, robot)
    before: list[Twist] = []

    def note(name: str, _: Any) -> None:
        if name == "/control/release":
            before.append(robot.twists()[-1])

    robot.objection = note
    operator.session.authority.release()
    operator.until(lambda: "/control/release" in robot.services())
    assert before == [Twist()]


def test_a_frozen_glass_stops_the_robot(robot: FakeRobot, connect: Callable[..., Operator]) -> None:
    operator = connect()
    operator.until(lambda: operator.session.control == "mine")
    operator.link.drive(AHEAD)
    operator.until(lambda: AHEAD in robot.twists())
    operator.until(lambda: robot.twists()[-3:] == [Twist()] * 3, beating=False)


def test_after_a_lost_link_everything_comes_back_but_the_old_drive_command(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.events = [Event(id=1, boot="a", text="one")]
    operator = connect()
    operator.until(lambda: operator.session.control == "mine" and operator.texts() == ["one"])
    operator.session.mission.add(1.0, 1.0)
    operator.link.drive(AHEAD)
    operator.until(lambda: AHEAD in robot.twists())
    robot.stop()
    operator.until(lambda: not operator.session.connected)
    assert operator.session.feeds.state("/control/status") == "stale"
    assert operator.session.control == "unknown"
    assert operator.session.link_state.sentence
    robot.heard.clear()
    robot.events.append(Event(id=2, boot="a", text="two"))
    robot.control = ControlStatus()
    robot.start()
    operator.until(lambda: operator.session.control == "mine" and operator.texts() == ["one", "two"])
    assert robot.twists() == []
    assert operator.session.mission.draft.points == ((1.0, 1.0),)


def test_an_app_that_was_killed_and_comes_back_gets_all_it_missed_and_nothing_twice(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.events = [Event(id=1, boot="a", text="1")]
    first = connect()
    first.until(lambda: first.texts() == ["1"] and marks(first.settings) == {"a": 1})
    first.close()
    robot.events += [Event(id=number, boot="a", text=f"{number}") for number in range(2, 602)]
    again = connect()
    again.until(lambda: again.session.logbook.missed)
    assert again.texts() == [f"{number}" for number in range(2, 602)]
    assert [one.id for one in again.session.logbook.missed] == list(range(2, 602))


def test_what_another_handheld_saw_to_while_the_link_was_lost_waits_for_nobody(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.events = [Event(id=1, boot="a", text="alarm", level="alarm")]
    operator = connect()
    operator.until(lambda: operator.session.logbook.alarms == 1)
    robot.stop()
    operator.until(lambda: not operator.session.connected)
    robot.events = [Event(id=1, boot="a", text="alarm", level="alarm", acknowledged_by="Anna")]
    robot.start()
    operator.until(lambda: operator.session.logbook.alarms == 0)
    assert operator.session.logbook.events[0].acknowledged_by == "Anna"


def test_an_acknowledgement_that_gets_no_answer_for_the_link_is_lost_is_given_once_the_link_is_back(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    robot.events = [Event(id=1, boot="a", text="alarm", level="alarm")]
    operator = connect()
    book = operator.session.logbook
    operator.until(lambda: book.alarms == 1)
    robot.hold_answers()
    book.acknowledge(book.open)
    assert robot.until(lambda: "/events/acknowledge" in robot.services())
    assert book.is_asked(book.events[0])
    robot.cut()
    operator.until(lambda: not operator.session.connected)
    robot.give_answers()
    operator.until(lambda: book.alarms == 0)
    asked = [request.command_id for name, request in robot.asked if name == "/events/acknowledge"]
    assert len(set(asked)) == 1
    assert book.events[0].acknowledged_by == "tablet"


def test_a_stream_is_live_and_goes_stale(robot: FakeRobot, connect: Callable[..., Operator]) -> None:
    operator = connect()
    operator.until(lambda: operator.session.control == "mine")  # by then it has subscribed
    told = [0.0]

    def heard() -> bool:
        """Once more after a while, for on a busy machine one can be stale before anybody looks."""
        if time.monotonic() - told[-1] > 0.1:
            told.append(time.monotonic())
            robot.publish("/pose", PoseWithCovarianceStamped())
        return operator.session.feeds.state("/pose") == "live"

    operator.until(heard)
    operator.until(lambda: operator.session.feeds.state("/pose") == "stale")


def test_the_place_told_by_the_operator_reaches_the_robot(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    operator.until(lambda: operator.session.connected)
    operator.session.place_robot(1.0, 2.0, 0.5)
    assert robot.until(lambda: any(topic == "/initialpose" for topic, _ in robot.heard))
    pose = next(message for topic, message in robot.heard if topic == "/initialpose")
    assert (pose.pose.pose.position.x, pose.pose.pose.position.y) == (1.0, 2.0)
    assert pose.pose.pose.orientation.yaw == pytest.approx(0.5)
    assert pose.header.frame_id == "map"


def test_events_heard_by_nobody_are_kept_for_who_comes_later(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    operator.session.listeners.clear()
    operator.session.deliver("event", Post(Event(id=1, text="early"), 0.0, 1))
    assert [post.value.text for post in operator.session.events.early] == ["early"]


def test_a_draft_that_was_under_way_over_a_closed_link_can_be_sent_again(
    robot: FakeRobot, connect: Callable[..., Operator]
) -> None:
    operator = connect()
    operator.until(lambda: operator.session.mission.stored is not None)
    operator.session.mission.add(1.0, 2.0)
    operator.session.mission.sending()
    operator.session.resume(operator.link)
    assert operator.session.mission.state == "draft"
    assert operator.session.mission.outcome == "No reply: the link was closed."


def test_whether_it_is_stopped_wakes_the_glass_at_once(
    connect: Callable[..., Operator], robot: FakeRobot
) -> None:
    operator = connect(wants_control=False)
    operator.until(lambda: operator.session.feeds.latest("/control/status") is not None)
    operator.woken.clear()
    robot.publish("/control/status", ControlStatus(stopped=True))
    assert operator.woken.wait(PATIENCE)
    operator.until(lambda: operator.session.robot_stop.latched)
    assert operator.link._is_stopping(), "no switch of a view sends anything, whatever the glass lets through"
