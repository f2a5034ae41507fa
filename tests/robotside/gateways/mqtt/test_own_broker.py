"""The robot's own broker: on this machine alone, back when it dies, and gone with the robot, however that ends."""

from __future__ import annotations

import asyncio
import errno
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import aiomqtt
import psutil
import pytest

from bridge.core.errors import BridgeError
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import OWN, read_url
from robotside.gateways.mqtt import own_broker
from robotside.gateways.mqtt.adapter import ADAPTER
from robotside.gateways.mqtt.gateway import MqttGateway
from robotside.gateways.mqtt.own_broker import OwnBroker, mosquitto
from tests.fakes import FakeRobot
from tests.robotside.gateways.mqtt.client import FRESH, Client
from tests.robotside.scene import Scene

PROGRAMS = sorted({"", mosquitto()})
"""Of Mosquitto where it is installed; empty for iotcore's broker."""
ORPHANED = """
import asyncio, os, sys
from robotside.gateways.mqtt.own_broker import OwnBroker

async def main():
    broker = OwnBroker("127.0.0.1", 0, program=sys.argv[1])
    await broker.start()
    print(broker.port, flush=True)
    os.kill(os.getpid(), 9)

asyncio.run(main())
"""


@pytest.fixture(params=PROGRAMS, ids=lambda program: Path(program).name or "iotcore")
def program(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def listens(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def is_there(path: str) -> bool:
    return Path(path).exists()


async def until_it_is(port: int, *, there: bool) -> None:
    async with asyncio.timeout(60):
        while listens(port) != there:  # noqa: ASYNC110 - another process brings it about
            await asyncio.sleep(0.01)


async def test_it_speaks_mqtt_5_comes_back_when_it_dies_and_leaves_nothing(program: str) -> None:
    before = asyncio.all_tasks()
    broker = OwnBroker("127.0.0.1", 0, program=program)
    await broker.start()
    for _ in range(2):
        async with aiomqtt.Client("127.0.0.1", broker.port, protocol=aiomqtt.ProtocolVersion.V5) as client:
            await client.publish("a", b"b", qos=1)
        assert broker._process is not None
        shell = psutil.Process(broker._process.pid)
        dead = next((each for each in shell.children() if each.name() == "mosquitto"), shell)
        dead.kill()
        before_it = broker._process
        async with asyncio.timeout(60):
            while broker._process is before_it:  # noqa: ASYNC110 - another process brings it about
                await asyncio.sleep(0.01)
    folder = broker._folder
    await broker.stop()
    assert not listens(broker.port)
    assert folder is not None
    assert not is_there(folder.name)
    assert asyncio.all_tasks() == before
    await broker.stop()


async def test_what_ends_a_robot_in_its_terminal_does_not_end_the_broker_before_it(program: str) -> None:
    broker = OwnBroker("127.0.0.1", 0, program=program)
    await broker.start()
    try:
        assert broker._process is not None
        assert os.getpgid(broker._process.pid) != os.getpgrp()  # Ctrl-C is for a whole group
    finally:
        await broker.stop()


def test_it_ends_with_a_robot_that_was_killed(program: str, tmp_path: Path) -> None:
    robot = subprocess.run(
        [sys.executable, "-c", ORPHANED, program],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"TMPDIR": str(tmp_path)},
    )
    assert robot.returncode == -signal.SIGKILL, robot.stderr
    asyncio.run(until_it_is(int(robot.stdout), there=False))


async def test_a_port_that_is_taken_is_one_sentence_that_says_how_to_use_what_is_there() -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(
            BridgeError, match=rf"Port {port} .* taken, .*: mqtt=mqtt://127\.0\.0\.1:{port} goes"
        ):
            OwnBroker("127.0.0.1", port)


def test_it_listens_for_this_machine_alone() -> None:
    for host in ("0.0.0.0", "192.0.2.7", "::"):
        with pytest.raises(BridgeError, match=f"on this machine only, not on {host}"):
            OwnBroker(host, 0)


async def test_where_no_broker_is_installed_that_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(own_broker, "find_spec", lambda _: None)
    broker = OwnBroker("127.0.0.1", 0, program="")
    with pytest.raises(BridgeError, match="install Mosquitto or iotcore, or give the URL"):
        await broker.start()
    await broker.stop()


async def test_one_that_does_not_come_up_is_one_sentence_and_leaves_nothing(tmp_path: Path) -> None:
    program = tmp_path / "mosquitto"
    program.write_text("#!/bin/sh\nexit 3\n")
    program.chmod(0o755)
    broker = OwnBroker("127.0.0.1", 0, program=str(program))
    with pytest.raises(BridgeError, match="cannot listen on 127"):
        await broker.start()
    await broker.stop()


class Child:
    """A process of a broker."""

    stdin = None

    def __init__(self) -> None:
        self.ended = asyncio.Event()

    async def wait(self) -> int:
        await self.ended.wait()
        return 1


async def test_one_that_does_not_come_up_again_is_tried_ever_less_often_and_told_of_once(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    pauses: list[float] = []

    async def pause(seconds: float) -> None:
        pauses.append(seconds)

    broker, dead, back = OwnBroker("127.0.0.1", 0, program="", pause=pause), Child(), Child()
    full = OSError(errno.ENOSPC, "No space left on device")
    faults, is_back = iter([BridgeError("Taken."), *[full] * 8]), asyncio.Event()

    async def begin() -> Child:
        for fault in faults:
            raise fault
        is_back.set()
        return back

    monkeypatch.setattr(broker, "_begin", begin)
    broker._process = dead  # type: ignore[assignment]
    broker._watching = asyncio.create_task(broker._watch())
    dead.ended.set()
    async with asyncio.timeout(60):
        await is_back.wait()
    assert pauses == [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0, 30.0, 30.0, 30.0]
    said = [record.getMessage() for record in caplog.records]
    assert [each.rpartition(": ")[2] for each in said] == [
        "The robot's own MQTT broker ended with 1 and is started again",
        "Taken.",
        "[Errno 28] No space left on device",
    ]
    back.ended.set()
    await broker.stop()


async def test_the_gateway_brings_it_and_programs_of_this_machine_may_what_they_may_elsewhere(
    tmp_path: Path,
) -> None:
    scene, before = Scene(FakeRobot(), tmp_path), asyncio.all_tasks()
    gateway = MqttGateway(
        Surroundings(scene.door, scene.station.events.say), read_url(f"{OWN}://127.0.0.1:0", ADAPTER.schemes)
    )
    port = int(gateway.endpoints()["mqtt"].split(":")[2].split("/")[0])
    async with asyncio.timeout(60):
        await gateway.start()
        assert f"-p {port} " in gateway.guide()
        async with aiomqtt.Client("127.0.0.1", port, protocol=aiomqtt.ProtocolVersion.V5) as mqtt:
            me = Client(mqtt, "me")
            await mqtt.subscribe("pilothouse/#", qos=1)
            assert (await me.told("state"))["state"] == "online"
            assert (await me.ask("call/control/acquire", expiry=FRESH))["success"]
            await me.close()
        await gateway.stop()
    assert not listens(port)
    assert asyncio.all_tasks() == before
