"""STOP's lane to one robot: it goes on until the robot says that it is stopped and rests, and claims no more than that."""

from __future__ import annotations

import asyncio
import itertools
import math
from collections.abc import Callable, Coroutine
from contextlib import asynccontextmanager
from typing import Any

import pytest

from app.stop.stop_lane import StopLane
from bridge.client.client import LinkState, Phase
from bridge.client.credentials import Credentials
from bridge.core.errors import NoReply, NotConnected, Refused
from bridge.core.identity import public_id
from bridge.msgs.geometry_msgs import Twist, TwistStamped, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandResponse, ControlStatus, RobotInfo
from bridge.msgs.rosapi_msgs import ServicesResponse, TopicsResponse
from bridge.msgs.std_msgs import Time
from tests.app.virtual import now, run


class Robot:
    """The other end of a lane, and a client that a test switches on and off."""

    def __init__(self) -> None:
        self.foreign = False
        self.there = False
        self.answers = True
        self.obeys = True
        self.silently = False
        """It stops and its answer is lost."""
        self.refusal = ""
        self.by, self.by_id = "Anna", "anna"
        self.topics = {"/cmd_vel": "geometry_msgs/Twist", "/odom": "nav_msgs/Odometry"}
        self.asked: list[tuple[float, str]] = []
        self.zeros: list[tuple[str, Any]] = []
        self.heard: dict[str, Callable[[Any, float], object]] = {}
        self.status = ControlStatus(at_rest=False)
        self.credentials: Credentials | None = None
        """By which its client goes."""
        self.knows_key = True
        self._closed = asyncio.Event()
        self._on_state: Callable[[LinkState], None] = lambda _: None

    def client(
        self,
        url: str,
        *,
        on_state: Callable[[LinkState], None],
        credentials: Credentials | None,
        even_unknown: bool = False,
        **_: Any,
    ) -> Robot:
        self._on_state = on_state
        self.credentials = credentials
        self.there = self.there and (self.knows_key or even_unknown)
        return self

    async def run(self) -> None:
        self._on_state(LinkState(Phase.CONNECTING, "Connecting to it.", 1, 0.0))
        if self.there:
            self.arrive()
        await self._closed.wait()

    async def close(self) -> None:
        self.there = False
        self._closed.set()

    def arrive(self) -> None:
        self.there = True
        self._on_state(LinkState(Phase.CONNECTED, "Connected.", 0, 0.0))

    def vanish(self) -> None:
        self.there = False
        self._on_state(LinkState(Phase.WAITING, "Nothing came from it for 3 s.", 1, 1.0))

    def robot_time(self) -> float:
        return math.nan

    async def call(self, service: str, request: Any, response: Any, *, timeout: float = 2.0) -> Any:
        if not self.there:
            raise NotConnected("There is no connection to it.")
        self.asked.append((now(), service))
        if not self.answers:
            await asyncio.sleep(timeout)
            raise NoReply("It did not answer.")
        if service == "/rosapi/topics":
            return TopicsResponse(topics=list(self.topics), types=list(self.topics.values()))
        if service == "/rosapi/services":
            return ServicesResponse(services=[])
        if self.foreign:
            raise Refused("There is no service /stop.")
        if not self.refusal:
            self.tell(stopped=True, at_rest=self.obeys)
        if self.silently:
            raise NoReply("It did not answer.")
        return CommandResponse(success=not self.refusal, message=self.refusal)

    def tell(self, *, stopped: bool, at_rest: bool) -> None:
        self.status = ControlStatus(
            stamp=Time(7, 1), stopped=stopped, at_rest=at_rest, stopped_by=self.by, stopped_by_id=self.by_id
        )
        if "/control/status" in self.heard:
            self.heard["/control/status"](self.status, now())

    def roll(self, speed: float) -> None:
        self.heard["/odom"](Odometry(twist=TwistWithCovariance(Twist.planar(speed, 0.0))), now())

    def subscribe(
        self, topic: str, kind: Any, callback: Callable[[Any, float], object]
    ) -> Callable[[], None]:
        self.heard[topic] = callback
        if topic == "/robot/info":
            callback(RobotInfo(name="Fake-1", model="patrol"), now())
        elif topic == "/control/status":
            callback(self.status, now())
        return lambda: None

    def advertise(self, topic: str, kind: Any) -> None:
        """Foreign servers want to know."""

    def publish(self, topic: str, message: Any, **_: Any) -> bool:
        self.zeros.append((topic, message))
        return True

    def stops(self) -> list[float]:
        """When STOP was asked for [s]."""
        return [at for at, service in self.asked if service == "/stop"]


@asynccontextmanager
async def pressed(robot: Robot, credentials: Credentials | None = None) -> Any:
    ids = itertools.count(1)
    lane = StopLane(
        "ws://robot:9090",
        now=now,
        new_id=lambda: str(next(ids)),
        client_id="me",
        client_name="tablet",
        credentials=credentials,
        connect=robot.client,
    )
    running = asyncio.create_task(lane.run())
    try:
        yield lane
    finally:
        running.cancel()
        await asyncio.gather(running, return_exceptions=True)


