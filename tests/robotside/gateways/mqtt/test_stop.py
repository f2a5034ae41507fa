"""STOP by MQTT: pressed for anyone, by either connection, and through a flood."""

from __future__ import annotations

import asyncio
import socket
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from robotside.gateways.mqtt.broker_line import BrokerLine
from tests.fakes import FakeRobot
from tests.lacking import lacking, package
from tests.looped import looped
from tests.robotside.gateways.mqtt.broker import MOSQUITTO, Broker
from tests.robotside.gateways.mqtt.client import AHEAD, client, codes, online, serving, until
from tests.robotside.scene import Scene

STOPS = (b"", b"{}", b"stop!", b'{"client_name": "Fred", "surprise": 1}', b"\xff", b"[" * 70000)


@looped("raw", STOPS)
def test_anybody_stops_the_robot_whatever_the_message_says(raw: bytes, tmp_path: Path) -> None:
    asyncio.run(_stops(raw, tmp_path))


async def _stops(raw: bytes, folder: Path) -> None:
    scene, broker = Scene(FakeRobot(), folder), Broker(folder)
    try:
        scene.drive(Twist.planar(0.3, 0.0))
        async with serving(scene, broker.url, "role=none"), client(broker) as me:
            await online(me)
            assert (await me.ask("call/stop", raw, token="wrong"))["success"]
            assert scene.station.controls.stopped
            assert scene.robot.at_rest
    finally:
        broker.kill()


@pytest.mark.parametrize("retain", [False, True])
@pytest.mark.parametrize("deaf", ["_stop", "_commands"])
async def test_stop_comes_by_either_connection_while_the_other_is_deaf(
    deaf: str, retain: bool, scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        await until(lambda: gateway._stop.is_up)
        line = getattr(gateway, deaf)
        asyncio.get_running_loop().remove_reader(
            line._client._client.socket()
        )  # half open: it seems to be up
        scene.drive(Twist.planar(0.3, 0.0))
        assert (await me.ask("call/stop", retain=retain))["success"]
        assert line.is_up
        assert scene.station.controls.stopped
        assert scene.robot.at_rest


async def test_a_retained_stop_from_before_is_not_heard(scene: Scene, broker: Broker) -> None:
    if not MOSQUITTO:
        lacking("mosquitto", "the other broker passes on what it has kept, and a STOP is pressed then too")
    async with client(broker) as me:
        await me.send("call/stop", retain=True)
        async with serving(scene, broker.url) as gateway:
            await online(me)
            await until(lambda: gateway._stop.is_up)
            await me.ask("call/rosapi/get_time")
            assert not scene.station.controls.stopped


async def test_a_stop_that_a_broker_keeps_and_passes_on_unasked_is_pressed_once_and_said(
    scene: Scene, tmp_path: Path
) -> None:
    package("iotcore")
    broker = Broker(tmp_path, mosquitto="")
    try:
        async with client(broker) as me:
            await me.send("call/stop", retain=True)
            scene.run(5.0)
            async with serving(scene, broker.url) as gateway:
                await until(lambda: scene.station.controls.stopped)
                scene.run(1.0)
                assert codes(scene).count(Code.GATEWAY_RETAINED) == 1
                assert scene.release_stop().success
                for line in (gateway._commands, gateway._stop):
                    await again(line)
                await online(me)
                await me.ask("call/rosapi/get_time")
                assert not scene.station.controls.stopped
                assert (await me.ask("call/stop", retain=True))["success"]
                assert scene.station.controls.stopped
    finally:
        broker.kill()


async def again(line: BrokerLine) -> None:
    """The line is cut, and has heard its own probe on a new connection."""
    await until(lambda: not line._is_early)
    assert line._client is not None
    line._client._client.socket().shutdown(socket.SHUT_RDWR)
    await until(lambda: not line.is_up)
    await until(lambda: line.is_up and not line._is_early)


async def test_stop_comes_through_while_others_flood_the_robot(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me, client(broker, "noise") as noise:
        await online(me)

        stopped = asyncio.Event()

        async def flood() -> None:
            while not stopped.is_set():
                await noise.send("publish/cmd_vel", AHEAD)

        flooding = [asyncio.create_task(flood()) for _ in range(4)]
        assert (await me.ask("call/stop"))["success"]
        stopped.set()
        await asyncio.gather(*flooding)
    assert scene.station.controls.stopped
