"""A task waits while it is asked where the robot is, or while its computer lags too much, and goes on by itself."""

from __future__ import annotations

import math

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import PlaceCandidate, TaskProgress
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.tasks.behaviours.course import Span
from robotside.tasks.engine import Task
from tests.robotside.scene import SQUARE, Scene
from tests.robotside.tasks.test_engine_alone import Run
from tests.robotside.tasks.test_place_trust import ended


def test_a_robot_that_asks_where_it_is_waits_and_goes_on_when_it_is_answered(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[PlaceCandidate, ...]] = [()]
    monkeypatch.setattr(PoseEstimator, "candidates", property(lambda _: asked[0]))
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.run(3.0)
    asked[0] = two_places()
    scene.run(4.0)
    assert scene.robot.at_rest
    assert (scene.task.state, scene.task.phase) == ("RUNNING", "unsure")
    assert scene.task.reason == "Unsure of its place: several fit. Choose the right one on the map."
    told = scene.of("/task/progress")[-1]
    assert isinstance(told, TaskProgress)
    assert 0.0 < told.progress < 1 / 3, "it is on its first of three legs, and has no way"
    assert math.isnan(told.time_left)
    assert math.isnan(told.distance_to_next)
    asked[0] = ()
    assert scene.run_task().state == "SUCCEEDED"


def two_places() -> tuple[PlaceCandidate, ...]:
    return PlaceCandidate(1, 0.0, 0.0, 0.0, 0.5, 0.1), PlaceCandidate(2, 3.0, 0.0, 0.0, 0.5, 0.1)


def test_while_it_asks_only_tasks_that_go_by_its_place_wait() -> None:
    run = Run()
    run.situation.place_asked = True
    assert ended(run, "land")[0] == "SUCCEEDED"
    assert ended(run, "go_to")[0] == "RUNNING"
    assert run.way.told[-1] == "rest"


@pytest.mark.parametrize("why", ["place_asked", "late"])
def test_the_clock_of_a_task_stands_still_while_it_waits(why: str) -> None:
    run = Run()
    run.engine.start(Task("go_to", "Go to", run.act, Span(9.0, lambda: run.situation.worked)), 0.0)
    run.tick(1.0, 2.0)
    setattr(run.situation, why, True)
    run.tick(3.0, 20.0)
    setattr(run.situation, why, False)
    run.tick(21.0, 22.0)
    assert run.situation.worked == pytest.approx(3.0)


def test_a_card_that_is_read_while_it_asks_answers_nothing() -> None:
    run = Run()
    engine = run.engine
    engine.start(Task("deliver", "Delivery", run.act, Span(9.0, lambda: 0.0)), 0.0)
    run.situation.place_asked, run.situation.tag = True, "7F"
    run.tick(1.0)
    assert (run.act.heard, run.situation.tag) == ([], "")


def test_a_task_that_waits_for_its_computer_says_so() -> None:
    run = Run()
    run.situation.late = True
    assert ended(run, "go_to") == ("RUNNING", Code.TASK_LOOP_LATE.value)
    assert run.engine.status.phase == "waiting"
    assert ended(run, "surface")[0] == "SUCCEEDED"
