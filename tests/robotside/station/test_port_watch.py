"""A robot that is lost and comes back: everything is held, and nothing moves until an operator says so."""

from __future__ import annotations

from typing import Any

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from robotside.control.command_gate import CommandGate
from robotside.control.neutral_interlock import LET_GO_SENTENCE
from robotside.core.notice import Notice
from robotside.station.port_watch import PortWatch
from tests.fakes import FakeClient

AHEAD = Twist.planar(0.3, 0.0)
LOST = Notice(Code.ROBOT_UNREACHABLE, "The robot cannot be reached: no answer.")


class Tasks:
    """Why the task was paused."""

    def __init__(self) -> None:
        self.paused: list[Notice] = []

    def pause(self, reason: Notice, level: str = "info") -> None:
        self.paused.append(reason)


class Watched:
    """A port that a test takes away, the controls before it, and what is told."""

    def __init__(self) -> None:
        self.trouble: Notice | str = ""
        self.gate, self.tasks, self.codes = CommandGate(), Tasks(), list[str]()
        tasks: Any = self.tasks
        self.watch = PortWatch(lambda: self.trouble, self.gate, tasks, self._say)

    def _say(self, kind: str, text: str, level: str = "info", **_: object) -> None:
        assert isinstance(text, Notice)
        self.codes.append(text.code)

    def goes(self, now: float) -> None:
        self.trouble = LOST
        self.watch.update(now)

    def comes_back(self, now: float) -> None:
        self.trouble = ""
        self.watch.update(now)


def test_the_stick_that_was_held_when_the_robot_went_is_heard_at_zero_before_it_drives() -> None:
    watched, anna = Watched(), FakeClient("anna", 10.0)
    assert watched.gate.drive(anna, AHEAD, 10.0).order == AHEAD
    watched.goes(10.05)
    assert not watched.gate.driving
    watched.comes_back(10.1)
    assert watched.gate.drive(anna, AHEAD, 10.15).said == LET_GO_SENTENCE
    watched.gate.drive(anna, Twist(), 10.2)
    assert watched.gate.drive(anna, AHEAD, 10.25).order == AHEAD


def test_its_task_is_held_with_the_reason() -> None:
    watched = Watched()
    watched.goes(10.0)
    (reason,) = watched.tasks.paused
    assert (reason.code, reason) == (
        Code.TASK_ROBOT_LOST,
        "Paused: the robot cannot be reached: no answer.",
    )


def test_loss_and_return_are_told_once_and_measurements_from_before_count_no_more() -> None:
    watched = Watched()
    watched.watch.update(9.0)
    watched.trouble = LOST
    assert watched.watch.is_news
    for now in (10.0, 10.1, 10.2):
        watched.watch.update(now)
    assert not watched.watch.is_news
    assert watched.watch.changed_at == 10.0
    watched.comes_back(11.0)
    watched.comes_back(11.1)
    assert watched.codes == [Code.ROBOT_UNREACHABLE, Code.ROBOT_BACK]
    assert watched.watch.changed_at == 11.0
