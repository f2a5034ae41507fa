"""What becomes of a task when the robot's computer dies in the middle of it."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    GetHistoryRequest,
    Place,
    SetPlaceRequest,
    SetQueueRequest,
    StartTaskRequest,
    TaskOrder,
    TaskQueue,
    Waypoint,
)
from robotside.core.pose2 import Pose2
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene

OFFER = "The robot's computer restarted in the middle of a patrol; choose Resume to go on, or Discard."


def cut(scene: Scene, state: Path) -> Scene:
    """The robot side dies, and another one is started where the robot stands."""
    again = Scene(FakeRobot(start=scene.robot.pose), state)
    again.run(4.0)
    return again


def test_it_is_offered_and_never_resumed_by_itself(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    while scene.task.visited < 1:
        scene.run(0.5)
    scene.run(1.0)
    again = cut(scene, tmp_path)
    assert (again.task.state, again.task.reason, again.task.visited) == ("INTERRUPTED", OFFER, 1)
    assert again.control.mode == "MANUAL"
    again.run(30.0)
    assert again.robot.at_rest
    assert again.robot.commands == []


def test_resumed_it_goes_on_under_its_number_at_the_point_that_it_headed_for(
    scene: Scene, tmp_path: Path
) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    while scene.task.visited < 1:
        scene.run(0.5)
    scene.run(1.0)
    again = cut(scene, tmp_path)
    x, y, yaw = again.robot.pose
    placed = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose2(x, y, yaw).to_msg()))
    again.station.on_message(again.anna, "/initialpose", placed, None)  # the hall looks the same turned round
    assert again.ask("/task/resume").success
    again.run(0.1)
    assert (again.task.task_id, again.task.state, again.task.waypoint) == (1, "RUNNING", 2)
    assert again.run_task().state == "SUCCEEDED"
    assert again.task.visited == 3
    runs = again.ask("/history/get", GetHistoryRequest(limit=5)).runs  # type: ignore[attr-defined]
    assert [(run.id, run.state, run.visited) for run in runs] == [(1, "SUCCEEDED", 3)]
    assert runs[0].distance == pytest.approx(4 + 3 + 6, abs=1.5)
    ended = cut(again, tmp_path).task
    assert (ended.task_id, ended.state, ended.reason) == (1, "SUCCEEDED", again.task.reason)
    assert (ended.task, ended.visited, ended.stamp) == ("patrol", 3, again.task.stamp)


def test_discarded_it_has_ended_and_is_offered_no_more(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    again = cut(scene, tmp_path)
    assert again.ask("/task/cancel", CommandRequest(client_name="Anna")).message == "Discarded."
    assert (again.task.state, again.task.reason) == ("CANCELED", "Discarded by Anna.")
    assert "No task is paused" in again.refused("/task/resume")
    ended = cut(again, tmp_path).task
    assert (ended.task_id, ended.state, ended.reason) == (1, "CANCELED", "Discarded by Anna.")


def test_undecided_it_is_offered_again_after_the_next_restart_with_all_that_was_noted(
    scene: Scene, tmp_path: Path
) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    while scene.task.visited < 2:
        scene.run(0.5)
    scene.run(0.5)
    again = cut(cut(scene, tmp_path), tmp_path)
    assert again.task.reason == OFFER
    again.ask("/task/resume")
    again.run(0.1)
    assert again.task.waypoint == 3


def test_another_task_discards_it_and_that_is_said(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(5.0)
    again = cut(scene, tmp_path)
    assert again.ask("/task/go_home").success
    again.run(0.1)
    runs = again.ask("/history/get", GetHistoryRequest(limit=5)).runs  # type: ignore[attr-defined]
    assert [(run.order.task, run.state) for run in runs] == [("go_home", "RUNNING"), ("patrol", "CANCELED")]
    assert "The task before the restart ended: way home was requested instead." in again.events("task")


def test_stop_keeps_it_from_being_resumed(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.ask("/stop")
    again = cut(scene, tmp_path)
    assert "STOP is pressed" in again.refused("/task/resume")
    again.release_stop()
    again.run(1.0)
    assert again.task.state == "INTERRUPTED"
    assert again.ask("/task/resume").success


def test_a_delivery_whose_place_is_gone_cannot_be_resumed_and_says_so(scene: Scene, tmp_path: Path) -> None:
    for name, x in (("Office 12", 3.0), ("Lab", -3.0)):
        scene.ask("/places/set", SetPlaceRequest(place=Place(name=name, x=x)))
    order = TaskOrder(task="deliver", places=["Office 12", "Lab"])
    assert scene.ask("/task/start", StartTaskRequest(order=order)).success
    scene.run(1.0)
    again = cut(scene, tmp_path)
    assert again.task.places == ["Office 12", "Lab"]
    again.station.records.places.delete(2)
    assert again.refused("/task/resume") == "There is no place 'Lab'; there are Office 12."
    assert again.task.state == "INTERRUPTED"


def test_of_a_time_to_hold_what_was_left_is_held(scene: Scene, tmp_path: Path) -> None:
    scene.ask("/task/start", StartTaskRequest(order=TaskOrder(task="hold", duration=60.0)))
    scene.run(50.0)
    again = cut(scene, tmp_path)
    assert again.ask("/task/resume").success
    began = again.now
    again.run_task()
    assert again.now - began == pytest.approx(10.0, abs=6.0)


def test_a_queue_waits_after_a_restart_until_somebody_says_so(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    order = TaskOrder(task="go_to", goals=[Waypoint(1.0, 1.0)])
    assert scene.ask("/task/queue/set", SetQueueRequest(orders=[order])).success
    again = cut(scene, tmp_path)
    said = "1 task waits in the queue, since the robot's computer was restarted, until you choose Go on with this."
    assert said in again.since_start()
    again.ask("/task/cancel")
    again.run(5.0)
    assert again.robot.at_rest
    assert again.ask("/task/resume").message == "The queue goes on."
    assert again.run_task().state == "CANCELED"
    again.run(1.0)
    assert again.run_task().state == "SUCCEEDED"
    x, y, _ = again.robot.pose
    assert math.hypot(x - 1.0, y - 1.0) < 0.15
    queue = again.station.bus.last("/task/queue")
    assert isinstance(queue, TaskQueue)
    assert queue.orders == []


def test_with_a_low_battery_it_is_not_resumed(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    again = cut(scene, tmp_path)
    again.robot.battery = 0.14
    again.run(1.1)
    said = "The battery is at 14%; a patrol needs at least 15%."
    assert again.refused("/task/resume") == said
    assert again.task.state == "INTERRUPTED"
