from __future__ import annotations

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.controls.goals.goal_status import GoalStatus


def run(number, state="RUNNING", task="go_to", phase=""):
    return TaskStatus(task_id=number, task=task, state=state, phase=phase)


@pytest.fixture
def goal():
    return GoalStatus()


def test_the_run_that_begins_after_the_goal_was_sent_is_for_it(goal):
    assert goal.on_status(run(3)) is None
    goal.on_sent()
    assert goal.on_status(run(3)) is None, "it went before"
    assert goal.on_status(run(4)) == "accepted"
    assert goal.run == 4


@pytest.mark.parametrize(
    ("state", "outcome"),
    [("PAUSED", "paused"), ("SUCCEEDED", "there"), ("CANCELED", "canceled"), ("FAILED", "failed")],
)
def test_its_run_tells_how_the_goal_stands(goal, state, outcome):
    goal.on_sent()
    goal.on_status(run(1))
    assert goal.on_status(run(1, state)) == outcome


def test_a_robot_that_is_unsure_of_its_place_is_not_there(goal):
    goal.on_sent()
    goal.on_status(run(1))
    ended = TaskStatus(task_id=1, task="go_to", state="FAILED", code=Code.TASK_PLACE_UNSURE.value)
    assert goal.on_status(ended) == "unsure"


def test_a_run_that_waits_does_not_go(goal):
    goal.on_sent()
    assert goal.on_status(run(1, phase="waiting")) == "waiting"


def test_another_task_is_not_for_the_goal_and_ends_it(goal):
    goal.on_sent()
    assert goal.on_status(run(1, task="patrol")) is None
    goal.on_status(run(2))
    assert goal.on_status(run(3, task="patrol")) == ""
    assert goal.run == 0


def test_only_a_run_that_goes_to_a_goal_is_adopted(goal):
    assert not goal.is_reported
    assert not goal.adopt()
    goal.on_status(run(5, task="patrol"))
    assert not goal.adopt()
    goal.on_status(run(6))
    assert (goal.going, goal.adopt(), goal.run) == (6, True, 6)


def test_a_goal_that_was_refused_has_no_run(goal):
    goal.on_sent()
    goal.forget()
    assert goal.on_status(run(1)) is None
    assert goal.run == 0
