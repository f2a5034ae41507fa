"""A fault of the robot's own program: the task ends with the robot at rest."""

from __future__ import annotations

import logging
from typing import Any

import pytest

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.core.refusal import OrderRefused
from robotside.station.fault_guard import FAULT_PERIOD, FaultGuard


class Tasks:
    """Whether there is a task, and why it failed."""

    def __init__(self, *, active: bool) -> None:
        self.active = active
        self.failed: list[str] = []

    def fail(self, reason: Notice) -> None:
        self.failed.append(reason.code)


class Guarded:
    """A guard, what it did, and its clock."""

    def __init__(self, *, active: bool = True) -> None:
        self.now, self.braked = 10.0, 0
        self.tasks, self.codes = Tasks(active=active), list[str]()
        tasks: Any = self.tasks
        self.guard = FaultGuard(tasks, self._brake, self._say, lambda: self.now)

    def _brake(self) -> None:
        self.braked += 1

    def _say(self, kind: str, text: str, level: str = "info", **_: object) -> None:
        assert isinstance(text, Notice)
        self.codes.append(text.code)

    def fail(self) -> None:
        self.guard.run(self._think)

    @staticmethod
    def _think() -> None:
        raise ZeroDivisionError


def test_a_fault_brakes_the_robot_and_ends_its_task(caplog: pytest.LogCaptureFixture) -> None:
    guarded = Guarded()
    with caplog.at_level(logging.ERROR):
        guarded.fail()
    assert guarded.braked == 1
    assert guarded.tasks.failed == [Code.TASK_FAULT]
    assert guarded.codes == [Code.ROBOT_FAULT]
    assert "ZeroDivisionError" in caplog.text


def test_without_a_task_it_does_not_take_the_robot_from_who_drives() -> None:
    guarded = Guarded(active=False)
    guarded.fail()
    assert guarded.braked == 0


def test_a_fault_that_comes_in_each_step_is_told_now_and_then_and_brakes_each_time() -> None:
    guarded = Guarded()
    for _ in range(3):
        guarded.fail()
    assert (guarded.braked, len(guarded.codes)) == (3, 1)
    guarded.now += FAULT_PERIOD
    guarded.fail()
    assert len(guarded.codes) == 2


def test_an_order_that_the_robot_refuses_ends_the_task_at_rest_by_its_sentence_and_is_no_fault() -> None:
    guarded, refused = Guarded(), Notice(Code.HEIGHT_INVALID, "Too high.")

    def think() -> None:
        raise OrderRefused(refused)

    assert guarded.guard.run(think) is refused
    assert guarded.braked == 1
    assert guarded.tasks.failed == [Code.HEIGHT_INVALID]
    assert guarded.codes == []
    by_hand = Guarded(active=False)
    assert by_hand.guard.run(think) is refused
    assert by_hand.braked == 0
