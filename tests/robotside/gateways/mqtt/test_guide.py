"""The guide's lines, pasted into a shell with Mosquitto's own tools while a robot runs."""

from __future__ import annotations

import asyncio
import shutil
import time
from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.mqtt.gateway import MqttGateway
from robotside.gateways.mqtt.guide import guide
from robotside.gateways.mqtt.topic_names import TopicNames
from robotside.gateways.payloads.offered import offered
from tests.lacking import lacking
from tests.robotside.gateways.mqtt.broker import Broker
from tests.robotside.gateways.mqtt.client import client, online
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene

NEEDED = ("mosquitto_pub", "mosquitto_sub")


def pasted(text: str, tool: str) -> list[str]:
    return [line.strip() for line in text.splitlines() if line.strip().startswith(tool)]


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(EquippedRobot(), tmp_path)
    made.clock = time.time()  # the guide takes the stamp from the machine's clock
    made.run(1.0)
    return made


async def run(line: str) -> tuple[int, str]:
    shell = await asyncio.create_subprocess_shell(
        line, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.STDOUT
    )
    said, _ = await shell.communicate()
    return shell.returncode or 0, said.decode()


async def test_every_command_of_the_guide_can_be_pasted_and_is_understood(
    scene: Scene, tmp_path: Path
) -> None:
    if not all(map(shutil.which, NEEDED)):
        lacking("mosquitto", "its clients are pasted into a shell")
    broker = Broker(tmp_path)
    gateway = MqttGateway(
        Surroundings(scene.door, scene.station.events.say), read_url(f"{broker.url}?role=drive", {"mqtt": 1})
    )
    await gateway.start()
    try:
        async with asyncio.timeout(60), client(broker) as me:
            await online(me)
            lines = pasted(gateway.guide(), "mosquitto_pub")
            assert len(lines) > 30
            done = await asyncio.gather(*map(run, lines))
            assert [said for code, said in done if code or said] == []
            names = {
                line.split(" -t ")[1].split()[0].partition("/call")[2] for line in lines if "/call/" in line
            }
            for name in names:
                topic = f"pilothouse/Fake-1/clients/me/answer{name}"
                while topic not in me.heard:  # noqa: ASYNC110 - what is waited for is no event
                    await asyncio.sleep(0.01)
                message = me.heard[topic][-1].get("message", "")
                assert not any(
                    word in message for word in ("no field", "must be", "JSON", "carry", "how old")
                ), name
            assert scene.station.controls.stopped
    finally:
        await gateway.stop()
        broker.kill()


def test_it_names_the_topics_that_are_published_and_what_a_secured_broker_needs(scene: Scene) -> None:
    url = read_url("mqtts://anna:secret@broker.example/lab", {"mqtts": 8883})
    text = guide(url, TopicNames(url.path, "Rex"), offered(scene.door), Role.WATCH)
    assert (
        "mosquitto_sub -h broker.example -p 8883 -u anna -P PASSWORD --tls-use-os-certs -t lab/Rex/topics/odom"
        in text
    )
    assert "secret" not in text
    assert "\narm: an arm with a gripper" not in text, "this robot has told of none"
