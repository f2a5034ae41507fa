"""STOP on a disk that is full: pressed all the same, and said that a restart would release it."""

from __future__ import annotations

import asyncio

import pytest

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, Event
from tests.fakes import FakeClient
from tests.robotside.slow import FULL, Slow


@pytest.fixture
def slow() -> Slow:
    return Slow()


def press(slow: Slow) -> str:
    """Press STOP and let the disk be; what is answered."""

    async def answered() -> Msg:
        given = slow.ask("/stop", CommandRequest(client_name="Anna"))
        return given if isinstance(given, Msg) else await given

    answer = asyncio.run(answered())
    assert isinstance(answer, CommandResponse)
    assert answer.success
    return answer.message


NOT_YET = "Stopped. It is not saved yet: a restart of the robot's computer just now would release it."


def hear(slow: Slow) -> list[str]:
    heard: list[str] = []

    def take(_: str, msg: Msg) -> None:
        if isinstance(msg, Event) and msg.kind == "stop":
            heard.append(msg.text)

    slow.station.bus.subscribe("/events", take)
    heard.clear()  # the last one is told to who comes later
    return heard


UNKEPT = (
    f"That STOP is pressed could not be saved: a restart of the robot's computer would release it. {FULL}"
)


def test_a_stop_that_is_not_kept_is_pressed_and_says_so_until_it_is(slow: Slow) -> None:
    heard = hear(slow)
    assert press(slow) == NOT_YET
    slow.write(FULL)
    assert slow.station.controls.stopped
    assert heard == ["STOP pressed by Anna.", UNKEPT]
    slow.records.try_again()
    slow.write(FULL)
    assert press(slow) == f"Stopped. A restart of the robot's computer would release it. {FULL}"
    slow.records.try_again()
    slow.write()
    assert heard[2:] == ["STOP is pressed, and this is saved now."]
    assert press(slow) == "Stopped."
    slow.restart()
    assert slow.station.controls.stopped_by == "Anna"


def test_a_stop_that_was_never_kept_is_gone_after_a_restart_as_was_said(slow: Slow) -> None:
    press(slow)
    slow.write(FULL)
    slow.restart()
    assert not slow.station.controls.stopped


def test_a_release_that_is_not_kept_says_that_stop_will_be_pressed_again(slow: Slow) -> None:
    press(slow)
    slow.write()
    heard = hear(slow)
    client = FakeClient("anna", slow.clock)
    slow.door.call(client, "/stop/hold", CommandRequest(client_name="Anna"))
    slow.clock += 1.5
    slow.door.call(client, "/stop/release", CommandRequest(client_name="Anna"))
    slow.write(FULL)
    said = (
        f"That STOP is released could not be saved: a restart of the robot's computer would press it. {FULL}"
    )
    assert heard == ["STOP released by Anna.", said]


def test_a_stop_that_was_kept_is_not_talked_about(slow: Slow) -> None:
    heard = hear(slow)
    press(slow)
    slow.write()
    assert heard == ["STOP pressed by Anna."]
