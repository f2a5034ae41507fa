"""A broker that is absent, dies, falls silent, refuses, comes and goes, or has another robot of that name: the robot goes on."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, suppress
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event
from robotside.gateways.broker import line
from robotside.gateways.mqtt import broker_line
from tests.fakes import FakeRobot
from tests.lacking import lacking
from tests.robotside import scene as scenes
from tests.robotside.gateways.mqtt.broker import MOSQUITTO, Broker
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


async def test_the_robot_rests_when_its_broker_dies_and_obeys_nothing_old_when_it_is_back(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url):
        async with client(broker) as me:
            await online(me)
            await driving(scene, me)
            broker.kill()
            await until(lambda: scene.robot.at_rest)
        assert not scene.control.driver
        assert Code.GATEWAY_LOST in codes(scene)
        broker.start()
        async with client(broker) as me:
            await me.send("call/task/start", {"order": {"task": "hold"}}, expiry=FRESH)
            await online(me)
            await until(lambda: Code.GATEWAY_UP in codes(scene))
            await me.ask("call/rosapi/get_time")
            assert scene.robot.at_rest


async def test_a_broker_that_is_absent_is_an_event_and_is_reached_when_it_comes(
    scene: Scene, broker: Broker
) -> None:
    broker.kill()
    async with serving(scene, broker.url):
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        broker.start()
        async with client(broker) as me:
            await online(me)
            assert (await me.ask("call/control/acquire", expiry=FRESH))["success"]
    assert codes(scene).count(Code.GATEWAY_LOST) == 1


async def test_a_broker_that_answers_too_late_has_no_second_robot_whose_will_says_lost(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(broker_line, "CONNECT_TIMEOUT", 0.3)
    before = asyncio.all_tasks()
    broker.freeze()
    async with serving(scene, broker.url):
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        monkeypatch.setattr(broker_line, "CONNECT_TIMEOUT", 60.0)
        broker.thaw()
        async with client(broker) as me:
            await online(me)
            await me.ask("call/rosapi/get_time")
            assert me.heard[f"{ROOT}/state"][-1]["state"] == "online"
    assert asyncio.all_tasks() == before


async def test_a_broker_that_falls_silent_leaves_the_robot_at_rest(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(broker_line, "KEEPALIVE", 2)
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
        broker.freeze()
        await until(lambda: scene.robot.at_rest)
        broker.thaw()
        await until(lambda: Code.GATEWAY_UP in codes(scene))


async def test_a_robot_that_stood_still_does_nothing_that_waited_meanwhile_but_stop(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        broker.freeze()  # so that all of it comes while the robot stands still
        await me.send("call/control/acquire", expiry=FRESH, qos=0)
        await me.send("call/stop", qos=0)
        monkeypatch.setattr(line, "STALL_TIMEOUT", 0.25)
        broker.thaw()
        time.sleep(1.0)  # noqa: ASYNC251 - the loop stands still
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
        monkeypatch.setattr(line, "STALL_TIMEOUT", 60.0)
        await until(lambda: Code.GATEWAY_UP in codes(scene) and scene.station.controls.stopped)
        await me.ask("call/rosapi/get_time")
        assert not scene.control.driver


def _wanted(body: bytes) -> Iterator[str]:
    """The topics of a subscription, without properties."""
    rest = body[3:]
    while rest:
        size = int.from_bytes(rest[:2])
        yield rest[2 : 2 + size].decode()
        rest = rest[3 + size :]


async def _packet(reader: asyncio.StreamReader) -> tuple[int, bytes]:
    kind, size, shift = (await reader.readexactly(1))[0] >> 4, 0, 0
    while True:
        part = (await reader.readexactly(1))[0]
        size, shift = size | (part & 127) << shift, shift + 7
        if part < 128:
            return kind, await reader.readexactly(size)


@asynccontextmanager
async def refusing_broker(refused: str) -> AsyncIterator[str]:
    """The URL of a broker that refuses subscriptions whose topic has the word, as one with an access list does."""

    async def answer(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with suppress(asyncio.IncompleteReadError, ConnectionError):
            while True:
                kind, body = await _packet(reader)
                if kind == 1:  # CONNECT
                    writer.write(bytes((0x20, 3, 0, 0, 0)))
                elif kind == 3:  # PUBLISH with QoS 1; the others need no answer
                    start = 2 + int.from_bytes(body[:2])
                    writer.write(bytes((0x40, 2)) + body[start : start + 2])
                elif kind == 8:  # SUBSCRIBE
                    granted = bytes(0x87 if refused in topic else 1 for topic in _wanted(body))
                    writer.write(bytes((0x90, 3 + len(granted))) + body[:2] + b"\0" + granted)
                elif kind == 12:  # PINGREQ
                    writer.write(bytes((0xD0, 0)))
        writer.close()

    async with await asyncio.start_server(answer, "127.0.0.1", 0) as server:
        yield f"mqtt://127.0.0.1:{server.sockets[0].getsockname()[1]}"


@pytest.mark.parametrize(
    ("refused", "what"), [("/clients/+/call/#", "The MQTT broker"), ("/call/stop", "STOP has no connection")]
)
async def test_a_broker_that_refuses_a_subscription_is_an_event_that_says_what_to_allow(
    refused: str, what: str, scene: Scene
) -> None:
    async with refusing_broker(refused) as url, serving(scene, url):
        await until(lambda: Code.GATEWAY_LOST in codes(scene))
    said = next(msg.text for _, msg in scene.said if isinstance(msg, Event) and msg.code == Code.GATEWAY_LOST)
    assert said.startswith(what)
    assert "does not let the robot read pilothouse/Fake-1/clients/" in said
    assert refused in said
    assert Code.GATEWAY_UP not in codes(scene)


async def test_a_broker_that_grants_a_subscription_and_passes_nothing_on_is_an_alarm(
    scene: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not MOSQUITTO:
        lacking("mosquitto", "the other broker has no access list")
    monkeypatch.setattr(broker_line, "PROBE_TIMEOUT", 0.2)
    broker = Broker(tmp_path, access=f"topic write {ROOT}/#\ntopic read {ROOT}/state\n")
    try:
        async with serving(scene, broker.url) as gateway:
            await until(lambda: codes(scene).count(Code.GATEWAY_REFUSED) == 2)
            assert gateway._commands.is_up
    finally:
        broker.kill()
    said = [msg for _, msg in scene.said if isinstance(msg, Event) and msg.code == Code.GATEWAY_REFUSED]
    assert {each.level for each in said} == {"alarm"}
    assert any(f"let it read {ROOT}/clients/+/call/stop and write there" in each.text for each in said)


async def test_a_broker_that_passes_on_what_it_granted_is_none(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        lines = (gateway._commands, gateway._stop)
        await until(lambda: all(line.is_up and not line._is_early for line in lines))
        monkeypatch.setattr(broker_line, "PROBE_TIMEOUT", 0.0)
        assert not any(line.is_deaf for line in lines)
        gateway._check_hearing()
        assert Code.GATEWAY_REFUSED not in codes(scene)


async def test_a_broker_that_comes_and_goes_is_told_of_once(
    scene: Scene, broker: Broker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(line, "STANDING_TIME", 3600.0)
    async with serving(scene, broker.url) as gateway:
        for _ in range(2):
            await until(lambda: gateway._commands.is_up)
            broker.kill()
            await until(lambda: not gateway._commands.is_up)
            broker.start()
        await until(lambda: gateway._commands.is_up and gateway._stop.is_up)
        # STOP's connection may be seen to be lost a moment before
        texts = [msg.text for _, msg in scene.said if isinstance(msg, Event)]
        assert len([text for text in texts if text.startswith("The MQTT broker at")]) == 1
        assert Code.GATEWAY_UP not in codes(scene)


async def test_two_robots_of_one_name_take_stop_only_until_one_of_them_is_gone(
    scene: Scene, broker: Broker, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(scenes._KEPT, tmp_path / "other", scenes.empty() | {"facts": {"log": "b2"}})
    other = Scene(FakeRobot(), tmp_path / "other")
    async with serving(scene, broker.url) as gateway, client(broker) as me:
        await online(me)
        await driving(scene, me)
        async with serving(other, broker.url):
            await until(lambda: all(Code.GATEWAY_NAMESAKE in codes(each) for each in (scene, other)))
            assert scene.robot.at_rest
            refused = await me.ask("call/control/acquire", expiry=FRESH)
            assert (refused["success"], refused["code"]) == (False, Code.GATEWAY_NAMESAKE)
            assert "another --name" in refused["message"]
            assert not scene.control.driver
            assert not other.control.driver
            await me.send("call/stop")
            await until(lambda: scene.station.controls.stopped and other.station.controls.stopped)
        await until(lambda: not gateway._namesakes)
        assert (await me.ask("call/rosapi/get_time")).get("time")
