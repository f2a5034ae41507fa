"""A robot that is unsure of its place: no task of it is done there, and the queue waits."""

from __future__ import annotations

import numpy as np
import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import (
    Place,
    SetPlaceRequest,
    SetQueueRequest,
    StartTaskRequest,
    TaskOrder,
    TaskQueue,
    Waypoint,
)
from robotside.core.pose2 import ORIGIN
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.tasks.behaviours.course import Span
from robotside.tasks.engine import Engine, Task
from robotside.tasks.place_trust import BY_WORD_THERE, ENDS_AT_PLACE
from tests.robotside.scene import Scene
from tests.robotside.tasks.test_engine_alone import Run

ORDERS = {
    "go_to": TaskOrder(task="go_to", goals=[Waypoint(2.0, 0.0)]),
    "patrol": TaskOrder(task="patrol"),
    "deliver": TaskOrder(task="deliver", places=["Lab", "Office"]),
    "guide": TaskOrder(task="guide", places=["Lab", "Office"]),
    "go_home": TaskOrder(task="go_home"),
}


class Belief:
    """How sure the robot is of its place, as a test has it."""

    def __init__(self) -> None:
        self.sure = True


@pytest.fixture
def belief(monkeypatch: pytest.MonkeyPatch) -> Belief:
    said = Belief()
    monkeypatch.setattr(PoseEstimator, "sure", property(lambda _: said.sure))
    return said


def begin(scene: Scene, order: TaskOrder) -> None:
    scene.set(Waypoint(2.0, 0.0), Waypoint(2.0, 2.0), laps=1, home=[Waypoint(-1.0, 0.0)])
    for name, x in (("Lab", 2.0), ("Office", -2.0)):
        scene.ask("/places/set", SetPlaceRequest(place=Place(name=name, x=x, y=1.0)))
    answer = scene.ask("/task/start", StartTaskRequest(order=order))
    assert answer.success, answer.message


@pytest.mark.parametrize("task", ORDERS)
def test_no_task_is_done_at_a_place_that_the_robot_is_unsure_of(
    task: str, scene: Scene, belief: Belief
) -> None:
    begin(scene, ORDERS[task])
    scene.run(1.0)
    belief.sure = False
    status = scene.run_task()
    assert (status.state, status.code) == ("FAILED", Code.TASK_PLACE_UNSURE.value)
    assert status.reason.startswith("There, unsure of its place")
    assert status.reason.endswith("Place the robot on the map, then start again.")
    assert not scene.events("waypoint") or all("skipped" in said for said in scene.events("waypoint"))
    assert scene.robot.at_rest


def test_what_is_sure_again_at_the_goal_is_there(scene: Scene, belief: Belief) -> None:
    belief.sure = False
    begin(scene, ORDERS["go_to"])
    scene.until(lambda: scene.task.phase == "unsure", 60.0)
    assert scene.task.reason == "Making sure that this is the goal."
    belief.sure = True
    assert scene.run_task(5.0).state == "SUCCEEDED"


def test_the_queue_waits_behind_a_task_that_ended_unsure(scene: Scene, belief: Belief) -> None:
    begin(scene, ORDERS["go_to"])
    known = scene.station.bus.last("/task/queue")
    assert isinstance(known, TaskQueue)
    asked = SetQueueRequest(revision=known.revision, orders=[TaskOrder(task="hold", duration=5.0)])
    assert scene.ask("/task/queue/set", asked).success
    belief.sure = False
    scene.run_task()
    scene.run(5.0)
    queue = scene.station.bus.last("/task/queue")
    assert isinstance(queue, TaskQueue)
    assert (len(queue.orders), queue.held) == (1, "the robot is unsure of its place")
    assert scene.ask("/task/resume").success
    scene.run(2.0)
    assert scene.task.task == "hold"


class Done(Behaviour):
    """Comes to its end at once."""

    def update(self) -> Status:
        return Status.SUCCESS


def ended(run: Run, name: str) -> tuple[str, str]:
    engine: Engine = run.engine
    engine.start(Task(name, name, Done(name), Span(1.0, lambda: 1.0)), 0.0)
    engine.tick(ORIGIN, np.empty((0, 2)), 0.0, 1.0)
    return engine.status.state, engine.status.code


@pytest.mark.parametrize("name", ENDS_AT_PLACE)
def test_the_engine_itself_calls_no_such_task_done(name: str) -> None:
    run = Run()
    run.situation.sure = False
    assert ended(run, name) == ("FAILED", Code.TASK_PLACE_UNSURE.value)
    run.situation.sure = True
    assert ended(run, name)[0] == "SUCCEEDED"


@pytest.mark.parametrize("name", ENDS_AT_PLACE)
def test_what_is_sure_by_an_operators_word_alone_is_no_more_done(name: str) -> None:
    run = Run()
    run.situation.by_word = True
    assert ended(run, name) == ("FAILED", Code.TASK_PLACE_UNSURE.value)
    assert run.engine.status.reason == BY_WORD_THERE
    run.situation.by_word = False
    assert ended(run, name)[0] == "SUCCEEDED"


def test_a_robot_whose_place_is_by_word_alone_comes_to_its_goal_and_is_not_done(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PoseEstimator, "by_word", property(lambda _: True))
    begin(scene, ORDERS["go_to"])
    status = scene.run_task()
    assert (status.state, status.code) == ("FAILED", Code.TASK_PLACE_UNSURE.value)
    assert status.reason == BY_WORD_THERE


@pytest.mark.parametrize("name", ["hold", "follow_heading", "land", "surface"])
def test_a_task_that_ends_nowhere_in_particular_is_done_all_the_same(name: str) -> None:
    run = Run()
    run.situation.sure = False
    assert ended(run, name)[0] == "SUCCEEDED"
