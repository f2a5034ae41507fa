"""What the robot does by itself, in virtual time."""

from __future__ import annotations

import math
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
from bridge.msgs.pilothouse_msgs import (
    Event,
    GetIntruderPictureRequest,
    IntruderArray,
    Mission,
    SetMissionRequest,
    Waypoint,
)
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage
from bridge.msgs.std_msgs import Header, Time
from tests.fakes import Box, FakeRobot, Pillar
from tests.robotside.perception.drawn import cone_ahead, person_ahead
from tests.robotside.scene import SQUARE, Scene


def test_an_empty_battery_sends_the_robot_home_by_itself(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(5.0)
    scene.robot.battery = 0.09
    scene.run(1.1)
    assert scene.task.task == "go_home"
    assert scene.events("battery") == ["Battery low: 9%.", "Battery at 9%: going home."]
    assert scene.run_task().reason == "Home."


def test_a_battery_that_falls_silent_proves_no_charge_any_more(scene: Scene) -> None:
    scene.robot.charging = True
    scene.run(1.1)
    situation = scene.station.autonomy.situation
    assert situation.charging
    scene.robot.silent.add("/battery_state")
    scene.run(9.0)
    assert situation.charging, "usual ones tell once a second, some more seldom"
    scene.station.autonomy.skip(5.0)
    scene.run(0.5)
    assert situation.charging, "nobody could hear it in a jump of the clock"
    scene.run(8.0)
    assert not situation.charging
    assert situation.power == BatteryState.POWER_SUPPLY_STATUS_UNKNOWN


def test_the_bumper_halts_the_patrol(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    x, y, _ = scene.robot.pose
    scene.robot.pillars.append(Pillar(x + 0.25, y, 0.12))
    scene.run(0.2)
    assert scene.task.reason == "Paused: the bumper touched something."
    assert scene.robot.at_rest
    assert len(scene.events("contact")) == 1


@pytest.mark.parametrize(("topic", "sense"), [("/scan", "laser"), ("/odom", "odometry")])
def test_a_robot_that_has_become_blind_halts(scene: Scene, topic: str, sense: str) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    scene.robot.silent.add(topic)
    scene.run(0.9)
    assert scene.task.reason == f"Paused: the {sense} has been silent for 0.6 s."
    assert scene.robot.at_rest


def test_a_robot_that_was_placed_by_a_finger_finds_its_exact_pose(tmp_path: Path) -> None:
    hall = FakeRobot(start=(-6.0, 2.0, 0.8), boxes=[Box(-1.0, 2.0, 1.0, 4.0), Box(3.0, -5.0, 4.0, -2.0)])
    scene = Scene(hall, tmp_path)
    told = Pose(Point(-5.5, 1.6), Quaternion.from_yaw(0.5))
    scene.run(0.5)
    scene.station.on_message(
        scene.anna, "/initialpose", PoseWithCovarianceStamped(pose=PoseWithCovariance(told)), None
    )
    scene.run(2.0)
    pose = scene.station.autonomy.pose_estimator.pose
    assert pose is not None
    assert pose == pytest.approx((-6.0, 2.0, 0.8), abs=0.08)
    assert scene.station.autonomy.pose_estimator.sure


def test_the_camera_is_wanted_only_while_a_task_runs(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    assert scene.robot.wanted["/camera/image/compressed"]
    scene.run_task()
    assert not scene.robot.wanted["/camera/image/compressed"]


def show_cone(scene: Scene, picture: bytes = b"") -> None:
    """Five pictures of a cone 3 m ahead, or of something else."""
    for n in range(5):
        data = bytes(bytearray(picture or cone_ahead()))
        shot = CompressedImage(Header(Time.at(scene.now - 0.5 + 0.21 * n), "camera"), "jpeg", data)
        scene.station.autonomy.on_message("/camera/image/compressed", shot, scene.now)


def test_who_drives_by_hand_and_looks_at_the_camera_is_told_of_an_intruder(scene: Scene) -> None:
    scene.run(0.5)
    show_cone(scene)
    assert not scene.station.autonomy.engine.active
    known = scene.station.bus.last("/intruders")
    assert isinstance(known, IntruderArray)
    assert [intruder.id for intruder in known.intruders] == [1]
    assert len(scene.events("intruder")) == 1


def test_the_event_of_an_intruder_has_its_picture(scene: Scene) -> None:
    scene.run(0.5)
    show_cone(scene)
    (event,) = [msg for msg in scene.of("/events") if isinstance(msg, Event) and msg.kind == "intruder"]
    answer: Any = scene.ask("/events/picture", GetIntruderPictureRequest(stamp=math.nan, event=event.id))
    assert answer.picture.data.startswith(b"\xff\xd8")
    assert scene.refused("/events/picture", GetIntruderPictureRequest(event=999)).startswith("There is no")


def test_a_class_that_no_camera_tells_apart_is_refused(scene: Scene) -> None:
    mission = Mission(waypoints=[Waypoint(1.0, 0.0)], intruder_classes=["ghost"])
    said = scene.refused("/mission/set", SetMissionRequest(mission=mission))
    assert said == "There is no class 'ghost' of intruders; there are cone, person, car, box."


@pytest.mark.parametrize(
    ("classes", "said"), [((), ["a person"]), (("cone",), []), (("person", "car"), ["a person"])]
)
def test_on_a_patrol_the_mission_says_what_counts_and_the_event_has_its_class_and_its_picture(
    scene: Scene, classes: tuple[str, ...], said: list[str]
) -> None:
    scene.set(Waypoint(6.0, -4.0), intruder_classes=list(classes))
    scene.start()
    scene.run(0.1)
    show_cone(scene, person_ahead())
    events = [msg for msg in scene.of("/events") if isinstance(msg, Event) and msg.kind == "intruder"]
    assert [any(words in event.text for words in said) for event in events] == [True] * len(said)
    for event in events:
        asked = GetIntruderPictureRequest(stamp=math.nan, event=event.id)
        answer: Any = scene.ask("/events/picture", asked)
        assert answer.picture.data.startswith(b"\xff\xd8")
    assert scene.refused("/events/picture", GetIntruderPictureRequest(event=999)).startswith("There is no")


def test_who_drives_by_hand_among_people_is_not_told_of_each_of_them(scene: Scene) -> None:
    scene.run(0.5)
    show_cone(scene, person_ahead())
    assert scene.events("intruder") == []


def test_an_intruder_found_while_a_patrol_rests_leaves_what_is_said_of_the_patrol(scene: Scene) -> None:
    scene.set(Waypoint(6.0, -4.0), stop_on_intruder=True)
    scene.start()
    scene.run(0.1)
    scene.station.autonomy.engine.pause("Paused: Anna took the stick.")
    show_cone(scene)
    assert len(scene.events("intruder")) == 1
    assert scene.task.reason == "Paused: Anna took the stick."


@pytest.mark.parametrize(
    ("words", "state", "phase"),
    [
        ({"stop_on_intruder": True, "on_intruder": "report"}, "PAUSED", ""),
        ({"on_intruder": "stop"}, "PAUSED", ""),
        ({"on_intruder": "report"}, "RUNNING", "driving"),
        ({}, "RUNNING", "driving"),
        ({"on_intruder": "circle"}, "RUNNING", "circling"),
    ],
)
def test_an_intruder_is_told_once_and_the_patrol_does_about_it_what_the_mission_says(
    scene: Scene, words: dict[str, object], state: str, phase: str
) -> None:
    scene.set(Waypoint(6.0, -4.0), **words)
    scene.start()
    scene.run(0.1)
    show_cone(scene)
    assert len(scene.events("intruder")) == 1
    known = scene.station.bus.last("/intruders")
    assert isinstance(known, IntruderArray)
    assert [intruder.id for intruder in known.intruders] == [1]
    scene.run(0.1)
    assert (scene.task.state, scene.task.phase) == (state, phase)


def test_a_robot_that_was_carried_away_says_that_it_is_unsure_creeps_and_finds_itself(tmp_path: Path) -> None:
    boxes = [Box(-1.0, 2.0, 1.0, 4.0), Box(3.0, -5.0, 4.0, -2.0), Box(-8.0, -4.0, -6.0, -3.0)]
    scene = Scene(FakeRobot(boxes=boxes), tmp_path)
    scene.run(4.0)
    scene.set(Waypoint(8.0, 0.0))
    scene.start()
    scene.run(2.0)
    scene.robot.pose = (-4.0, 4.0, 2.0)
    estimator = scene.station.autonomy.pose_estimator
    scene.until(lambda: not estimator.sure, 1.5)
    scene.run(0.05)
    assert abs(scene.robot.twist.linear.x) <= 0.15
    scene.until(lambda: estimator.sure, 8.0)
    x, y, _ = scene.robot.pose
    assert estimator.pose is not None
    assert estimator.pose.distance(x, y) < 0.2
    said = scene.events("localisation")
    assert any(each.startswith("Position unsure") for each in said)
    assert any(each.startswith("The robot has found by itself") for each in said)
    assert said[-1] == "Position sure again."
    assert scene.run_task().state == "SUCCEEDED"
    assert math.hypot(scene.robot.pose[0] - 8.0, scene.robot.pose[1]) < 0.2
    assert scene.robot.contacts == 0


def test_a_pose_told_by_a_finger_half_a_metre_off_is_put_right_by_the_next_sweep(tmp_path: Path) -> None:
    boxes = [Box(-1.0, 2.0, 1.0, 4.0), Box(3.0, -5.0, 4.0, -2.0), Box(-8.0, -4.0, -6.0, -3.0)]
    scene = Scene(FakeRobot(boxes=boxes), tmp_path)
    scene.run(4.0)
    for x, y, yaw, off in ((-4.0, 4.5, 0.6, 0.4), (4.3, -0.8, 2.2, -0.4), (0.4, -0.3, 2.4, 0.3)):
        scene.robot.pose = (x, y, yaw)
        told = Pose(Point(x + off, y - 0.3), Quaternion.from_yaw(yaw + 0.2))
        stamped = PoseWithCovarianceStamped(pose=PoseWithCovariance(told))
        scene.station.on_message(scene.anna, "/initialpose", stamped, None)
        scene.run(0.5)
        pose = scene.station.autonomy.pose_estimator.pose
        assert pose is not None
        assert pose.distance(x, y) < 0.05
        assert pose.yaw == pytest.approx(yaw, abs=0.02)
