"""What goes to a broker: each topic with its type at the birth, and numbers by which a reader sees what was lost."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest

from bridge.core.identity import Role
from bridge.msgs.pilothouse_msgs import Event
from robotside.gateways.broker.topic_feed import Sent, TopicFeed
from robotside.gateways.gateway_url import read_url
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(5.0)
    return made


def feed_of(scene: Scene, options: str = "rate=50", role: Role = Role.WATCH) -> TopicFeed:
    return TopicFeed(scene.door, "broker", read_url(f"mqtt://192.0.2.7?{options}", {"mqtt": 1883}), role)


def test_the_birth_lists_what_comes_with_types_and_counts_the_births(scene: Scene) -> None:
    feed = feed_of(scene)
    for number in (1, 2):
        birth = json.loads(feed.birth())
        assert (birth["robot"], birth["boot"], birth["birth"], birth["seq"]) == ("Fake-1", "b1", number, 0)
    assert birth["topics"]["/odom"] == {"type": "nav_msgs/Odometry", "rate": 20, "latched": False}
    assert birth["topics"]["/sim/ground_truth"]["on_demand"]
    assert "/cmd_vel" not in birth["topics"]


def test_what_is_not_carried_or_not_allowed_is_not_listed_and_does_not_come(scene: Scene) -> None:
    assert "/scan" not in json.loads(feed_of(scene, "payloads=wheels").birth())["topics"]
    nobody = feed_of(scene, role=Role.NONE)
    assert "/control/status" not in json.loads(nobody.birth())["topics"]
    nobody.begin()
    coming = []
    while (found := nobody._outbox.take(0.0)) is not None:
        coming.append(found[0])
    assert "/control/status" not in coming
    nobody.end()


async def test_each_topic_is_numbered_from_its_birth_on(scene: Scene) -> None:
    feed, sent = feed_of(scene), list[Sent]()

    async def send(message: Sent) -> None:
        sent.append(message)

    async def numbers() -> list[int]:
        sent.clear()
        for text in ("a", "b", "file \udcff is bad", "c"):  # what cannot be written has no number
            feed._put(scene.door.topics["/events"], "/events", Event(text=text))
        for _ in range(100):
            await asyncio.sleep(0)
        return [each.number for each in sent if each.name == "/events"]

    running = asyncio.create_task(feed.run(send))
    feed.begin()
    assert await numbers() == [0, 1, 2]
    assert await numbers() == [3, 4, 5]
    feed.end()
    feed.begin()
    assert await numbers() == [0, 1, 2]
    assert {each.latched for each in sent if each.name == "/control/status"} == {True}
    running.cancel()
    feed.end()
    assert not scene.door._operators
    assert not scene.door._subscriptions
