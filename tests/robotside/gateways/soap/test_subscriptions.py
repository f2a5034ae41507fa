"""Subscriptions: bounded, of the newest, for who may read, and over when nobody wants them."""

from __future__ import annotations

import asyncio

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs.pilothouse_msgs import Event, TagRead
from robotside.gateways.payloads.table import KEYS
from robotside.gateways.plain.outbox import MAX_EVENTS
from robotside.gateways.soap import subscriptions as module
from robotside.gateways.soap.subscriptions import (
    MAX_PER_HOST,
    MAX_SUBSCRIPTIONS,
    Subscribed,
    Subscriptions,
    readable,
)
from tests.robotside.gateways.soap.served import Gate, Served, serving
from tests.robotside.scene import Scene

PERIOD = 1e-6


@pytest.fixture
def watcher(scene: Scene) -> Operator:
    return scene.door.join("192.0.2.7:5000", way="soap", role=Role.WATCH)


@pytest.fixture
async def subscriptions(scene: Scene) -> Subscriptions:
    return Subscriptions(scene.door, KEYS, PERIOD)


def names(subscribed: Subscribed) -> list[str]:
    return [topic.name for topic, _ in subscribed.take()]


async def test_the_newest_of_each_topic_waits_and_each_event_bounded(
    scene: Scene, subscriptions: Subscriptions, watcher: Operator
) -> None:
    made = subscriptions.open(watcher, ["/odom", "/events", "/robot/info", "/odom"])
    assert names(made) == ["/robot/info"]
    scene.run(2.0)
    assert names(made) == ["/odom"]
    for number in range(MAX_EVENTS + 20):
        scene.station.bus.publish("/events", Event(text=str(number)))
    read = [msg.text for _, msg in made.take() if isinstance(msg, Event)]
    assert read == [str(number) for number in range(20, MAX_EVENTS + 20)]


async def test_it_waits_for_what_comes(scene: Scene, subscriptions: Subscriptions, watcher: Operator) -> None:
    made = subscriptions.open(watcher, ["/tag"])
    assert await made.news(0.0) == []
    waiting = asyncio.create_task(made.news(60.0))
    await asyncio.sleep(0)
    scene.station.bus.publish("/tag", TagRead(tag="x"))
    assert [topic.name for topic, _ in await waiting] == ["/tag"]


async def test_a_camera_works_only_while_a_subscription_wants_it(
    scene: Scene, subscriptions: Subscriptions, watcher: Operator
) -> None:
    topic = "/camera/image/compressed"
    made = subscriptions.open(watcher, [topic])
    assert scene.robot.wanted[topic]
    subscriptions.end(made)
    subscriptions.end(made)
    assert not scene.robot.wanted[topic]


async def test_it_ends_when_nobody_fetches_it_and_not_before(
    scene: Scene, subscriptions: Subscriptions, watcher: Operator, monkeypatch: pytest.MonkeyPatch
) -> None:
    ended: list[Subscribed] = []
    subscriptions.on_end = ended.append
    made, other = (subscriptions.open(watcher, ["/odom"]) for _ in range(2))
    made.until = other.until = asyncio.get_running_loop().time() - 1.0
    assert subscriptions.find(made.id) is made
    assert made.until > asyncio.get_running_loop().time() + module.LIFETIME / 2
    subscriptions.end_overdue()
    assert ended == [other]
    with pytest.raises(Refused, match="no such subscription"):
        subscriptions.find(other.id)
    subscriptions.end_all()
    assert len(subscriptions) == 0
    assert scene.door._operators >= {watcher}
    assert len(scene.door._operators) == 1


async def test_there_are_a_bounded_number_of_one_host_and_of_all(
    scene: Scene, subscriptions: Subscriptions, watcher: Operator
) -> None:
    for _ in range(MAX_PER_HOST):
        subscriptions.open(watcher, ["/odom"])
    with pytest.raises(Refused, match=f"{MAX_PER_HOST} subscriptions already"):
        subscriptions.open(watcher, ["/odom"])
    for number in range(MAX_SUBSCRIPTIONS - MAX_PER_HOST):
        subscriptions.open(scene.door.join(f"192.0.2.{number + 10}:1", role=Role.WATCH), ["/odom"])
    with pytest.raises(Refused, match=f"{MAX_SUBSCRIPTIONS} subscriptions already"):
        subscriptions.open(scene.door.join("192.0.2.200:1", role=Role.WATCH), ["/odom"])


async def test_who_may_not_read_a_topic_does_not_and_who_may_not_any_more_neither(scene: Scene) -> None:
    async with serving(scene, gate=Gate()) as served:
        made = (await served.ask("Subscribe", token="watch", topic="/odom")).value("subscription")
        assert (await served.ask("FetchMessages", token="watch", subscription=made)).status == 200
        open_ = served.gateway._subscriptions._open[made or ""]
        open_.operator.identity = STRANGER
        assert "pair with it" in (await served.ask("FetchMessages", subscription=made)).fault[1]
        assert "no such subscription" in (await served.ask("FetchMessages", subscription=made)).fault[1]
        again = (await served.ask("Subscribe", token="watch", topic="/odom")).value("subscription")
        served.door.expel(["id-watch"])
        assert "no such subscription" in (await served.ask("Renew", subscription=again)).fault[1]


async def test_it_is_fetched_renewed_and_ended_by_its_id(scene: Scene) -> None:
    async with serving(scene) as served:
        await _by_its_id(served)


async def _by_its_id(served: Served) -> None:
    made = (await served.ask("Subscribe", topic=["/odom", "/control/status"])).value("subscription")
    fetched = await served.ask("FetchMessages", subscription=made)
    assert fetched.value("topic") == "/control/status"
    assert (await served.ask("Renew", subscription=made)).value("subscription") == made
    assert (await served.ask("Unsubscribe", subscription=made)).value("message")
    for name, said in (("/nowhere", "no topic"), ("/cmd_vel", "no topic"), ("", "topic")):
        assert said in (await served.ask("Subscribe", topic=name)).fault[1]
    assert "one topic" in (await served.ask("Subscribe")).fault[1]


def test_who_has_no_role_reads_and_subscribes_to_nothing(scene: Scene) -> None:
    nobody = scene.door.join("192.0.2.9:1", role=Role.NONE)
    with pytest.raises(Refused) as refused:
        readable(scene.door, KEYS, nobody, "/odom")
    assert refused.value.args[0].code == Code.TRUST_UNKNOWN
