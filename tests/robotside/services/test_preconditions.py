"""Whoever changes what the robot will do has control, or takes it; nobody drives it from aside."""

from __future__ import annotations

import math

import pytest

from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    Mission,
    ScheduledTask,
    SetMissionRequest,
    SetModeRequest,
    SetQueueRequest,
    SetScheduleRequest,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from robotside.control.authority import TAKEOVER_SILENCE
from tests.fakes import FakeClient
from tests.robotside.scene import SQUARE, Scene

STRAIGHT = TaskOrder(task="follow_heading", heading=0.0)
QUEUE = SetQueueRequest(orders=[STRAIGHT])
NIGHTLY = SetScheduleRequest(task=ScheduledTask(order=STRAIGHT, every=60.0))
PLACED = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(1.0, 1.0))))


@pytest.mark.parametrize(("service", "asked"), [("/task/queue/set", QUEUE), ("/schedule/set", NIGHTLY)])
def test_what_will_move_the_robot_takes_control_and_is_refused_while_another_has_it(
    scene: Scene, service: str, asked: Msg
) -> None:
    bert = scene.client("bert")
    assert scene.ask(service, asked, bert).success
    scene.run(0.1)
    assert scene.control.driver_id == "bert"
    assert "has control" in scene.refused(service, asked)


@pytest.mark.parametrize(
    ("service", "asked"),
    [
        ("/task/queue/set", SetQueueRequest()),
        ("/schedule/set", SetScheduleRequest(task=ScheduledTask(order=STRAIGHT, every=60.0, enabled=False))),
        ("/mission/set", SetMissionRequest(mission=Mission(waypoints=SQUARE))),
    ],
)
def test_what_moves_nothing_needs_no_control(scene: Scene, service: str, asked: Msg) -> None:
    assert scene.ask(service, asked).success
    scene.run(0.1)
    assert scene.control.driver_id == ""


def test_the_answer_about_a_queue_says_whether_it_begins(scene: Scene) -> None:
    scene.ask("/stop")
    said = scene.ask("/task/queue/set", QUEUE).message
    assert said == "1 task waits in the queue; it waits, since STOP is pressed."
    scene.run(2.0)
    assert scene.task.state == "IDLE"
    scene.release_stop()
    scene.ask("/task/queue/set", SetQueueRequest(revision=1))
    said = scene.ask("/task/queue/set", SetQueueRequest(revision=2, orders=[STRAIGHT])).message
    assert said == "1 task waits in the queue; it begins now."
    scene.run(1.1)
    assert scene.task.state == "RUNNING"
    said = scene.ask("/task/queue/set", SetQueueRequest(revision=4, orders=[STRAIGHT])).message
    assert said == "1 task waits in the queue.", "for the one that runs"


def test_the_mission_that_is_patrolled_is_changed_only_with_control(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    request = SetMissionRequest(mission=Mission(waypoints=[Waypoint(1.0, 1.0)]))
    bert = scene.client("bert")
    assert "has control" in scene.refused("/mission/set", request, bert)
    scene.station.on_gone(scene.anna)
    assert scene.ask("/mission/set", request, bert).success
    scene.run(0.1)
    assert scene.control.driver_id == "bert"


def test_who_says_where_the_robot_is_takes_control(scene: Scene) -> None:
    bert = scene.client("bert")
    scene.station.on_message(bert, "/initialpose", PLACED, None)
    assert scene.control.driver_id == "bert"
    scene.station.on_message(scene.anna, "/initialpose", PLACED, None)
    assert "has control" in scene.events("command")[-1]
    assert sum("placed the robot" in said for said in scene.events("localisation")) == 1


NOWHERE = TaskOrder(task="go_to", goals=[Waypoint(900.0, 900.0)])


@pytest.mark.parametrize(
    ("service", "asked"),
    [
        ("/task/start", StartTaskRequest(order=NOWHERE)),
        ("/task/start", StartTaskRequest(task="dance")),
        ("/task/pause", CommandRequest()),
        ("/task/resume", CommandRequest()),
        ("/task/cancel", CommandRequest()),
        ("/task/queue/set", SetQueueRequest(revision=7, orders=[STRAIGHT])),
        ("/schedule/set", SetScheduleRequest(task=ScheduledTask(order=STRAIGHT, every=-1.0))),
        ("/mode/set", SetModeRequest(mode="AUTO")),
    ],
)
def test_what_is_refused_takes_no_control(scene: Scene, service: str, asked: Msg) -> None:
    scene.said.clear()
    assert scene.refused(service, asked)
    scene.run(0.1)
    assert scene.station.controls.driver is None
    assert not any("has control" in said for said in scene.events())


def test_what_is_refused_leaves_control_to_who_had_it(scene: Scene) -> None:
    assert scene.ask("/control/acquire").success
    held = scene.station.controls.driver
    for client in (scene.anna, scene.client("bert")):
        assert scene.refused("/task/start", StartTaskRequest(order=NOWHERE), client)
        assert scene.station.controls.driver == held


def test_what_is_refused_does_not_move_control_to_another_connection_of_its_holder(scene: Scene) -> None:
    who = {"client_id": "a1", "client_name": "Anna"}
    assert scene.ask("/control/acquire", CommandRequest(**who)).success
    again = FakeClient("again", scene.clock + TAKEOVER_SILENCE + 0.1)
    assert scene.refused("/task/start", StartTaskRequest(order=NOWHERE, **who), again)
    assert scene.station.controls.holds(scene.anna)
    assert scene.ask("/task/start", StartTaskRequest(order=STRAIGHT, **who), again).success
    assert scene.station.controls.holds(again)


def test_what_is_refused_does_not_bring_control_back_to_who_fell_silent(scene: Scene) -> None:
    assert scene.ask("/control/acquire").success
    bert = FakeClient("bert", scene.clock + CONTROL_TIMEOUT + 0.1)
    scene.clock = bert.last_heard
    assert scene.refused("/task/start", StartTaskRequest(order=NOWHERE), bert)
    assert scene.station.controls.driver is None


def test_a_goal_that_is_refused_takes_no_control(scene: Scene) -> None:
    scene.go_to(900.0, 900.0)
    assert scene.station.controls.driver is None
    scene.go_to(2.0, 0.0)
    assert scene.station.controls.holds(scene.anna)


@pytest.mark.parametrize("x", [900.0, math.nan])
def test_a_place_that_is_refused_takes_no_control(scene: Scene, x: float) -> None:
    place = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, 1.0))))
    scene.station.on_message(scene.anna, "/initialpose", place, None)
    assert scene.station.controls.driver is None
