"""Tasks from start to end, in virtual time."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import (
    Twist,
)
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    TaskProgress,
    TaskStatus,
    Waypoint,
)
from tests.robotside.scene import SQUARE, Scene


def test_stop_holds_a_patrol_and_release_does_not_resume_it(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(3.0)
    scene.ask("/stop", CommandRequest(client_name="Anna"))
    assert (scene.task.state, scene.task.reason) == ("PAUSED", "Stopped by Anna.")
    scene.release_stop()
    scene.run(1.0)
    assert scene.robot.at_rest
    assert scene.control.mode == "PAUSED"
    assert scene.ask("/task/resume").success
    scene.run(1.0)
    assert not scene.robot.at_rest


def test_a_patrol_visits_every_point_and_ends(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    near = [math.inf] * 3
    while scene.station.autonomy.engine.running:
        scene.run(0.1)
        x, y, _ = scene.robot.pose
        near = [min(best, math.hypot(x - p.x, y - p.y)) for best, p in zip(near, SQUARE, strict=True)]
    assert max(near) < 0.15
    assert (scene.task.state, scene.task.visited) == ("SUCCEEDED", 3)
    assert scene.robot.at_rest
    assert scene.robot.contacts == 0


def test_task_status_is_said_once_per_change_and_progress_twice_a_second(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    before = scene.now
    scene.start()
    scene.run_task()
    states = [msg for msg in scene.of("/task/status") if isinstance(msg, TaskStatus)]
    assert len(states) == len({(s.state, s.waypoint, s.visited, s.lap, s.reason) for s in states})
    progress = [msg for msg in scene.of("/task/progress") if isinstance(msg, TaskProgress)]
    assert len(progress) == pytest.approx(2 * (scene.now - before), abs=3)
    parts = [p.progress for p in progress]
    assert parts == pytest.approx(sorted(parts), abs=0.02)
    assert progress[-1].distance_driven == pytest.approx(4 + 3 + 6, abs=1.0)


def test_pause_holds_within_five_centimetres_and_resume_goes_on(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.run(4.0)
    assert scene.ask("/task/pause").success
    x, y, _ = scene.robot.pose
    scene.run(10.0)
    assert math.hypot(scene.robot.pose[0] - x, scene.robot.pose[1] - y) < 0.05
    assert scene.ask("/task/resume").success
    assert scene.run_task().state == "SUCCEEDED"


def test_taking_the_stick_pauses_the_patrol_and_letting_go_does_not_resume(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    scene.drive(Twist())
    assert scene.task.state == "RUNNING"
    scene.station.controls.introduce(scene.anna, "t1", "Anna")
    scene.drive(Twist.planar(-0.2, 0.0))
    assert scene.task.reason == "Paused: Anna took the stick."
    assert scene.robot.commands[-1] == Twist.planar(-0.2, 0.0)
    scene.run(2.0)
    assert scene.robot.at_rest
    assert scene.task.state == "PAUSED"


def test_the_patrol_goes_on_when_every_handheld_is_gone(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.run(1.0)
    scene.station.on_gone(scene.anna)
    assert not scene.robot.at_rest
    assert scene.run_task().state == "SUCCEEDED"


def test_cancel_ends_the_patrol_at_rest(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    assert scene.ask("/task/cancel").success
    scene.run(0.5)
    assert scene.robot.at_rest
    assert scene.task.state == "CANCELED"
    assert "No task is running" in scene.refused("/task/cancel")


def test_home_is_reached_from_within_a_patrol(scene: Scene) -> None:
    scene.set(*SQUARE, home=[Waypoint(-1.0, -2.0, math.pi / 2)])
    scene.start()
    scene.run(5.0)
    assert scene.ask("/task/go_home").success
    first, second = scene.of("/task/status")[-2:]
    assert isinstance(first, TaskStatus)
    assert isinstance(second, TaskStatus)
    assert (first.state, second.task, second.task_id) == ("CANCELED", "go_home", 2)
    status = scene.run_task()
    assert (status.state, status.reason) == ("SUCCEEDED", "Home.")
    x, y, yaw = scene.robot.pose
    assert math.hypot(x + 1.0, y + 2.0) < 0.15
    assert yaw == pytest.approx(math.pi / 2, abs=0.1)


def test_a_goal_is_driven_to_once(scene: Scene) -> None:
    scene.go_to(3.0, -2.0, 0.5)
    assert scene.run_task().state == "SUCCEEDED"
    assert math.hypot(scene.robot.pose[0] - 3.0, scene.robot.pose[1] + 2.0) < 0.15
