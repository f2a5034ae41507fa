"""The guide of CoAP: each line is pasted into a shell, and libcoap's own client understands the robot."""

from __future__ import annotations

import asyncio
import contextlib
import re
import shutil
import time
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from bridge.core.identity import Role
from robotside.gateways.coap import site
from robotside.gateways.coap.gateway import CoapGateway
from robotside.gateways.coap.guide import guide, links
from robotside.gateways.payloads.offered import offered
from tests.lacking import lacking
from tests.robotside.gateways.coap import test_gateway
from tests.robotside.gateways.coap.client import client, serving
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene

no_pool_left = test_gateway.no_pool_left
TOOL = "coap-client-openssl"
AS_ARGUMENTS = """
coap_client() {
  method=get; text=
  while [ $# -gt 1 ]; do
    case $1 in
      -m) method=$2; shift;;
      -e) text=$2; shift;;
      -t) shift;;
    esac
    shift
  done
  printf '%s\\t%s\\t%s\\n' "$method" "$1" "$text"
}
"""
"""Stands for the client in a shell, and prints what the shell made of the line."""


@pytest.fixture(autouse=True)
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is made on demand is not made while the robot's time stands still."""
    monkeypatch.setattr(site, "FIRST_TIMEOUT", 0.01)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(EquippedRobot(), tmp_path)
    made.clock = time.time()  # the guide takes the stamp from the machine's clock
    made.run(1.0)
    return made


def pasted(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines() if line.strip().startswith("coap-client")]


async def shell(text: str) -> str:
    done = await asyncio.create_subprocess_exec(
        "sh", stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.STDOUT
    )
    said, _ = await done.communicate(text.encode())
    return said.decode()


async def test_every_command_of_the_guide_can_be_pasted_and_is_understood(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        lines = pasted(gateway.guide())
        called = "\n".join(line.replace("coap-client", "coap_client", 1) for line in lines)
        asked = (await shell(AS_ARGUMENTS + called)).splitlines()
        assert len(asked) == len(lines) > 50
        for each in asked:
            method, url, text = each.split("\t")
            stamp = re.search(r"stamp=([\d.]+)", url)
            scene.clock = (
                float(stamp[1]) if stamp else scene.clock
            )  # the shell's, on a machine that may be busy
            path = url.removeprefix(me.url)
            answer = await me.ask(method.upper(), path, text.encode())
            wrong = ("no field", "must be", "JSON", "carry", "how old", "is a number", "too old")
            assert answer.code[0] == "2" or not any(word in answer.text for word in wrong), (path, answer)
        assert scene.station.controls.stopped


async def test_on_debian_the_first_line_lets_all_others_be_pasted(scene: Scene, tmp_path: Path) -> None:
    tool = tmp_path / "coap-client-notls"
    tool.write_text('#!/bin/sh\necho "asked $*"\n')
    tool.chmod(0o755)
    text = guide("coap://192.0.2.7", offered(scene.door), Role.DRIVE)
    first = next(line for line in text.splitlines() if "coap-client=" in line)
    lines = pasted(text)
    assert text.index(first) < text.index(lines[0])
    said = await shell(f"unalias -a; PATH={tmp_path}:/usr/bin:/bin\n" + "\n".join([first, *lines]))
    assert [line.split()[0] for line in said.splitlines()] == ["asked"] * len(lines)


async def test_all_that_there_is_is_listed_as_links(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        found = (await me.get("/.well-known/core")).text
        paths = re.findall(r"<([^>]+)>", found)
        assert {"/odom", "/cmd_vel", "/stop", "/guide"} <= set(paths)
        for path in re.findall(r"<([^>]+)>[^<]*;obs", found):
            answer = await me.get(path)
            assert answer.code in ("2.05", "4.04"), (path, answer)
            assert "carry" not in answer.text


def test_who_has_no_role_is_told_of_stop_alone(scene: Scene) -> None:
    payloads = offered(scene.door)
    assert pasted(guide("coap://robot", payloads, Role.NONE)) == ["coap-client -m post coap://robot/stop"]
    assert "odom" not in links(payloads, Role.NONE)


async def begin(gateway: CoapGateway, *words: str, path: str) -> asyncio.subprocess.Process:
    return await asyncio.create_subprocess_exec(
        TOOL,
        *words,
        f"{gateway.endpoints()['coap']}{path}",
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
    )


async def run(gateway: CoapGateway, *words: str, path: str) -> str:
    """What libcoap's client prints."""
    said, _ = await (await begin(gateway, *words, path=path)).communicate()
    return said.decode(errors="replace")


async def watch(scene: Scene, gateway: CoapGateway) -> None:
    """libcoap's client observes until it has printed several notifications."""
    watching, printed = await begin(gateway, "-s", "60", path="/odom?rate=50"), b""
    try:
        while printed.count(b'"child_frame_id"') < 4:
            scene.run(0.05)
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(0.05):
                    printed += await watching.stdout.read(65536)
    finally:
        watching.kill()
        await watching.wait()


@pytest.fixture
async def gateway(scene: Scene) -> AsyncIterator[CoapGateway]:
    if not shutil.which(TOOL):
        lacking("coap-client", "it is libcoap's, the other library than aiocoap")
    async with serving(scene) as made:
        yield made


async def test_another_library_reads_observes_and_stops(scene: Scene, gateway: CoapGateway) -> None:
    async with client(gateway) as me:
        whole = (await me.get("/map")).text
    assert (await run(gateway, path="/map")).strip() == whole
    assert '"pose"' in await run(gateway, path="/odom")
    assert "does not carry" in await run(gateway, path="/nothing")
    await watch(scene, gateway)
    stamp = f"?stamp={scene.clock}"
    assert "home" in await run(
        gateway, "-m", "put", "-e", '{"order": {"pose": "home"}}', path=f"/arm/move{stamp}"
    )
    assert '"success":true' in await run(gateway, "-m", "post", path="/stop")
    assert scene.station.controls.stopped
