"""The guide's lines: each is understood as it stands by a robot that has all there is."""

from __future__ import annotations

import asyncio
import os
import shlex
import shutil
import sys
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import ArmState
from robotside.gateways.soap.fields import NS
from robotside.gateways.soap.guide import guide
from tests.lacking import lacking
from tests.robotside.gateways.guided import serving_securely
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.soap.served import TYPE, Answer, Served, serving
from tests.robotside.scene import Scene

MODULES = Path(__file__).parents[3] / "clients" / "node_modules"


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(EquippedRobot(), tmp_path)
    made.run(4.0)
    made.station.bus.publish("/arm", ArmState(joints=["a"], angles=[0.0], poses=["home", "high"]))
    return made


async def pasted(served: Served, line: str) -> Answer:
    """What curl does of such a line."""
    curl, _, _, *rest = shlex.split(line)
    options = list(zip(rest[::2], rest[1::2], strict=True))
    assert curl == "curl"
    assert [name for name, _ in options] == ["-H", "-H", "-d"]
    kind, action, raw = (value for _, value in options)
    assert kind == f"Content-Type: {TYPE}"
    word, _, operation = action.rpartition("#")
    assert word == f'SOAPAction: "{NS}'
    return await served.post(raw, action=operation.rstrip('"'))


async def test_every_line_can_be_pasted_and_is_understood(scene: Scene) -> None:
    async with serving(scene) as served:
        lines = [line for line in served.gateway.guide().splitlines() if line.startswith("curl ")]
        assert len(lines) > 12
        for line in lines:
            answer = await pasted(served, line)
            if answer.status == 200:
                continue
            assert answer.status == 500, line
            who, said, code = answer.fault
            assert who == "Client", line
            assert code or said.startswith("The robot has not said"), (line, said)
        assert served.stopped


@pytest.mark.slow
async def test_with_tls_its_lines_can_be_pasted_too_and_stop_needs_no_token(tmp_path: Path) -> None:
    if shutil.which("curl") is None or shutil.which("node") is None:
        lacking("curl or node", "the guide is pasted into a shell with them")
    async with asyncio.timeout(120), serving_securely(tmp_path, "soap") as (serves, text, token):
        lines = [line for line in text.splitlines() if line.startswith(("curl ", "python ", "node "))]
        stop, info = lines[2:4]
        assert "#GetInfo" in info
        assert "#Stop" in stop
        for line in (info, *lines[:2]):
            said = await shell(line.replace("TOKEN", token))
            assert "Rex" in said or "MANUAL" in said, (line, said)
        assert not serves.station.controls.stopped
        assert "Fault" not in await shell(stop)
        assert serves.station.controls.stopped
        other = lines[0].replace(serves.keys.key.fingerprint, "0" * 64) if serves.keys else ""
        assert "Fingerprints did not match" in await shell(other)
        other = lines[1].replace(serves.keys.key.fingerprint, "0" * 64) if serves.keys else ""
        assert "not the robot" in await shell(other)


async def shell(line: str) -> str:
    """What a line prints, in a shell that has this Python and node's soap."""
    path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
    process = await asyncio.create_subprocess_shell(
        line,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
        env=os.environ | {"PATH": path, "NODE_PATH": str(MODULES)},
    )
    said, _ = await process.communicate()
    return said.decode()


async def test_it_names_what_this_robot_has(scene: Scene) -> None:
    async with serving(scene) as served:
        text = served.gateway.guide()
    assert "<source>Office 12</source><target>Lab</target>" in text
    assert "<pose>home</pose>" in text
    bare = guide("https://192.0.2.1/soap", served.door, ())
    assert "#MoveArm" not in bare
    assert "#GoTo" not in bare
    assert "#Stop" in bare
