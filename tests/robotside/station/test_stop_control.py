"""STOP of one robot alone: what a press, a release, a restart and an orderly end do to port, task and disk."""

from __future__ import annotations

import math
from typing import Any

from bridge.core.codes import Code
from bridge.msgs import Msg
from robotside.control.command_gate import CommandGate
from robotside.control.guarded_robot import GuardedRobot
from robotside.control.stop_release import NOT_HELD, RELEASE_PAUSE
from robotside.core.notice import Notice
from robotside.motion.measured import MeasuredState
from robotside.records import Records
from robotside.records.database.rows import empty
from robotside.station.stop_control import StopControl
from tests.fakes import FakeRobot

NOW = 100.0


class Port(FakeRobot):
    """A robot with a STOP of its own and something that moves on it."""

    def __init__(self) -> None:
        super().__init__()
        self.pressed, self.fails = False, False

    def stop(self) -> None:
        if self.fails:
            raise OSError("gone")
        super().stop()

    def press_stop(self) -> None:
        self.pressed = True

    def release_stop(self) -> None:
        self.pressed = False

    def command(self, payload: str, order: Msg) -> None:
        """It takes orders."""

    def hold_payloads(self) -> None:
        """It holds still."""


class Tasks:
    """What was paused, and why."""

    def __init__(self) -> None:
        self.paused: list[str] = []

    def pause(self, reason: Notice, level: str = "info") -> None:
        self.paused.append(reason.code)


class Tested:
    """That STOP was tried is noted."""

    def stop_pressed(self) -> None:
        """Noted."""


class Stopped:
    """The STOP of one start of a robot side, on what is kept from one start to the next."""

    def __init__(self, kept: Any = None) -> None:
        self.kept = empty() if kept is None else kept
        self.port, self.tasks, self.gate = Port(), Tasks(), CommandGate()
        self.codes: list[str] = []
        tasks: Any = self.tasks
        readiness: Any = Tested()
        self.stop = StopControl(
            self.port.info,
            self.gate,
            GuardedRobot(self.port, lambda: self.gate.stopped),
            tasks,
            Records.in_memory(self.kept),
            readiness,
            say=lambda _, said, *__, **___: self.codes.append(said.code),
            clock=lambda: NOW,
            measured=MeasuredState,
            is_at_rest=lambda: False,
        )
        self.stop.recover()

    def again(self) -> Stopped:
        """After a restart of the robot's computer."""
        return Stopped(self.kept)


def test_a_press_brakes_latches_presses_the_robots_own_and_holds_the_task() -> None:
    robot = Stopped()
    robot.stop.press("Anna", "a")
    assert (robot.port.commands, robot.port.pressed) == ([None], True)
    assert (robot.gate.stopped, robot.gate.stopped_by) == (True, "Anna")
    assert robot.tasks.paused == [Code.TASK_STOPPED]
    assert robot.codes == [Code.STOP_PRESSED]


def test_a_press_is_given_now_at_the_latest() -> None:
    for given in (math.inf, NOW + 5.0):
        robot = Stopped()
        robot.stop.press("Anna", given=given)
        assert robot.gate.stop_given == NOW


def test_a_port_that_fails_keeps_neither_latch_nor_task_from_being_stopped_and_is_doubted() -> None:
    robot = Stopped()
    robot.port.fails = True
    robot.stop.press("Anna")
    assert robot.gate.stopped
    assert robot.tasks.paused == [Code.TASK_STOPPED]
    assert robot.stop.doubt == "The robot's port failed: OSError('gone')."
    robot.port.fails = False
    robot.stop.press("Anna")
    assert robot.stop.doubt == ""


def test_a_release_frees_latch_and_port_and_the_next_hold_takes_a_pause() -> None:
    robot = Stopped()
    robot.stop.press("Anna")
    assert robot.stop.holds.hold("anna", NOW, NOW) == ""
    robot.stop.release("Anna")
    assert (robot.gate.stopped, robot.port.pressed) == (False, False)
    assert robot.stop.holds.objection("anna", -math.inf, NOW + 1.5) is NOT_HELD
    assert "lately" in robot.stop.holds.hold("anna", NOW, NOW + RELEASE_PAUSE - 0.1)


def test_what_was_pressed_is_pressed_after_a_restart_here_and_at_the_robot() -> None:
    before = Stopped()
    before.stop.press("Anna")
    again = before.again()
    assert (again.gate.stopped_by, again.port.pressed) == ("Anna", True)
    assert again.codes == [Code.STOP_STILL_PRESSED]
    again.stop.release("Anna")
    again.stop.note()
    assert not again.again().gate.stopped


def test_an_orderly_end_rests_the_robot_and_is_no_stop_after_the_restart() -> None:
    robot = Stopped()
    robot.stop.end("the robot side")
    robot.stop.note()
    assert (robot.port.commands, robot.port.pressed) == ([None], False)
    assert robot.gate.stopped
    assert not robot.again().gate.stopped


def test_what_a_person_pressed_before_or_during_the_end_outlives_it() -> None:
    before, during = Stopped(), Stopped()
    before.stop.press("Anna")
    before.stop.end("the robot side")
    during.stop.end("the robot side")
    during.stop.press("Bert")
    assert [each.again().gate.stopped_by for each in (before, during)] == ["Anna", "Bert"]
