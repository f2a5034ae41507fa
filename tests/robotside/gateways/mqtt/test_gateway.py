"""The MQTT gateway at a real broker: its topics, its state, and its end."""

from __future__ import annotations

import asyncio
import socket

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.mqtt.gateway import MqttGateway
from tests.robotside.gateways.mqtt.broker import Broker
from tests.robotside.gateways.mqtt.client import (
    FRESH,
    ROOT,
    client,
    codes,
    driving,
    online,
    serving,
    until,
)
from tests.robotside.scene import Scene


async def test_a_gateway_that_lets_everybody_drive_says_so(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url, "role=drive"):
        assert Code.GATEWAY_OPEN in codes(scene)


async def test_topics_come_with_the_newest_state_kept_and_no_payload_that_was_not_chosen(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url, "payloads=wheels&rate=50"), client(broker) as me:
        await online(me)
        assert (await me.told("topics/robot/info"))["name"] == "Fake-1"
        scene.run(1.0)
        assert "pose" in await me.told("topics/odom")
        async with client(broker, "late") as late:
            assert (await late.told("topics/control/status"))["mode"] == "MANUAL"
        left_out = await me.ask("call/task/start", expiry=FRESH)
        assert left_out["code"] == Code.GATEWAY_LEFT_OUT
        assert not [topic for topic in me.heard if topic.endswith(("/scan", "/task/status"))]


async def test_the_state_is_offline_after_an_end_and_lost_by_the_last_will(
    scene: Scene, broker: Broker
) -> None:
    async with client(broker) as me:
        async with serving(scene, broker.url) as gateway:
            await online(me)
            guide = await me.told("guide")
            assert guide == gateway.guide()
        await until(lambda: me.heard[f"{ROOT}/state"][-1]["state"] == "offline")
        async with serving(scene, broker.url) as gateway:
            await until(lambda: me.heard[f"{ROOT}/state"][-1]["state"] == "online")
            gateway._commands._client._client.socket().shutdown(
                socket.SHUT_RDWR
            )  # as a robot that is cut off
            await until(lambda: "lost" in [each["state"] for each in me.heard[f"{ROOT}/state"]])


async def test_nothing_is_left_of_a_gateway_that_was_stopped(scene: Scene, broker: Broker) -> None:
    before = asyncio.all_tasks()
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
    assert asyncio.all_tasks() == before
    assert scene.robot.at_rest
    assert not scene.door._operators
    assert not scene.door._subscriptions


async def test_a_gateway_is_stopped_without_having_been_started(scene: Scene) -> None:
    gateway = MqttGateway(
        Surroundings(scene.door, scene.station.events.say), read_url("mqtt://127.0.0.1", {"mqtt": 1})
    )
    await gateway.stop()
    assert gateway.endpoints() == {"mqtt": f"mqtt://127.0.0.1:1/{ROOT}"}


async def test_a_message_that_cannot_be_written_ends_no_other(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        for text in ("file \udcff is bad", "next"):
            gateway._feed._put(scene.door.topics["/events"], "/events", Event(text=text))
        await until(lambda: "next" in [each["text"] for each in me.heard.get(f"{ROOT}/topics/events", ())])


async def test_the_birth_lists_the_topics_and_each_message_has_its_number(
    scene: Scene, broker: Broker
) -> None:
    async with client(broker) as me, serving(scene, broker.url, "rate=50"):
        await online(me)
        birth = await me.told("birth")
        assert birth["topics"]["/odom"]["type"] == "nav_msgs/Odometry"
        for _ in range(3):
            had = len(me.numbers.get(f"{ROOT}/topics/odom", ()))
            scene.run(0.1)
            await until(lambda: len(me.numbers.get(f"{ROOT}/topics/odom", ())) > had)  # noqa: B023 - awaited at once
        numbers = me.numbers[f"{ROOT}/topics/odom"]
        assert numbers[:3] == [0, 1, 2]
