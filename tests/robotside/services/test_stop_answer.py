"""STOP acts at once and is answered when it is on the disk, or after a moment with a sentence that it is not."""

from __future__ import annotations

import asyncio

import pytest

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from tests.fakes import FakeClient
from tests.robotside.slow import FULL, Slow


@pytest.fixture
def slow() -> Slow:
    return Slow()


async def pressed(slow: Slow) -> asyncio.Task[Msg]:
    """STOP is pressed, and its answer is waited for."""
    given = slow.ask("/stop", CommandRequest(client_name="Anna"))
    assert not isinstance(given, Msg)
    task = asyncio.ensure_future(given)
    await asyncio.sleep(0)
    return task


async def test_stop_acts_and_is_told_before_it_is_saved_and_answered_when_it_is(slow: Slow) -> None:
    task = await pressed(slow)
    assert slow.station.controls.stopped
    assert slow.robot.at_rest
    assert slow.last("/control/status").stopped
    again = await pressed(slow)
    assert (task.done(), again.done()) == (False, False), (
        "the second has nothing to write and waits with the first"
    )
    slow.write()
    for each in (task, again):
        answer = await each
        assert isinstance(answer, CommandResponse)
        assert (answer.success, answer.message) == (True, "Stopped.")
    slow.restart()
    assert slow.station.controls.stopped_by == "Anna"


async def test_a_disk_that_fails_meanwhile_is_in_the_answer(slow: Slow) -> None:
    task = await pressed(slow)
    slow.write(FULL)
    answer = await task
    assert isinstance(answer, CommandResponse)
    assert answer.message == f"Stopped. A restart of the robot's computer would release it. {FULL}"


async def test_a_stop_by_who_has_no_session_is_answered_as_late(slow: Slow) -> None:
    task = asyncio.ensure_future(slow.door.stop(FakeClient()))
    await asyncio.sleep(0)
    assert slow.station.controls.stopped
    assert not task.done()
    slow.write()
    assert (await task).message == "Stopped."
    late = asyncio.ensure_future(slow.door.stop(FakeClient()))
    assert (await late).message == "Stopped.", "it is on the disk already"


async def test_a_stop_right_after_a_release_is_answered_when_it_is_saved_and_not_by_what_is_there_of_the_one_before(
    slow: Slow,
) -> None:
    task = await pressed(slow)
    slow.write()
    await task
    client = FakeClient("anna", slow.clock)
    slow.door.call(client, "/stop/hold", CommandRequest(client_name="Anna"))
    slow.clock += 1.5
    slow.door.call(client, "/stop/release", CommandRequest(client_name="Anna"))
    assert not slow.station.controls.stopped
    task = await pressed(slow)
    slow.disk.answer("")  # the release, which is older
    await asyncio.sleep(0)
    assert not task.done()
    slow.write()
    assert (await task).message == "Stopped."
    slow.restart()
    assert slow.station.controls.stopped_by == "Anna"


async def test_who_gives_up_waiting_leaves_nothing_behind_and_stop_pressed(slow: Slow) -> None:
    task = await pressed(slow)
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    slow.write()
    slow.restart()
    assert slow.station.controls.stopped


async def test_a_stop_pressed_while_the_robot_side_ends_outlives_it(slow: Slow) -> None:
    slow.station.end()
    task = await pressed(slow)
    slow.write()
    await task
    slow.restart()
    assert slow.station.controls.stopped_by == "Anna"


def test_the_stop_of_a_robot_side_that_ends_does_not_outlive_it(slow: Slow) -> None:
    slow.station.end()
    slow.write()
    slow.restart()
    assert not slow.station.controls.stopped
