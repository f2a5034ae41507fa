"""A robot is asked what it offers until it answers, and a foreign one from time to time afterwards."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Any

import pytest

from app.link import capability_watch
from app.link.capabilities import Capabilities
from app.link.capability_watch import CapabilityWatch
from app.link.task_set import TaskSet
from bridge.core.errors import NoReply
from bridge.core.topics import TOPICS
from bridge.msgs.rosapi_msgs import ServicesResponse, TopicsResponse

OURS = {entry.name: entry.type.MSGTYPE for entry in TOPICS}


class Robot:
    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(capability_watch, "RETRY_DELAY", 0.0)
        monkeypatch.setattr(capability_watch, "RENEW_PERIOD", 0.0)
        self.topics: dict[str, str] | None = None
        self.changes: list[Capabilities] = []
        self.arrivals: list[bool] = []
        self.tasks = TaskSet()
        self.watch = CapabilityWatch(
            self.call, self.tasks, on_change=self.changes.append, on_arrived=self.arrivals.append
        )

    async def call(self, service: str, *_: object, **__: object) -> Any:
        await asyncio.sleep(0)
        if self.topics is None:
            raise NoReply("nothing came")
        if service == "/rosapi/services":
            return ServicesResponse(services=["/stop"])
        return TopicsResponse(topics=list(self.topics), types=list(self.topics.values()))

    async def wait(self) -> None:
        for _ in range(60):
            await asyncio.sleep(0)


@pytest.fixture
async def robot(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Robot]:
    robot = Robot(monkeypatch)
    yield robot
    await robot.tasks.cancel()


async def test_a_robot_that_does_not_answer_is_asked_until_it_does(robot: Robot) -> None:
    robot.watch.on_connected()
    await robot.wait()
    assert (robot.arrivals, robot.changes, robot.watch.settled) == ([False], [], False)
    assert robot.watch.drive_topic == "/cmd_vel", "the usual name is tried"
    robot.topics = OURS
    await robot.wait()
    assert (robot.arrivals, len(robot.changes), robot.watch.settled) == ([False], 1, True)
    assert not robot.watch.foreign
    assert robot.watch.steers


async def test_a_foreign_robot_is_asked_again_and_a_change_is_reported_once(robot: Robot) -> None:
    robot.topics = {"/odom": "nav_msgs/Odometry"}
    robot.watch.on_connected()
    await robot.wait()
    assert (robot.arrivals, len(robot.changes), robot.watch.settled) == ([True], 1, False)
    assert (robot.watch.foreign, robot.watch.drive_topic) == (True, None)
    robot.topics = {**robot.topics, "/cmd_vel": "geometry_msgs/Twist"}
    await robot.wait()
    assert len(robot.changes) == 2
    assert robot.watch.drive_topic == "/cmd_vel"


async def test_nothing_is_asked_over_a_link_that_is_gone(robot: Robot) -> None:
    robot.watch.on_connected()
    robot.watch.on_lost()
    robot.topics = OURS
    await robot.wait()
    assert robot.changes == []
