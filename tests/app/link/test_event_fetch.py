"""Missed events are asked for until they have come, one question at a time."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Any

import pytest

from app.link import event_fetch
from app.link.event_fetch import EventFetch
from app.link.event_order import KnownEvents
from app.link.task_set import TaskSet
from bridge.core.errors import BridgeError, NoReply
from bridge.msgs.pilothouse_msgs import Event, GetEventsResponse


class Robot:
    """Stands for the client: what it answers, one after the other."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(event_fetch, "RETRY_DELAY", 0.0)
        self.answers: list[Any] = []
        self.asked = 0
        self.heard: list[str] = []
        self.known: list[KnownEvents] = []
        self.tasks = TaskSet()
        self.fetch = EventFetch(
            self,  # type: ignore[arg-type]
            self.tasks,
            on_event=lambda event: self.heard.append(event.text),
            on_missed=lambda _: None,
            on_known=self.known.append,
            known=KnownEvents("boot", 1),
        )

    async def call(self, *_: object, **__: object) -> GetEventsResponse:
        self.asked += 1
        await asyncio.sleep(0)
        answer = self.answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer

    async def catch_up(self) -> None:
        self.fetch.catch_up()
        for _ in range(20):
            await asyncio.sleep(0)


@pytest.fixture
async def robot(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Robot]:
    robot = Robot(monkeypatch)
    robot.fetch.on_connected()
    yield robot
    await robot.tasks.cancel()


def stored(*numbers: int, more: bool = False) -> GetEventsResponse:
    events = [Event(id=number, boot="boot", text=str(number)) for number in numbers]
    return GetEventsResponse(events=events, oldest=1, more=more)


async def test_what_was_missed_is_asked_for_part_by_part(robot: Robot) -> None:
    robot.answers = [stored(2, 3, more=True), stored(4)]
    await robot.catch_up()
    assert (robot.asked, robot.heard, robot.known[-1].last) == (2, ["2", "3", "4"], 4)


async def test_a_question_without_an_answer_is_asked_again(robot: Robot) -> None:
    robot.answers = [NoReply("nothing came"), stored(2)]
    await robot.catch_up()
    assert (robot.asked, robot.heard) == (2, ["2"])


async def test_a_robot_that_refuses_is_not_asked_again(robot: Robot) -> None:
    robot.answers = [BridgeError("no such service")]
    await robot.catch_up()
    robot.fetch.on_live(Event(id=7, boot="boot", text="7"))
    assert (robot.asked, robot.heard) == (1, ["7"])


async def test_one_question_at_a_time(robot: Robot) -> None:
    robot.answers = [stored(2)]
    robot.fetch.catch_up()
    await robot.catch_up()
    assert robot.asked == 1


async def test_a_lost_link_ends_the_question(robot: Robot) -> None:
    robot.answers = [stored(2)]
    robot.fetch.catch_up()
    robot.fetch.on_lost()
    for _ in range(5):
        await asyncio.sleep(0)
    assert robot.heard == []
