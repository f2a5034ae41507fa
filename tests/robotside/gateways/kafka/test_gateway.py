"""The Kafka gateway at a broker: its topics, its state, and its end."""

from __future__ import annotations

import asyncio

from bridge.core.codes import Code
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.kafka.adapter import ADAPTER
from robotside.gateways.kafka.gateway import KafkaGateway
from tests.robotside.gateways.kafka.client import ROOT, client, codes, driving, online, serving, until
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.scene import Scene


async def test_topics_come_with_numbers_and_no_payload_that_was_not_chosen(
    scene: Scene, cluster: Cluster
) -> None:
    async with (
        client(scene, cluster) as me,
        serving(scene, cluster, "payloads=wheels&rate=50") as gateway,
    ):
        await online(gateway)
        birth = await me.told("birth")
        assert birth["topics"]["/odom"]["type"] == "nav_msgs/Odometry"
        assert "/task/status" not in birth["topics"]
        assert (await me.told("topics.control.status"))["mode"] == "MANUAL"
        for number in range(3):
            scene.run(0.1)
            await until(lambda: len(me.heard.get("topics.odom", ())) > number)  # noqa: B023 - awaited at once
        assert sorted(int(each["seq"]) for each in me.headers["topics.odom"])[:3] == [0, 1, 2]
        left_out = await me.ask("call", "/task/start")
        assert left_out["code"] == Code.GATEWAY_LEFT_OUT


async def test_the_state_has_a_heartbeat_with_the_time_and_is_offline_after_an_end(
    scene: Scene, cluster: Cluster
) -> None:
    async with client(scene, cluster) as me:
        async with serving(scene, cluster) as gateway:
            await until(lambda: len(me.heard.get("state", ())) > 3)
            assert me.heard["state"][0] == {
                "state": "online",
                "robot": "Fake-1",
                "boot": "b1",
                "time": scene.clock,
            }
            assert await me.told("guide") == gateway.guide()
        await until(lambda: "offline" in [each["state"] for each in me.heard["state"]])


async def test_pictures_larger_than_a_batch_come_whole(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        noise = "x" * 200_000
        gateway._feed._put(scene.door.topics["/control/status"], "/control/status", _status(scene, noise))
        await until(lambda: any(each["mode"] == noise for each in me.heard.get("topics.control.status", ())))


def _status(scene: Scene, mode: str) -> object:
    from msgspec.structs import replace

    return replace(scene.control, mode=mode)


async def test_nothing_is_left_of_a_gateway_that_was_stopped(scene: Scene, cluster: Cluster) -> None:
    before = asyncio.all_tasks()
    async with serving(scene, cluster) as gateway:
        await online(gateway)
        async with client(scene, cluster) as me:
            await driving(scene, me)
    assert asyncio.all_tasks() == before
    assert scene.robot.at_rest
    assert not scene.door._operators
    assert not scene.door._subscriptions


async def test_a_gateway_is_stopped_before_it_was_started_and_at_once_after(
    scene: Scene, cluster: Cluster
) -> None:
    before = asyncio.all_tasks()
    url = read_url(f"kafka://{cluster.address}/lab.hall", ADAPTER.schemes)
    gateway = KafkaGateway(Surroundings(scene.door, scene.station.events.say), url)
    await gateway.stop()
    assert gateway.endpoints() == {"kafka": f"kafka://{cluster.address}/lab.hall.Fake-1"}
    for steps in (0, 1, 3, 10, 30):
        async with serving(scene, cluster):
            for _ in range(steps):
                await asyncio.sleep(0)
        assert asyncio.all_tasks() == before


async def test_a_gateway_that_lets_everybody_drive_says_so(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster, "role=drive"):
        assert Code.GATEWAY_OPEN in codes(scene)
    assert ROOT.endswith("Fake-1")
