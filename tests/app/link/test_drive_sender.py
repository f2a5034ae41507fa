"""Drive commands reach the robot by the topic of their type, and rest reaches it whatever is not known."""

from __future__ import annotations

import asyncio
import math
from collections.abc import AsyncIterator
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.command_origin import Origin, origins
from app.link.capabilities import Capabilities
from app.link.drive_sender import DriveSender
from bridge.core.topics import TOPICS
from bridge.msgs.geometry_msgs import Twist, TwistStamped, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from tests.bridge.wires import Clock

OURS = Capabilities.of({entry.name: entry.type.MSGTYPE for entry in TOPICS}, frozenset({"/stop"}))
STAMPED = Capabilities.of({"/cmd_vel": "geometry_msgs/TwistStamped"}, frozenset())
AHEAD = Twist(linear=Vector3(x=0.4))


class Road:
    """The sender, and what went out by it."""

    def __init__(self) -> None:
        self.clock, self.stamp, self.forbidden = Clock(), 50.0, False
        self.sent: list[tuple[str, Any, float | None]] = []
        client: Any = SimpleNamespace(robot_time=lambda: self.stamp, publish=self._publish)
        network: Any = SimpleNamespace(call=lambda wake: wake())
        self.robot: Any = SimpleNamespace(
            capabilities=None, foreign=False, steers=False, drive_topic="/cmd_vel"
        )
        self.health: Any = SimpleNamespace(silent=False, measure=lambda: None)
        self.sender = DriveSender(
            client, network, self.robot, self.health, now=self.clock, forbidden=lambda: self.forbidden
        )
        self.sender.slot.beat()

    def offers(self, offer: Capabilities) -> None:
        robot = self.robot
        robot.capabilities, robot.foreign = offer, not offer.ours
        robot.steers, robot.drive_topic = offer.steers, offer.drive

    def _publish(
        self, topic: str, message: Any, *, stamp: float | None = None, even_late: bool = False
    ) -> None:
        self.sent.append((topic, message, stamp))

    async def step(self) -> list[tuple[str, Any, float | None]]:
        """What goes out at the next look at the slot."""
        self.sent.clear()
        self.clock.time += 0.06
        self.sender.slot.beat()
        self.sender.wake()
        for _ in range(4):
            await asyncio.sleep(0)
        return list(self.sent)


@pytest.fixture
async def road() -> AsyncIterator[Road]:
    road = Road()
    task = asyncio.get_running_loop().create_task(road.sender.run())
    yield road
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)


async def test_what_is_wanted_goes_out_with_the_robots_clock_and_says_who_drives(road: Road) -> None:
    with origins.during(Origin("gamepad")):
        road.sender.want(AHEAD)
    assert await road.step() == [("/cmd_vel", AHEAD, 50.0)]
    assert road.sender.driven_by.method == "gamepad"


@pytest.mark.parametrize("hindrance", ["silence", "STOP", "no clock"])
async def test_nothing_moves_a_robot_of_ours_while_it_must_not(road: Road, hindrance: str) -> None:
    road.offers(OURS)
    road.sender.want(AHEAD)
    await road.step()
    road.health.silent, road.forbidden = hindrance == "silence", hindrance == "STOP"
    road.stamp = math.nan if hindrance == "no clock" else road.stamp
    ((_, order, stamp),) = await road.step()
    assert order == Twist()
    assert (stamp is None) == (hindrance == "no clock")
    road.health.silent, road.forbidden, road.stamp = False, False, 51.0
    assert all(order == Twist() for _, order, _ in await road.step()), "the stick must be pushed anew"


async def test_a_foreign_robot_is_driven_without_its_clock_by_its_own_type(road: Road) -> None:
    road.offers(STAMPED)
    road.stamp = math.nan
    road.sender.want(AHEAD)
    ((topic, order, _),) = await road.step()
    assert (topic, type(order), order.twist) == ("/cmd_vel", TwistStamped, AHEAD)


async def test_a_manoeuvre_goes_only_to_a_robot_that_takes_it(road: Road) -> None:
    steer = Manoeuvre(kind="steer", speed=0.5, steering=0.1)
    road.sender.want(steer)
    assert await road.step() == []
    road.offers(OURS)
    ((topic, order, _),) = await road.step()
    assert (topic, order.kind, order.header.stamp.seconds) == ("/cmd_manoeuvre", "steer", 50.0)


async def test_latched_it_sends_rest_again_and_again(road: Road) -> None:
    road.offers(STAMPED)
    road.sender.latch(True)
    road.sender.want(AHEAD)
    for _ in range(6):
        road.clock.time += 0.1
        ((_, order, stamp),) = await road.step()
        assert (order.twist, stamp) == (Twist(), None)


async def test_a_foreign_robot_that_was_driven_is_brought_to_rest_over_the_next_link(road: Road) -> None:
    road.offers(STAMPED)
    road.sender.on_connected()
    assert road.sent == [], "who only watched says nothing"
    road.sender.want(AHEAD)
    await road.step()
    road.sender.on_lost()
    road.sent.clear()
    road.sender.on_connected()
    assert [order.twist for _, order, _ in road.sent] == [Twist()]


@pytest.mark.parametrize("moves", [True, False])
async def test_at_the_end_a_robot_that_moves_is_sent_rest(road: Road, moves: bool) -> None:
    if moves:
        road.sender.want(AHEAD)
    await road.step()
    road.sent.clear()
    road.sender.finish()
    assert [order for _, order, _ in road.sent] == ([Twist()] if moves else [])
