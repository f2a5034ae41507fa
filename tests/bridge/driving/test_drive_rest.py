"""A robot of another maker is brought to rest when its driver falls silent or leaves."""

from __future__ import annotations

import asyncio

import pytest

from bridge.client.client import Phase
from bridge.core.async_tasks import UntilClosed
from bridge.core.errors import ProtocolError
from bridge.driving import drive_rest
from bridge.driving.drive_rest import MAX_LAST_TRIES, SILENCE_TIMEOUT, DriveRest
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.std_msgs import Header, String, Time
from tests.bridge.client.test_client_drive import AHEAD, Driver
from tests.bridge.wires import Clock

STAMPED = TwistStamped(Header(Time(5, 0), "base_link"), AHEAD)


class Rest(DriveRest):
    """With a clock that the test moves, and what was sent."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.sent: list[tuple[str, Msg]] = []
        self.tries = 0
        self.full = 0
        """So many more tries are in vain."""
        super().__init__(self.send, self.clock)

    def send(self, topic: str, msg: Msg) -> bool:
        self.tries += 1
        self.full -= 1
        if self.full >= 0:
            return False
        self.sent.append((topic, msg))
        return True

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


async def test_zero_ends_it_and_other_messages_are_no_commands() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.note("/cmd_vel", Twist())
    rest.note("/chatter", String("a"))
    rest.pass_time(1.0)
    assert await rest.end()
    assert rest.sent == []


async def test_each_topic_rests_in_its_own_form_and_stamped_later() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.note("/stamped", STAMPED)
    rest.clock.time += 0.125
    assert await rest.end()
    later = TwistStamped(Header(Time(5, 125_000_000), "base_link"))
    assert rest.sent == [("/cmd_vel", Twist()), ("/stamped", later)]


def test_on_a_lost_connection_nothing_is_left_to_be_sent() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.forget()
    rest.pass_time(1.0)
    assert rest.sent == []


def test_zero_that_could_not_be_sent_is_tried_at_each_check_until_it_is() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.full = 3
    rest.pass_time(SILENCE_TIMEOUT)
    rest.pass_time(0.05)
    rest.pass_time(0.05)
    assert (rest.tries, rest.sent) == (3, [])
    rest.pass_time(0.05)
    rest.pass_time(0.05)
    assert (rest.tries, rest.sent) == (4, [("/cmd_vel", Twist())])


def test_one_topic_that_cannot_be_sent_holds_up_no_other() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.note("/other", AHEAD)
    rest.full = 1
    rest.pass_time(SILENCE_TIMEOUT)
    assert rest.sent == [("/other", Twist())]
    rest.pass_time(0.05)
    assert rest.sent == [("/other", Twist()), ("/cmd_vel", Twist())]


def test_who_drives_again_before_zero_could_be_sent_is_left_alone() -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.full = 1
    rest.pass_time(SILENCE_TIMEOUT)
    rest.note("/cmd_vel", AHEAD)
    rest.pass_time(SILENCE_TIMEOUT - 0.01)
    assert rest.sent == []


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """The next try is at the loop's next turn."""
    monkeypatch.setattr(drive_rest, "CHECK_PERIOD", 0.0)


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize(("full", "tries"), [(0, 1), (3, 4), (100, MAX_LAST_TRIES)])
async def test_at_the_end_zero_is_tried_until_it_is_sent_or_the_time_is_over(full: int, tries: int) -> None:
    rest = Rest()
    rest.note("/cmd_vel", AHEAD)
    rest.full = full
    assert await rest.end() is (full < MAX_LAST_TRIES)
    assert rest.tries == tries
    assert rest.sent == ([("/cmd_vel", Twist())] if full < MAX_LAST_TRIES else [])


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


@pytest.mark.usefixtures("quick")
async def test_a_client_whose_socket_was_full_sends_zero_as_soon_as_it_is_not() -> None:
    driver = Driver(ours=False)
    checking = asyncio.create_task(driver.client._rest.run())
    assert driver.drives()
    driver.clock.time += SILENCE_TIMEOUT
    driver.wire.full = True
    for _ in range(10):
        await asyncio.sleep(0)
    assert speeds(driver) == [0.4]
    said = asyncio.Event()
    driver.wire.on_sent = said.set
    driver.wire.full = False
    async with asyncio.timeout(10.0):
        await said.wait()
    assert speeds(driver) == [0.4, 0.0]
    checking.cancel()
    await asyncio.gather(checking, return_exceptions=True)


async def test_a_client_that_is_closed_while_its_socket_is_full_sends_zero_before_it_leaves() -> None:
    driver = Driver(ours=False)
    assert driver.drives()
    driver.wire.full = True
    closing = asyncio.create_task(driver.client.close())
    await asyncio.sleep(0)
    assert speeds(driver) == [0.4]
    driver.wire.full = False
    await closing
    assert speeds(driver) == [0.4, 0.0]
    assert driver.client.state.phase is Phase.CLOSED


@pytest.mark.usefixtures("quick")
async def test_a_client_whose_socket_stays_full_is_closed_all_the_same_and_the_log_says_so(
    caplog: pytest.LogCaptureFixture,
) -> None:
    driver = Driver(ours=False)
    assert driver.drives()
    driver.wire.full = True
    await driver.client.close()
    assert speeds(driver) == [0.4]
    assert driver.client.state.phase is Phase.CLOSED
    assert caplog.messages == ["robot:9090 could not be told to rest: nothing more could be sent to it"]


async def for_ever() -> None:
    await asyncio.Event().wait()


async def test_who_gives_up_closing_ends_the_link_nevertheless() -> None:
    driver = Driver(ours=False)
    driver.client._work = UntilClosed(for_ever)
    running = asyncio.create_task(driver.client.run())
    await asyncio.sleep(0)
    assert driver.drives()
    driver.wire.full = True
    closing = asyncio.create_task(driver.client.close())
    await asyncio.sleep(0)
    closing.cancel()
    await asyncio.gather(closing, return_exceptions=True)
    async with asyncio.timeout(10.0):
        await running


async def test_a_command_that_cannot_be_written_drives_nothing() -> None:
    driver = Driver(ours=False)
    unfit = TwistStamped(Header(Time(5, 0), "\ud800"), AHEAD)
    with pytest.raises(ProtocolError):
        driver.client.publish("/cmd_vel", unfit, stamp=7000.0)
    await driver.client.close()
    assert driver.wire.sent == []
