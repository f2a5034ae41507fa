"""A broker that is absent, dies, falls silent, refuses, fills up, or has another robot of that name: the robot goes on."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event
from robotside.gateways.kafka import kafka_line
from tests.fakes import FakeRobot
from tests.robotside import scene as scenes
from tests.robotside.gateways.kafka.client import (
    ROOT,
    client,
    codes,
    driving,
    hold_back,
    online,
    serving,
    until,
)
from tests.robotside.gateways.kafka.cluster import STORAGE, UNAUTHORIZED, UNKNOWN, Cluster
from tests.robotside.scene import Scene

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def hasty(patient: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """A broker that does not answer for so long is lost."""
    monkeypatch.setattr(kafka_line, "ANSWER_TIMEOUT", 1.0)


def losses(scene: Scene) -> list[str]:
    """What was said of losses."""
    return [msg.text for _, msg in scene.said if isinstance(msg, Event) and msg.code == Code.GATEWAY_LOST]


async def test_the_robot_rests_when_its_broker_dies_and_obeys_nothing_old_when_it_is_back(
    scene: Scene, cluster: Cluster
) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        await driving(scene, me)
        gate = hold_back(gateway._commands)
        cluster.down()
        await until(lambda: scene.robot.at_rest)
        assert not scene.control.driver
        await until(lambda: any("Kafka broker at" in each for each in losses(scene)))
        assert all("it does not answer" in each for each in losses(scene))
        cluster.up()
        await me.send("call", "/control/acquire")
        gate.set()
        await online(gateway)
        await until(lambda: Code.GATEWAY_UP in codes(scene))
        await me.ask("call", "/rosapi/get_time")
        assert not scene.control.driver
        assert (await me.ask("call", "/control/acquire"))["success"]


async def test_a_broker_that_is_absent_is_an_event_and_is_reached_when_it_comes(
    scene: Scene, cluster: Cluster
) -> None:
    cluster.down()
    async with serving(scene, cluster) as gateway:
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        cluster.up()
        await online(gateway)
        async with client(scene, cluster) as me:
            assert (await me.ask("call", "/control/acquire"))["success"]
    assert codes(scene).count(Code.GATEWAY_LOST) == 1


@pytest.mark.parametrize("fault", ["silent", "full"])
async def test_a_broker_that_falls_silent_or_is_full_leaves_the_robot_at_rest_and_is_reached_again(
    fault: str, scene: Scene, cluster: Cluster
) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        await driving(scene, me)
        if fault == "silent":
            cluster.slow(60.0)
        else:
            cluster.take_nothing([STORAGE] * 10_000)
        await until(lambda: scene.robot.at_rest and Code.GATEWAY_LOST in codes(scene))
        cluster.slow(0.0)
        cluster.take_all()
        if fault == "silent":  # what is under way comes late: the robot does not wait for it
            cluster.down()
            cluster.up()
        await until(lambda: Code.GATEWAY_UP in codes(scene))
        assert not scene.control.driver


@pytest.mark.parametrize(
    ("topic", "error", "what"),
    [
        ("commands", UNAUTHORIZED, "The Kafka broker"),
        ("stop", UNAUTHORIZED, "STOP has no connection"),
        ("stop", UNKNOWN, "STOP has no connection"),
    ],
)
async def test_a_broker_that_refuses_a_topic_is_an_event_that_says_what_to_do(
    topic: str, error: int, what: str, scene: Scene, cluster: Cluster
) -> None:
    cluster.refuse(f"{ROOT}.{topic}", error)
    async with serving(scene, cluster):
        await until(lambda: losses(scene))
    (lost, *_) = losses(scene)
    assert lost.startswith(what)
    assert f"{ROOT}.{topic}" in lost
    assert ("access list" if error == UNAUTHORIZED else "make it, or let the broker make topics") in lost
    assert Code.GATEWAY_UP not in codes(scene)


async def test_a_topic_of_the_robot_that_the_broker_does_not_take_is_said_once_and_the_others_come(
    scene: Scene, cluster: Cluster
) -> None:
    cluster.refuse(f"{ROOT}.topics.odom", UNKNOWN)
    async with serving(scene, cluster) as gateway, client(scene, cluster, without="topics.odom") as me:
        await online(gateway)
        assert (await me.told("topics.control.status"))["mode"]
        scene.run(1.0)
        assert (await me.ask("call", "/rosapi/get_time"))["time"]
    (said,) = [msg for _, msg in scene.said if isinstance(msg, Event) and msg.code == Code.GATEWAY_REFUSED]
    assert f"does not take 1 of the robot's topics, as {ROOT}.topics.odom" in said.text


async def test_two_robots_of_one_name_take_stop_only_until_one_of_them_is_gone(
    scene: Scene, cluster: Cluster, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(scenes._KEPT, tmp_path / "other", scenes.empty() | {"facts": {"log": "b2"}})
    other = Scene(FakeRobot(), tmp_path / "other")
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        await driving(scene, me)
        async with serving(other, cluster) as second:
            await online(second)
            await until(lambda: all(Code.GATEWAY_NAMESAKE in codes(each) for each in (scene, other)))
            assert scene.robot.at_rest
            refused = await me.ask("call", "/control/acquire")
            assert (refused["success"], refused["code"]) == (False, Code.GATEWAY_NAMESAKE)
            assert not scene.control.driver
            assert not other.control.driver
            await me.put("stop", b"{}")
            await until(lambda: scene.station.controls.stopped and other.station.controls.stopped)
        await until(lambda: not gateway._namesakes)
        assert (await me.ask("call", "/rosapi/get_time")).get("time")