def story(tell: Callable[[Robot], Coroutine[Any, Any, None]]) -> Callable[[], None]:
    """The test's coroutine, in virtual time."""

    def test() -> None:
        run(tell(Robot()))

    test.__name__, test.__doc__ = tell.__name__, tell.__doc__
    return test


@story
async def test_a_robot_that_says_that_it_rests_is_stopped_and_not_asked_again(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        assert lane.report.phase == "sent"
        await asyncio.sleep(0.5)
        assert (lane.report.phase, lane.report.sentence) == ("stopped", "Pressed by Anna.")
        asked = len(robot.stops())
        await asyncio.sleep(60)
        assert len(robot.stops()) == asked


@story
async def test_one_that_is_not_there_has_not_answered_and_is_stopped_when_it_comes(robot: Robot) -> None:
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        assert lane.report.phase == "sent"
        await asyncio.sleep(600)
        assert (lane.report.phase, lane.report.sentence) == ("no_answer", "Connecting to it.")
        robot.arrive()
        arrived = now()
        await asyncio.sleep(0.5)
        assert lane.report.phase == "stopped"
        assert robot.stops()[0] - arrived <= 0.11


@story
async def test_one_that_is_there_and_does_not_answer_is_asked_again_and_again(robot: Robot) -> None:
    robot.there, robot.answers = True, False
    async with pressed(robot) as lane:
        await asyncio.sleep(10)
        assert lane.report.phase == "no_answer"
        assert lane.report.sentence == "It does not answer; STOP is sent again and again."
        assert len(robot.stops()) > 20
        robot.answers = True
        await asyncio.sleep(0.5)
        assert lane.report.phase == "stopped"


@story
async def test_one_that_took_stop_and_still_moves_is_not_said_to_be_stopped(robot: Robot) -> None:
    robot.there, robot.obeys = True, False
    async with pressed(robot) as lane:
        await asyncio.sleep(1.5)
        assert (lane.report.phase, lane.report.sentence) == ("sent", "STOP is pressed; it comes to rest.")
        await asyncio.sleep(3)
        assert lane.report.phase == "moves"
        assert lane.report.sentence == "STOP is pressed, and it does not come to rest."
        assert len(robot.stops()) >= 3, "it is sent again for as long as it moves"
        robot.tell(stopped=True, at_rest=True)
        await asyncio.sleep(0.2)
        assert lane.report.phase == "stopped"


@story
async def test_a_robot_that_says_why_it_cannot_stop_is_quoted(robot: Robot) -> None:
    robot.there, robot.refusal = True, "STOP is pressed, but the robot cannot be reached."
    async with pressed(robot) as lane:
        await asyncio.sleep(2)
        assert lane.report.phase == "no_answer"
        assert lane.report.sentence == "STOP is pressed, but the robot cannot be reached."


@story
async def test_what_somebody_releases_is_said_and_not_pressed_anew_by_itself(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        robot.tell(stopped=False, at_rest=True)
        asked = len(robot.stops())
        await asyncio.sleep(30)
        assert (lane.report.phase, len(robot.stops())) == ("released", asked)
        lane.press()
        await asyncio.sleep(0.5)
        assert (lane.report.phase, len(robot.stops())) == ("stopped", asked + 1)


@story
async def test_a_second_press_while_it_is_sent_sends_nothing_twice(robot: Robot) -> None:
    robot.there, robot.answers = True, False
    async with pressed(robot) as lane:
        await asyncio.sleep(0.1)
        for _ in range(20):
            lane.press()
        await asyncio.sleep(0.15)
        assert len(robot.stops()) == 1


@story
async def test_one_whose_answers_are_lost_is_believed_when_its_status_says_that_it_rests(
    robot: Robot,
) -> None:
    robot.there = robot.silently = True
    async with pressed(robot) as lane:
        await asyncio.sleep(1.5)  # its status is listened to after the first answer that is lost
        assert lane.report.phase == "stopped"
        asked = len(robot.stops())
        await asyncio.sleep(5)
        assert len(robot.stops()) == asked


@story
async def test_pressing_again_and_again_does_not_put_off_that_there_is_no_answer(robot: Robot) -> None:
    robot.there, robot.answers = True, False
    async with pressed(robot) as lane:
        for _ in range(6):
            await asyncio.sleep(0.5)
            lane.press()
        assert lane.report.phase == "no_answer"


@story
async def test_a_stopped_robot_that_is_lost_is_not_counted_as_stopped_any_more(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        robot.vanish()
        await asyncio.sleep(12)
        assert lane.report.phase == "lost"
        assert lane.report.sentence.startswith("STOPPED when it was last heard, 12 s ago.")
        robot.arrive()
        assert lane.report.phase == "sent", "what it said before is not what it says now"
        robot.tell(stopped=True, at_rest=True)
        await asyncio.sleep(0.2)
        assert lane.report.phase == "stopped"


@story
async def test_what_a_robot_says_before_the_new_link_is_known_to_be_its_own_counts(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        robot.vanish()
        await asyncio.sleep(3)
        robot.tell(stopped=True, at_rest=True)
        assert lane.report.phase == "lost"
        robot.arrive()
        await asyncio.sleep(5)
        assert lane.report.phase == "stopped"


@story
async def test_what_was_said_over_a_link_that_did_not_come_to_stand_is_forgotten(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        robot.vanish()
        robot.tell(stopped=True, at_rest=True)
        robot.vanish()
        robot.arrive()
        assert lane.report.phase == "sent"


@story
async def test_who_pressed_is_said_of_another_and_not_of_oneself(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        assert lane.report.sentence == "Pressed by Anna."
        robot.by, robot.by_id = "tablet (2)", "another of the same name"
        robot.tell(stopped=True, at_rest=True)
        await asyncio.sleep(0.2)
        assert lane.report.sentence == "Pressed by tablet (2)."
        robot.by_id = public_id("me")
        robot.tell(stopped=True, at_rest=True)
        await asyncio.sleep(0.2)
        assert (lane.report.phase, lane.report.sentence) == ("stopped", "")


@story
async def test_one_that_was_released_while_it_was_lost_is_not_pressed_anew(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        robot.vanish()
        await asyncio.sleep(5)
        asked = len(robot.stops())
        robot.arrive()
        robot.tell(stopped=False, at_rest=True)
        await asyncio.sleep(5)
        assert (lane.report.phase, len(robot.stops())) == ("released", asked)


@story
async def test_a_robot_without_a_stop_gets_zero_speed_for_as_long_as_the_lane_lasts(robot: Robot) -> None:
    robot.there = robot.foreign = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.3)
        for _ in range(20):
            robot.roll(0.3)
            await asyncio.sleep(0.1)
        assert lane.report.phase == "no_answer"
        for _ in range(10):
            robot.roll(0.0)
            await asyncio.sleep(0.1)
        assert (lane.report.phase, lane.report.foreign) == ("stopped", True)
        assert lane.report.sentence.startswith("No STOP of its own: zero speed is sent")
        sent, asked = len(robot.zeros), len(robot.stops())
        await asyncio.sleep(5)
        assert len(robot.stops()) == asked, "it has no such service"
        assert len(robot.zeros) - sent == pytest.approx(50, abs=2)
        assert {(topic, message == Twist()) for topic, message in robot.zeros} == {("/cmd_vel", True)}


@story
async def test_one_that_takes_stamped_commands_is_held_by_them(robot: Robot) -> None:
    robot.there = robot.foreign = True
    robot.topics = {"/base/cmd_vel": "geometry_msgs/TwistStamped"}
    async with pressed(robot):
        await asyncio.sleep(1)
        topic, message = robot.zeros[-1]
        assert (topic, type(message), message.twist) == ("/base/cmd_vel", TwistStamped, Twist())


@story
async def test_one_that_nothing_drives_cannot_be_stopped_and_that_is_said(robot: Robot) -> None:
    robot.there = robot.foreign = True
    robot.topics = {}
    async with pressed(robot) as lane:
        await asyncio.sleep(2)
        assert lane.report.phase == "no_answer"
        assert "cannot be stopped from here" in lane.report.sentence


@story
async def test_the_same_robot_is_known_by_what_it_says(robot: Robot) -> None:
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(0.5)
        assert lane.report.identity == ("Fake-1", "patrol", Time(7, 1))


@story
async def test_a_paired_robot_is_proven_from_the_first_connection_on(robot):
    """The client lets nobody with another key be connected; what it proved outlives the link."""
    key = Credentials("ab" * 32, "me.secret", "Fake-1")
    async with pressed(robot, key) as lane:
        await asyncio.sleep(1.0)
        assert (robot.credentials, lane.report.proven) == (key, "")
        robot.arrive()
        await asyncio.sleep(1.0)
        assert (lane.report.phase, lane.report.proven) == ("stopped", key.fingerprint)
        robot.vanish()
        await asyncio.sleep(1.0)
        assert lane.report.proven == key.fingerprint


@story
async def test_a_robot_that_does_not_know_the_handheld_any_more_is_stopped_all_the_same(robot):
    """A guest whose hour is over, or who was removed, stands beside it: STOP is anybody's."""
    robot.there, robot.knows_key = True, False
    async with pressed(robot, Credentials("ab" * 32, "me.secret", "Fake-1")) as lane:
        await asyncio.sleep(1.0)
        assert "/stop" in [service for _, service in robot.asked]
        assert lane.report.phase == "stopped"


@story
async def test_a_robot_that_is_not_paired_proves_nothing(robot):
    robot.there = True
    async with pressed(robot) as lane:
        await asyncio.sleep(1.0)
        assert (lane.report.phase, lane.report.proven) == ("stopped", "")
