"""The robot side as its clients meet it, without sockets and in virtual time."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.codec import to_json
from bridge.core.identity import public_id
from bridge.core.topics import TOPICS
from bridge.msgs.diagnostic_msgs import DiagnosticArray
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Twist,
)
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    ControlStatus,
    Event,
    Mission,
    StartTaskRequest,
    TaskOrder,
    TaskProgress,
    TaskStatus,
    Waypoint,
)
from bridge.msgs.sensor_msgs import BatteryState
from robotside.control.command_gate import STOP_SENTENCE
from robotside.records.database.storage import NotWritten, Storage
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene


def test_a_drive_command_reaches_the_robot_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    assert scene.robot.commands[-1] == Twist.planar(0.3, 0.2)


def test_the_robot_is_at_rest_within_half_a_second_of_the_last_drive_command(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    scene.run(0.2)
    assert not scene.robot.at_rest
    scene.run(0.15)
    assert scene.robot.commands[-1] is None


def test_a_socket_that_closes_while_driving_stops_the_robot_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    scene.station.on_gone(scene.anna)
    assert scene.robot.commands[-1] is None
    assert scene.control.driver == ""


def test_control_is_free_again_when_its_driver_falls_silent(scene: Scene) -> None:
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.clients.remove(scene.anna)
    scene.run(1.9)
    assert scene.control.driver == "Anna"
    scene.run(0.2)
    assert scene.control.driver == ""
    assert scene.events("control") == [
        "Anna has control.",
        "Anna lost control: no contact for 2 s.",
        "Control is free.",
    ]


def test_a_drive_command_that_is_no_number_is_said_once_and_moves_nothing(scene: Scene) -> None:
    before = len(scene.robot.commands)
    for _ in range(5):
        scene.drive(Twist.planar(math.nan, 0.0))
    assert len(scene.robot.commands) == before
    assert len(scene.events("command")) == 1


def test_a_late_drive_command_moves_nothing(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.0), stamp=scene.now - 1.0)
    assert scene.robot.at_rest


def test_with_stop_pressed_a_goal_is_refused_and_said(scene: Scene) -> None:
    scene.ask("/stop")
    scene.go_to(3.0, -2.0, 0.5)
    assert scene.events("command") == [STOP_SENTENCE]
    assert (scene.task.state, scene.control.mode) == ("IDLE", "STOPPED")


def test_with_stop_pressed_the_robot_brakes_even_if_a_task_runs(scene: Scene) -> None:
    scene.ask("/stop")
    before = len(scene.robot.commands)
    mind = scene.station.autonomy
    mind.engine.start(mind.task_factory.task(TaskOrder(task="go_to", goals=[Waypoint(3.0, -2.0)])), scene.now)
    scene.run(1.0)
    assert scene.task.state == "RUNNING"
    assert scene.robot.commands[before:]
    assert not any(scene.robot.commands[before:])
    scene.release_stop()
    scene.run(1.0)
    assert not scene.robot.at_rest


def test_everything_that_is_published_is_in_the_table_and_can_be_sent(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.drive(Twist.planar(0.1, 0.0))
    scene.ask("/task/resume")
    scene.run_task()
    types = {entry.name: entry.type for entry in TOPICS}
    for topic, msg in scene.said:
        assert type(msg) is types[topic]
        assert to_json(msg)
    told = {topic for topic, _ in scene.said}
    assert told >= {"/pose", "/tf", "/plan", "/mission", "/robot/info", "/diagnostics", "/intruders", "/map"}


@pytest.mark.parametrize(
    ("status", "charge", "level", "words"),
    [
        (BatteryState.POWER_SUPPLY_STATUS_DISCHARGING, 0.8, 0, "good"),
        (BatteryState.POWER_SUPPLY_STATUS_DISCHARGING, 0.1, 1, "low"),
        (BatteryState.POWER_SUPPLY_STATUS_CHARGING, 0.1, 1, "low, charging"),
        (BatteryState.POWER_SUPPLY_STATUS_FULL, 1.0, 0, "good, full at the dock"),
        (BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING, 0.8, 1, "good, at a dock that gives no charge"),
    ],
)
def test_diagnostics_say_what_a_dock_does_about_the_battery(
    scene: Scene, status: int, charge: float, level: int, words: str
) -> None:
    scene.robot.silent.add("/battery_state")
    scene.robot.more.append(("/battery_state", BatteryState(percentage=charge, power_supply_status=status)))
    scene.run(2.0)
    told = [msg for topic, msg in scene.said if topic == "/diagnostics" and isinstance(msg, DiagnosticArray)]
    (battery,) = (part for part in told[-1].status if part.name == "battery")
    assert (battery.level, battery.message) == (level, words)


def test_a_goal_in_a_wall_is_said_and_not_driven_to(scene: Scene) -> None:
    scene.go_to(10.2, 0.0)
    assert scene.events("command") == ["The goal at (10.2, 0.0) is in a wall or another obstacle."]
    assert not scene.station.autonomy.engine.running


def test_a_pose_that_is_no_number_is_said_and_ignored(scene: Scene) -> None:
    before = scene.station.autonomy.pose_estimator.pose
    bad = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(math.nan, 0.0))))
    scene.station.on_message(scene.anna, "/initialpose", bad, None)
    assert scene.station.autonomy.pose_estimator.pose == before
    assert scene.events("command")


def test_what_operators_are_told_carries_their_clock_at_any_speed_of_the_robots(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path, speed=4.0)
    scene.run(40.0)
    assert scene.now - scene.clock == pytest.approx(30.0)
    told = len(scene.said)
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    scene.ask("/task/pause")
    stamped = [
        (t, m)
        for t, m in scene.said[told:]
        if isinstance(m, Mission | Event | TaskStatus | TaskProgress | ControlStatus)
    ]
    assert {topic for topic, _ in stamped} == {
        "/mission",
        "/events",
        "/task/status",
        "/task/progress",
        "/control/status",
    }
    for topic, msg in stamped:
        assert msg.stamp.seconds == pytest.approx(scene.clock, abs=0.3), topic
    pose = scene.station.bus.last("/pose")
    assert isinstance(pose, PoseWithCovarianceStamped)
    assert pose.header.stamp.seconds == pytest.approx(scene.now, abs=0.06)


@pytest.mark.parametrize("part", ["update", "on_message"])
def test_a_fault_in_the_robots_mind_ends_the_task_at_rest_and_the_robot_lives_on(
    scene: Scene, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, part: str
) -> None:
    def fail(*_: object) -> None:
        raise OverflowError("too far")

    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    assert not scene.robot.at_rest
    with monkeypatch.context() as broken:
        broken.setattr(scene.station.autonomy, part, fail)
        scene.run(1.0)
    assert (scene.task.state, scene.robot.at_rest) == ("FAILED", True)
    assert scene.task.reason == "The task ended: the robot's program has a fault (OverflowError)."
    assert scene.events("task").count("The robot's program has a fault: OverflowError('too far').") == 1
    assert [record.exc_info[0] for record in caplog.records if record.exc_info] == [OverflowError]
    scene.drive(Twist.planar(0.3, 0.0))
    scene.run(0.1)
    assert not scene.robot.at_rest
    scene.run(1.0)
    scene.start()
    scene.run(1.0)
    assert scene.task.state == "RUNNING"


def test_what_others_call_things_is_cut_wherever_it_is_kept(scene: Scene) -> None:
    long = "A\n\u202e" + "b" * 900_000
    shown = "A " + "b" * 38
    scene.ask("/control/acquire", CommandRequest(client_id="c" * 900_000, client_name=long))
    assert (scene.control.driver, scene.control.driver_id) == (shown, public_id("c" * 64))
    scene.set(Waypoint(4.0, 0.0, name=long), home=[Waypoint(0.0, 0.0, name=long)])
    assert {
        place.name
        for place in (*scene.station.missions.current.waypoints, *scene.station.missions.current.home)
    } == {"A " + "b" * 58}
    assert len(scene.refused("/task/start", StartTaskRequest(task=long))) <= 300
    assert "at most 64 characters, not 65" in scene.refused("/task/pause", CommandRequest("c" * 65))
    assert scene.ask("/stop", CommandRequest("c" * 65)).success
    assert scene.events("stop") == [f"STOP pressed by {shown}."]


def test_stop_is_still_pressed_after_the_computer_died_and_says_so(scene: Scene, tmp_path: Path) -> None:
    scene.ask("/stop", CommandRequest(client_id="a", client_name="Anna"))
    assert scene.control.stopped_by_id == public_id("a")
    again = Scene(FakeRobot(), tmp_path)
    assert (again.control.mode, again.control.stopped_by) == ("STOPPED", "Anna")
    assert again.control.stopped_by_id == "", "only the name is kept"
    assert again.since_start() == ["STOP, pressed by Anna before the restart, is still pressed."]
    again.run(4.0)
    again.drive(Twist.planar(0.3, 0.0))
    assert again.robot.at_rest
    assert again.release_stop().success
    assert not Scene(FakeRobot(), tmp_path).control.stopped


def test_after_a_clean_end_nothing_but_a_persons_stop_is_left(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.station.end()
    scene.run(0.5)
    again = Scene(FakeRobot(), tmp_path)
    assert (again.control.stopped, again.since_start()) == (False, [])
    again.ask("/stop", CommandRequest(client_name="Anna"))
    again.station.end()
    assert Scene(FakeRobot(), tmp_path).control.stopped_by == "Anna"


def test_stop_is_obeyed_when_it_cannot_be_noted_and_that_is_said(
    scene: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise NotWritten("The disk is full.")

    monkeypatch.setattr(Storage, "write", full)
    scene.drive(Twist.planar(0.3, 0.0))
    assert scene.ask("/stop").success
    assert scene.robot.at_rest
    assert scene.events("database") == ["The disk is full."]


def test_only_who_has_control_may_place_the_robot_while_somebody_has_it(scene: Scene) -> None:
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    before = scene.station.autonomy.pose_estimator.pose
    there = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(3.0, 3.0))))
    scene.station.on_message(scene.client("bert"), "/initialpose", there, None)
    assert scene.station.autonomy.pose_estimator.pose == before
    assert scene.events("command")[-1].startswith("Anna has control")


@pytest.mark.parametrize("running", [False, True])
def test_stop_is_latched_though_the_port_fails_and_its_answer_says_that(scene: Scene, running: bool) -> None:
    scene.set(*SQUARE)
    scene.start() if running else scene.drive(Twist.planar(0.4, 0.0))
    scene.run(0.2)

    def fail() -> None:
        raise OSError("gone")

    obeys, scene.robot.stop = scene.robot.stop, fail  # type: ignore[method-assign]
    said = scene.refused("/stop", CommandRequest(client_name="Bert"))
    assert said == "STOP is pressed, but the robot's port failed: OSError('gone')."
    assert scene.control.stopped_by == "Bert"
    assert not scene.station.autonomy.engine.running
    assert "STOP pressed by Bert." in scene.events("stop")
    scene.robot.stop = obeys  # type: ignore[method-assign]
    scene.ask("/stop")
    scene.run(0.2)
    assert scene.robot.at_rest
    assert scene.ask("/stop").message == "Stopped."
