"""The engine and one behaviour that a test steers: what a pause, an answer and an end do, without a robot."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskStatus
from robotside.core.notice import Notice
from robotside.core.pose2 import ORIGIN
from robotside.tasks.behaviours.course import Span
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.engine import Engine, Task

WHY = Notice(Code.TASK_TAKEN_OVER, "Paused: Anna took the stick.")


class Way:
    """A navigator that notes what it is told."""

    reason = ""
    remaining = 0.0

    def __init__(self) -> None:
        self.told: list[str] = []

    def rest(self) -> None:
        self.told.append("rest")

    def finish(self) -> None:
        self.told.append("finish")

    def keep_height(self, height: float) -> None:
        """Of no use here."""


class Act(Behaviour):
    """Asks until it is told how it ends, and notes the answers that it hears."""

    def __init__(self, situation: Situation) -> None:
        super().__init__("act")
        self._situation = situation
        self.outcome = Status.RUNNING
        self.heard: list[str] = []
        self.ended: Status | None = None

    def update(self) -> Status:
        self.heard.append(self._situation.confirmed_by)
        self._situation.report("waiting", "Waiting for an answer.", asks="Go on?")
        return self.outcome

    def terminate(self, new_status: Status) -> None:
        self.ended = new_status


class Run:
    """An engine with that behaviour as its task, begun at 0 s."""

    def __init__(self) -> None:
        self.situation, self.way = Situation(), Way()
        self.act = Act(self.situation)
        way: Any = self.way
        self.engine = Engine(
            way,
            self.situation,
            show=lambda _: None,
            progress=lambda _: None,
            say=lambda *_, **__: None,
            clock=lambda: 0.0,
            cruise=0.5,
        )
        self.begin()

    def begin(self) -> None:
        span = Span(math.nan, lambda: self.situation.worked)
        self.engine.start(Task("hold", "Hold", self.act, span), 0.0)

    def tick(self, *moments: float) -> None:
        for now in moments:
            self.engine.tick(ORIGIN, np.empty((0, 2)), 0.0, now)


@pytest.fixture
def run() -> Run:
    return Run()


def test_the_clock_of_a_task_stands_still_in_a_pause(run: Run) -> None:
    run.tick(1.0)
    run.engine.pause(WHY)
    run.tick(2.0, 5.0, 9.0)
    run.engine.resume()
    run.tick(10.0, 11.0)
    assert run.situation.worked == pytest.approx(2.0)


def test_a_paused_task_rests_and_its_behaviour_is_not_ticked(run: Run) -> None:
    run.tick(1.0)
    run.engine.pause(WHY)
    run.tick(2.0, 3.0)
    assert run.way.told == ["rest"]
    assert len(run.act.heard) == 1


def test_an_answer_is_heard_once(run: Run) -> None:
    run.tick(1.0)
    assert run.engine.confirm("Anna")
    run.tick(2.0, 3.0)
    assert run.act.heard == ["", "Anna", ""]


def test_an_answer_from_before_a_pause_is_none_afterwards(run: Run) -> None:
    run.tick(1.0)
    run.engine.confirm("Anna")
    run.engine.pause(WHY)
    run.engine.resume()
    run.tick(2.0)
    assert run.act.heard == ["", ""]


def test_only_a_task_that_runs_takes_an_answer(run: Run) -> None:
    assert not run.engine.confirm("Anna"), "it has asked nothing yet"
    run.tick(1.0)
    run.engine.pause(WHY)
    assert not run.engine.confirm("Anna")
    run.engine.cancel(WHY)
    run.engine.offer(TaskStatus(state="INTERRUPTED", reason="Cut.", asks="Go on?"))
    assert not run.engine.confirm("Anna")


@pytest.mark.parametrize(("outcome", "state"), [(Status.SUCCESS, "SUCCEEDED"), (Status.FAILURE, "FAILED")])
def test_a_task_that_comes_to_its_end_ends_its_way(run: Run, outcome: Status, state: str) -> None:
    run.act.outcome = outcome
    run.tick(1.0)
    assert run.way.told == ["finish"]
    assert (run.engine.status.state, run.engine.active) == (state, False)


@pytest.mark.parametrize(("end", "state"), [("cancel", "CANCELED"), ("fail", "FAILED")])
def test_a_task_that_is_ended_ends_its_way_and_its_behaviour(run: Run, end: str, state: str) -> None:
    run.tick(1.0)
    getattr(run.engine, end)(WHY)
    assert run.way.told == ["finish"]
    assert run.act.ended is Status.INVALID
    assert run.engine.status.state == state


def test_each_task_has_a_number_of_its_own(run: Run) -> None:
    first = run.engine.status.task_id
    run.begin()
    assert run.engine.status.task_id == first + 1
