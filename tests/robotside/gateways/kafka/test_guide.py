"""The guide's lines: those that go through a shell are pasted, the examples of all others sent, while a robot runs."""

from __future__ import annotations

import asyncio
import os
import shlex
import signal
import sys
import time
from asyncio.subprocess import PIPE
from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.gateways.gateway_url import read_url
from robotside.gateways.kafka.adapter import ADAPTER
from robotside.gateways.kafka.guide import guide
from robotside.gateways.kafka.topic_names import TopicNames
from robotside.gateways.payloads.offered import offered
from tests.robotside.gateways.kafka.client import client, online, serving, until
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(EquippedRobot(), tmp_path)
    made.clock = time.time()  # the guide takes the stamp from the machine's clock
    made.run(1.0)
    return made


@pytest.mark.slow
async def test_the_functions_of_the_guide_are_pasted_into_a_shell(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        functions = [line for line in gateway.guide().splitlines() if line.startswith(("say()", "hear()"))]
        assert len(functions) == 2
        script = "\n".join(
            [*functions, "say commands call /rosapi/get_time '{}'", "say stop '{}'", "hear topics.odom"]
        )
        path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
        shell = await asyncio.create_subprocess_exec(
            "sh", "-c", script, stdout=PIPE, env=os.environ | {"PATH": path}, start_new_session=True
        )
        assert shell.stdout is not None
        heard = asyncio.create_task(shell.stdout.readline())
        try:
            while not heard.done():
                scene.run(0.2)
                await asyncio.wait([heard], timeout=0.2)
            assert "pose" in (await heard).decode()
        finally:
            heard.cancel()
            if shell.returncode is None:
                os.killpg(shell.pid, signal.SIGKILL)
            await shell.communicate()
        assert scene.station.controls.stopped
        assert any("time" in each for each in me.heard["answers"])


async def test_every_example_of_the_guide_is_understood(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        lines = [
            line.strip() for line in gateway.guide().splitlines() if line.strip().startswith("say commands")
        ]
        assert len(lines) > 30
        for number, line in enumerate(lines):
            _, _, verb, name, example = shlex.split(line)
            await me.send(verb, name, example.encode(), id=f"g{number}")
        asked = [
            number for number, line in enumerate(lines) if " publish " not in line and " run " not in line
        ]
        for number in asked:
            message = (await me.answer(f"g{number}")).get("message", "")
            assert not any(word in message for word in ("no field", "must be", "JSON", "carry", "how old")), (
                lines[number]
            )


def test_it_names_what_a_secured_broker_needs(scene: Scene) -> None:
    url = read_url("kafkas://anna:secret@broker.example/lab", ADAPTER.schemes)
    text = guide(url, TopicNames(url.path, "Rex"), offered(scene.door), Role.WATCH)
    assert '"bootstrap.servers": "broker.example:9093", "security.protocol": "sasl_ssl"' in text
    assert "PASSWORD" in text
    assert "secret" not in text
    assert "hear topics.odom" in text
    assert "for development" not in text


async def test_nothing_waits_for_the_guide(scene: Scene, cluster: Cluster) -> None:
    async with client(scene, cluster) as me, serving(scene, cluster):
        await until(lambda: "guide" in me.heard)
