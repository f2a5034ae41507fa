"""A robot of another maker is brought to rest when its driver falls silent or leaves."""

from __future__ import annotations

import asyncio
import json

import pytest

from bridge.driving.drive_rest import SILENCE_TIMEOUT, DriveRest
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.std_msgs import Header, String, Time
from tests.bridge.client.test_client_drive import AHEAD, Driver
from tests.bridge.wires import Clock

STAMPED = TwistStamped(Header(Time(5, 0), "base_link"), AHEAD)


class Rest(DriveRest):
    """With a clock that the test moves, and what was sent."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.sent: list[tuple[str, object]] = []
        super().__init__(lambda topic, msg: self.sent.append((topic, msg)), self.clock)

    def pass_time(self, seconds: float) -> None:
        self.clock.time += seconds
        self.check()


def test_after_a_silence_zero_is_sent_once() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.pass_time(SILENCE_TIMEOUT - 0.01)
    assert rest.sent == []
    rest.pass_time(0.01)
    rest.pass_time(10.0)
    assert rest.sent == [("/cmd_vel", Twist())]


def test_who_goes_on_driving_is_left_alone() -> None:
    rest = Rest()
    for _ in range(20):
        rest.note("/cmd_vel", AHEAD)
        rest.pass_time(SILENCE_TIMEOUT - 0.05)
    assert rest.sent == []


def test_zero_ends_it_and_other_messages_are_no_commands() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.note("/cmd_vel", Twist())
    rest.note("/chatter", String("a"))
    rest.pass_time(1.0)
    rest.rest_all()
    assert rest.sent == []


def test_each_topic_rests_in_its_own_form_and_stamped_later() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.note("/stamped", STAMPED)
    rest.clock.time += 0.125
    rest.rest_all()
    later = TwistStamped(Header(Time(5, 125_000_000), "base_link"))
    assert rest.sent == [("/cmd_vel", Twist()), ("/stamped", later)]


def test_on_a_lost_connection_nothing_is_left_to_be_sent() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.forget()
    rest.pass_time(1.0)
    assert rest.sent == []


def speeds(driver: Driver) -> list[float]:
    return [said["msg"]["linear"]["x"] for said in driver.wire.sent if said["op"] == "publish"]


@pytest.mark.parametrize(("ours", "expected"), [(False, [0.4, 0.0]), (True, [0.4])])
async def test_closing_sends_zero_to_a_robot_of_another_maker_alone(
    ours: bool, expected: list[float]
) -> None:
    driver = Driver(ours=ours)
    assert driver.drives()
    await driver.client.close()
    assert speeds(driver) == expected
    assert json.dumps(driver.wire.sent[-1])


async def test_the_client_checks_for_silence_by_itself() -> None:
    driver = Driver(ours=False)
    checking = asyncio.create_task(driver.client._rest.run())
    assert driver.drives()
    driver.clock.time += SILENCE_TIMEOUT
    said = asyncio.Event()
    driver.wire.on_sent = said.set
    async with asyncio.timeout(10.0):
        await said.wait()
    assert speeds(driver) == [0.4, 0.0]
    checking.cancel()
    await asyncio.gather(checking, return_exceptions=True)
