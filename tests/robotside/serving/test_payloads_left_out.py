"""A robot that is brought up without some of its payloads: off as soon as it has told of them, but for what is needed."""

from __future__ import annotations

from pathlib import Path

from robotside.serving.payload_switches import PayloadSwitches
from robotside.serving.payloads_left_out import MAX_LOOKS, PayloadsLeftOut
from tests.robotside.scene import Scene
from tests.robotside.serving.test_payload_switches import LadenRobot


class BroughtUp:
    """A robot that was brought up without some payloads, and what it said of that."""

    def __init__(self, robot: LadenRobot, state: Path, *keys: str) -> None:
        self.robot, self.scene = robot, Scene(robot, state)
        switches = PayloadSwitches(self.scene.door, self.scene.station, lambda: None)
        PayloadsLeftOut(switches, self.scene.station, keys)

    def said(self) -> list[tuple[str, str]]:
        events = self.scene.station.events.since(0, "")
        return [(event.code, event.text) for event in events if event.code.startswith("payload_")]


def test_what_was_not_chosen_goes_off_by_itself_and_is_told_once(tmp_path: Path) -> None:
    up = BroughtUp(LadenRobot(), tmp_path, "lights", "lights", "sonar")
    up.scene.run(MAX_LOOKS + 3.0)
    assert up.robot.switched == {"/lights": False, "/sonar": False} | {
        name: False for name in up.robot.switched if name.startswith("/sonar/")
    }
    assert up.said() == [
        ("payload_switched", "Lights is off: the robot was brought up without."),
        ("payload_switched", "Sonar is off: the robot was brought up without."),
    ]


def test_what_safety_needs_stays_on_and_says_why(tmp_path: Path) -> None:
    up = BroughtUp(LadenRobot(), tmp_path, "laser", "bumper")
    up.scene.run(MAX_LOOKS + 3.0)
    assert not up.robot.switched
    assert [code for code, _ in up.said()] == ["payload_fixed", "payload_fixed"]
    assert "keeps the robot off obstacles" in up.said()[0][1]


def test_a_payload_that_the_robot_tells_of_later_goes_off_then(tmp_path: Path) -> None:
    robot = LadenRobot()
    later = [each for each in robot.more if each[0] == "/lights"]
    robot.more = [each for each in robot.more if each[0] != "/lights"]
    up = BroughtUp(robot, tmp_path, "lights")
    up.scene.run(4.0)
    assert not robot.switched
    robot.more += later
    up.scene.run(2.0)
    assert robot.switched == {"/lights": False}


def test_one_that_the_robot_has_not_is_told_with_what_it_has(tmp_path: Path) -> None:
    up = BroughtUp(LadenRobot(), tmp_path, "depth")
    up.scene.run(MAX_LOOKS + 3.0)
    ((code, said),) = up.said()
    assert code == "payload_unknown"
    assert "no payload 'depth' to go without; it has robot, wheels" in said


def test_a_robot_that_was_brought_up_with_everything_loses_nothing(tmp_path: Path) -> None:
    up = BroughtUp(LadenRobot(), tmp_path)
    up.scene.run(3.0)
    assert not up.robot.switched
    assert up.said() == []
