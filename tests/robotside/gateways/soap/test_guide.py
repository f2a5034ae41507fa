"""The guide's lines: each is understood as it stands by a robot that has all there is."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import ArmState
from robotside.gateways.soap.fields import NS
from robotside.gateways.soap.guide import guide
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.soap.served import TYPE, Answer, Served, serving
from tests.robotside.scene import Scene


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


async def test_it_names_what_this_robot_has(scene: Scene) -> None:
    async with serving(scene) as served:
        text = served.gateway.guide()
    assert "<source>Office 12</source><target>Lab</target>" in text
    assert "<pose>home</pose>" in text
    bare = guide("https://192.0.2.1/soap", served.door, ())
    assert "#MoveArm" not in bare
    assert "#GoTo" not in bare
    assert "#Stop" in bare
