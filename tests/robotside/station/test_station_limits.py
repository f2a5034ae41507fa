"""A station keeps its robot within the configured limits, whoever drives, and shows them and the check list."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Twist,
)
from bridge.msgs.pilothouse_msgs import (
    Checklist,
    CommandRequest,
    Limits,
    Mission,
    RobotInfo,
    SetMissionRequest,
    StartTaskRequest,
    Waypoint,
)
from robotside.core.config import Config, LimitSettings, RobotSettings
from robotside.limits.limits import NOT_PLACED
from tests.fakes import Box, FakeRobot
from tests.robotside.scene import Scene

WEST, SOUTH, EAST, NORTH = -3.0, -4.0, 6.0, 4.0
YARD = ((WEST, SOUTH), (EAST, SOUTH), (EAST, NORTH), (WEST, NORTH))
POND = ((1.0, -1.0), (3.0, -1.0), (3.0, 1.0), (1.0, 1.0))
FENCED = Config(limits=LimitSettings(keep_in=(YARD,), keep_out=(POND,)))
AHEAD = Twist.planar(0.7, 0.0)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    scene = Scene(FakeRobot(), tmp_path, config=FENCED)
    scene.run(5.5)
    return scene


def hold(scene: Scene, twist: Twist, seconds: float) -> None:
    """Keep the stick where it is."""
    for _ in range(round(seconds / 0.1)):
        scene.drive(twist)
        scene.run(0.1)


def states(scene: Scene) -> dict[str, str]:
    told = scene.station.bus.last("/checklist")
    assert isinstance(told, Checklist)
    return {check.name: check.state for check in told.checks}


# driving by hand


def test_a_stick_held_towards_the_fence_ends_before_it_and_is_said_once(scene: Scene) -> None:
    hold(scene, Twist.planar(-0.7, 0.0), 10.0)
    room = scene.robot.pose[0] - WEST - scene.robot.info.radius
    assert 0.05 < room < 0.2
    assert scene.robot.twist.linear.x > -0.02
    assert len([said for said in scene.events("command") if said.startswith("The robot's fence")]) == 1


def test_back_from_the_fence_it_drives_at_full_speed(scene: Scene) -> None:
    hold(scene, Twist.planar(-0.7, 0.0), 10.0)
    hold(scene, AHEAD, 0.2)
    assert scene.robot.twist == AHEAD


def test_a_single_command_is_looked_at_again_while_it_counts(scene: Scene) -> None:
    hold(scene, AHEAD, 0.4)
    scene.drive(AHEAD)
    first = scene.robot.twist.linear.x
    scene.run(0.25)
    assert 0.0 < scene.robot.twist.linear.x < first - 0.1


def test_a_robot_that_does_not_know_where_it_is_only_turns(tmp_path: Path) -> None:
    robot = FakeRobot()
    robot.silent = {"/map"}
    scene = Scene(robot, tmp_path, config=FENCED)
    scene.run(1.0)
    scene.drive(Twist.planar(0.5, 0.3))
    assert robot.twist == Twist.planar(0.0, 0.3)
    assert scene.events("command") == [NOT_PLACED]


def test_a_speed_limit_holds_for_the_hand_and_for_the_task_and_is_told_in_the_robots_info(
    tmp_path: Path,
) -> None:
    config = Config(RobotSettings("Slow-1"), LimitSettings(max_speed=0.2, max_yaw_rate=0.5))
    scene = Scene(FakeRobot(), tmp_path, config=config)
    scene.run(5.5)
    info = scene.station.bus.last("/robot/info")
    assert isinstance(info, RobotInfo)
    assert (info.name, info.max_speed, info.max_yaw_rate) == ("Slow-1", 0.2, 0.5)
    scene.drive(Twist.planar(0.7, 1.9))
    assert scene.robot.twist == Twist.planar(0.2, 0.5)
    scene.set(Waypoint(2.0, 0.0), laps=1)
    scene.start()
    before = len(scene.robot.commands)
    scene.run(5.0)
    driven = [twist for twist in scene.robot.commands[before:] if twist]
    assert 0.1 < max(twist.linear.x for twist in driven) <= 0.2


def test_a_fault_in_the_limits_is_said_and_the_robot_stands(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene.drive(AHEAD)
    monkeypatch.setattr(scene.station.keeper, "clamp", lambda *_: 1 / 0)
    scene.run(0.1)
    assert scene.robot.at_rest
    scene.drive(AHEAD)
    assert scene.robot.at_rest
    assert len(scene.events("task")) == 1


# tasks


def test_a_goal_outside_the_fence_is_refused_with_the_reason(scene: Scene) -> None:
    scene.go_to(8.0, 0.0)
    assert scene.events("command") == ["The goal at (8.0, 0.0) is outside the robot's fence."]
    assert not scene.station.autonomy.engine.running


def test_a_mission_with_a_point_outside_is_refused_with_the_reason(scene: Scene) -> None:
    mission = Mission(waypoints=[Waypoint(-1.0, 0.0), Waypoint(2.0, 0.0)])
    said = scene.refused("/mission/set", SetMissionRequest(mission=mission))
    assert said == "Point 2 at (2.0, 0.0) is outside the robot's fence."


def test_a_home_outside_is_refused_with_the_reason(scene: Scene) -> None:
    mission = Mission(home=[Waypoint(8.0, 0.0)])
    said = scene.refused("/mission/set", SetMissionRequest(mission=mission))
    assert said == "Home at (8.0, 0.0) is outside the robot's fence."


def test_a_patrol_goes_round_an_area_to_keep_out_of(scene: Scene) -> None:
    scene.set(Waypoint(4.5, 0.0), laps=1)
    scene.start()
    end = scene.now + 60.0
    while scene.station.autonomy.engine.running and scene.now < end:
        scene.run(0.1)
        room = scene.station.keeper.room(scene.robot.pose[0], scene.robot.pose[1])
        assert room > scene.robot.info.radius
    assert scene.task.state == "SUCCEEDED"


def test_from_outside_the_fence_no_task_starts_and_the_way_back_by_hand_is_free(scene: Scene) -> None:
    scene.set(Waypoint(0.0, 2.0), laps=1)
    scene.robot.pose = (8.0, 0.0, math.pi)
    placed = Pose(Point(8.0, 0.0), Quaternion.from_yaw(math.pi))
    there = PoseWithCovarianceStamped(pose=PoseWithCovariance(placed))
    scene.station.on_message(scene.anna, "/initialpose", there, None)
    scene.run(1.0)
    said = scene.refused("/task/start", StartTaskRequest())
    assert said.startswith("The robot at (8.")
    assert said.endswith("is outside its fence; drive it back by hand first.")
    hold(scene, AHEAD, 0.5)
    assert scene.robot.twist == AHEAD
    hold(scene, Twist.planar(-0.7, 0.0), 0.5)
    assert scene.robot.at_rest


# what is shown


@pytest.mark.parametrize(("clearance", "state"), [(0.05, "SUCCEEDED"), (0.2, "FAILED")])
def test_the_clearance_of_the_configuration_decides_which_gaps_are_passed(
    tmp_path: Path, clearance: float, state: str
) -> None:
    """Between two cupboards of the map there is 0.6 m for a robot of 0.36 m."""
    config = Config(limits=LimitSettings(clearance=clearance))
    walls = [Box(1.0, -6.0, 1.2, -0.3), Box(1.0, 0.3, 1.2, 6.0)]
    scene = Scene(FakeRobot(boxes=walls), tmp_path, config=config)
    scene.run(5.5)
    scene.go_to(2.2, 0.0)
    assert scene.run_task().state == state
    if state == "FAILED":
        assert "m wide and the robot needs 0.76 m" in scene.task.reason


def test_the_limits_are_told_to_whoever_comes(scene: Scene) -> None:
    told = scene.station.bus.last("/limits")
    assert isinstance(told, Limits)
    assert len(told.keep_in[0].points) == len(told.keep_out[0].points) == 4


def test_the_check_list_becomes_green_by_itself_but_for_what_a_person_has_to_do(scene: Scene) -> None:
    assert states(scene) == {
        "battery": "ok",
        "sensors": "ok",
        "position": "ok",
        "stop": "unknown",
        "clock": "unknown",
    }
    scene.ask("/stop", CommandRequest(stamp=scene.clock - 0.05))
    scene.run(1.5)
    assert set(states(scene).values()) == {"ok"}
    assert scene.control.stop_tested.seconds == pytest.approx(scene.clock - 1.5, abs=0.2)


def test_the_check_list_is_told_only_when_it_changes(scene: Scene) -> None:
    before = len(scene.of("/checklist"))
    scene.run(5.0)
    assert len(scene.of("/checklist")) == before
    scene.robot.silent = {"/scan"}
    scene.run(3.0)
    assert states(scene)["sensors"] == "bad"
    assert len(scene.of("/checklist")) == before + 1


def test_a_clock_that_is_an_hour_off_is_named(scene: Scene) -> None:
    scene.drive(AHEAD, stamp=scene.clock - 3600.0)
    scene.run(1.5)
    assert states(scene)["clock"] == "bad"


def test_stop_that_was_pressed_before_the_start_tests_nothing(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    scene.ask("/stop")
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(2.0)
    assert scene.control.stopped
    assert states(scene)["stop"] == "unknown"
