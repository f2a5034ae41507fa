"""What a robot offers of the table of payloads: what it has told, and no more."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.std_msgs import Header
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.offered import CALL, PUBLISH, READ, chosen_keys, offered
from robotside.gateways.payloads.table import ALWAYS, KEYS
from tests.fakes import FakeRobot
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene


def _keys(scene: Scene) -> set[str]:
    return {each.payload.key for each in offered(scene.door)}


def test_a_robot_offers_what_it_has_told_of(tmp_path: Path) -> None:
    robot = FakeRobot()
    robot.silent.add("/scan")
    scene = Scene(robot, tmp_path)
    assert "laser" not in _keys(scene)
    robot.silent.clear()
    scene.run(1.0)
    assert {ALWAYS, "wheels", "laser", "tasks"} <= _keys(scene)
    assert not {"arm", "lights", "camera", "sonar"} & _keys(scene)


def test_only_chosen_payloads_are_there(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(1.0)
    found = offered(scene.door, chosen_keys(["laser"]))
    assert [each.payload.key for each in found] == [ALWAYS, "laser"]


def test_lines_have_type_rate_and_direction(tmp_path: Path) -> None:
    scene = Scene(EquippedRobot(), tmp_path)
    scene.run(1.0)
    lines = {line.name: line for each in offered(scene.door) for line in each.lines}
    assert (lines["/odom"].verb, lines["/odom"].type, lines["/odom"].rate) == (READ, "nav_msgs/Odometry", 20)
    assert (lines["/cmd_vel"].verb, lines["/cmd_vel"].type) == (PUBLISH, "geometry_msgs/Twist")
    assert (lines["/stop"].verb, lines["/stop"].type) == (CALL, "pilothouse_msgs/Command")
    assert lines["/task/status"].latched
    assert not lines["/events"].latched


def _examples(door: StationDoor) -> dict[str, Any]:
    lines = [line for each in offered(door) for line in each.lines]
    return {line.name: json.loads(line.example) for line in lines if line.example}


def test_a_pose_to_send_is_the_one_that_the_robot_has(tmp_path: Path) -> None:
    scene = Scene(EquippedRobot(), tmp_path)
    scene.run(1.0)
    at = Pose(Point(3.25, -1.5), Quaternion(0.0, 0.0, 0.6, 0.8))
    scene.station.bus.publish(
        "/pose", PoseWithCovarianceStamped(Header(frame_id="map"), PoseWithCovariance(at))
    )
    found, pose = (
        _examples(scene.door),
        {"position": {"x": 3.25, "y": -1.5}, "orientation": {"z": 0.6, "w": 0.8}},
    )
    assert found["/goal_pose"] == {"header": {"frame_id": "map"}, "pose": pose}
    assert found["/initialpose"] == {"header": {"frame_id": "map"}, "pose": {"pose": pose}}


@pytest.mark.parametrize("has_lights", [True, False])
def test_the_payload_to_switch_is_one_that_the_robot_has(tmp_path: Path, has_lights: bool) -> None:
    scene = Scene(EquippedRobot() if has_lights else FakeRobot(), tmp_path)
    switch = replace(scene.door.services["/mode/set"], name="/payloads/set")
    door = StationDoor(scene.station, services=[switch])
    scene.run(1.0)
    if has_lights:
        scene.station.bus.publish("/lights", door.topics["/lights"].type())
    found = _examples(door)["/payloads/set"]
    assert found["on"] is True
    assert found["key"] in _keys(scene)
    assert (found["key"] == "lights") is has_lights


def test_a_key_that_is_unknown_is_one_sentence() -> None:
    with pytest.raises(ValueError, match=r"There is no payload claw; there are robot, wheels, .*tasks\."):
        chosen_keys(["arm", "claw"])
    assert chosen_keys([]) == KEYS
