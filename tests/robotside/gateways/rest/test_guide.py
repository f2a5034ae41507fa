"""The guide's lines, pasted into a shell with curl while a robot runs."""

from __future__ import annotations

import asyncio
import json
import shutil
import time
from pathlib import Path

import pytest

from bridge.core.identity import Role
from bridge.msgs.pilothouse_msgs import ArmState
from robotside.gateways.payloads.offered import offered
from robotside.gateways.rest.guide import guide
from robotside.gateways.usage_sheet.pasted import RobotKey
from tests.lacking import lacking
from tests.robotside.gateways.guided import serving_securely
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.rest.served import serving
from tests.robotside.scene import Scene

UNREAD = ("no field", "must be", "JSON", "no path", "no service", "no topic", "header")


async def run(line: str, few: asyncio.Semaphore) -> tuple[int, str]:
    async with few:
        shell = await asyncio.create_subprocess_shell(
            line, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.STDOUT
        )
        said, _ = await shell.communicate()
    return shell.returncode or 0, said.decode()


async def test_every_line_of_the_guide_can_be_pasted_and_is_understood(tmp_path: Path) -> None:
    if shutil.which("curl") is None:
        lacking("curl", "the guide is pasted into a shell with it")
    scene = Scene(EquippedRobot(), tmp_path)
    scene.clock = time.time()  # the guide takes the stamp from the machine's clock
    scene.run(1.0)
    scene.station.bus.publish("/arm", ArmState())
    async with serving(scene, "?role=drive") as served, asyncio.timeout(120):
        lines = [line.strip() for line in served.rest.guide().splitlines() if line.strip().startswith("curl")]
        assert len(lines) > 40
        few = asyncio.Semaphore(8)  # the site gives places up where one address has too many
        begun = [await run(line, few) for line in lines[:2]]  # the time comes before what is stamped
        done = begun + await asyncio.gather(*(run(line, few) for line in lines[2:]))
        for line, (code, said) in zip(lines, done, strict=True):
            assert code == 0, (line, said)
            assert said, line
            if said.startswith("{"):
                message = json.loads(said).get("message", "")
                assert not any(word in message for word in UNREAD), (line, message)
        assert scene.station.controls.stopped
        async with served.client() as web:
            assert (await web.get("guide")).text == served.rest.guide() + "\n"


@pytest.mark.slow
async def test_with_tls_its_lines_can_be_pasted_too_and_stop_needs_no_token(tmp_path: Path) -> None:
    if shutil.which("curl") is None:
        lacking("curl", "the guide is pasted into a shell with it")
    async with asyncio.timeout(120), serving_securely(tmp_path, "rest") as (serves, guide, token):
        lines = [line.strip() for line in guide.splitlines() if line.strip().startswith("curl")]
        reads = [line for line in lines if " https://" in line and not line.endswith("since=0")][:4]
        stops = [line for line in lines if line.endswith("/stop")]
        assert len(reads) == 4
        assert stops
        few = asyncio.Semaphore(1)
        for line in reads:
            code, said = await run(line.replace("TOKEN", token), few)
            assert (code, "trust_" in said) == (0, False), (line, said)
        assert "trust_key" in (await run(reads[0], few))[1], "TOKEN itself is none"
        assert not serves.station.controls.stopped
        for line in stops:
            code, said = await run(line, few)
            assert (code, json.loads(said)["success"]) == (0, True), (line, said)
        assert serves.station.controls.stopped


def test_it_says_who_may_do_what_and_leaves_out_what_the_robot_has_not(tmp_path: Path) -> None:
    scene = Scene(EquippedRobot(), tmp_path)
    text = guide("https://192.0.2.7:8080/api", offered(scene.door), Role.WATCH, RobotKey("pin="))
    assert "the role is\nwatch." in text
    assert "curl -sS -X POST http://192.0.2.7:8080/api/stop" in text
    secure = [line for line in text.splitlines() if line.strip().startswith("curl") and "/stop" not in line]
    known = "curl -sS -k --pinnedpubkey sha256//pin= -H 'Authorization: Bearer TOKEN' "
    assert all(line.strip().startswith(known) and "https://" in line for line in secure)
    assert "\narm: an arm with a gripper" not in text, "this robot has told of none"
    assert "by the address that it comes from" in guide("http://127.0.0.1:8080/api", (), None)
