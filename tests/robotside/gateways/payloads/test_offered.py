"""What a robot offers of the table of payloads: what it has told, and no more."""

from __future__ import annotations

from pathlib import Path

import pytest

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


def test_a_key_that_is_unknown_is_one_sentence() -> None:
    with pytest.raises(ValueError, match=r"There is no payload claw; there are robot, wheels, .*tasks\."):
        chosen_keys(["arm", "claw"])
    assert chosen_keys([]) == KEYS
