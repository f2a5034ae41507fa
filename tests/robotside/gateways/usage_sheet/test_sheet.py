"""What the sheet says to whom: by the address that the reader came by."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from bridge.core.topics import camera_topics
from robotside.gateways.usage_sheet.sheet import make_sheet
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    return Scene(FakeRobot(), tmp_path)


def test_who_came_encrypted_gets_the_same_in_every_line_but_stop(scene: Scene) -> None:
    sheet = make_sheet(scene.door, "wss://192.0.2.7:9090", "https://[2001:db8::7]:8080", (), "pin/+=")
    assert sheet.bridge == "wss://[2001:db8::7]:9090"
    stop, *others = [command.line for command in sheet.commands]
    assert stop == "curl -X POST http://[2001:db8::7]:8080/stop"
    assert others
    assert all("-k --pinnedpubkey sha256//pin/+= " in line for line in others), "-k alone would trust anybody"
    assert all("'Authorization: Bearer TOKEN'" in line for line in others)
    assert "Credentials(" in sheet.program


def test_who_is_at_the_robot_needs_no_key(scene: Scene) -> None:
    sheet = make_sheet(scene.door, "wss://192.0.2.7:9090", "http://127.0.0.1:8080", (), "pin")
    assert sheet.bridge == "ws://127.0.0.1:9090"
    assert not any("pinned" in command.line or "Bearer" in command.line for command in sheet.commands)
    assert "Credentials" not in sheet.program


def test_each_camera_that_is_on_has_a_line(tmp_path: Path) -> None:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"])
    door = Scene(robot, tmp_path).door

    def pictures() -> list[str]:
        return [
            each.line for each in make_sheet(door, "", "http://h:1", ()).commands if "/snapshot/" in each.line
        ]

    assert pictures() == ["curl -o front.jpg 'http://h:1/snapshot/front.jpg?width=320'"]
    door.switch("camera", camera_topics(["front"]).values(), on=False)
    assert pictures() == []


def test_services_of_no_payload_are_named(scene: Scene) -> None:
    sheet = make_sheet(scene.door, "", "http://127.0.0.1:8080", ())
    told = {line.name for each in sheet.payloads for line in each.lines}
    assert {name for name, _ in sheet.services} | told >= set(scene.door.services)
    assert not {name for name, _ in sheet.services} & told
