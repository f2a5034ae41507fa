"""What a robot does when the hands that drove it let go, are lost or have to yield: `Teleop` alone, in virtual time."""

from __future__ import annotations

import math
from typing import Any

import msgspec

from bridge.core.codes import Code
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.msgs.geometry_msgs import Twist, Vector3
from robotside.control.command_expiry import HOLD_TIME
from robotside.control.command_gate import CommandGate
from robotside.control.guarded_robot import GuardedRobot
from robotside.control.neutral_interlock import LET_GO_SENTENCE
from robotside.control.safe_state import SafeState
from robotside.control.teleop import LOST_LINK_STOPS_TASK, Options, Teleop
from robotside.core.config import ControlSettings, SafeStateSettings
from robotside.core.notice import Notice
from robotside.motion.measured import MeasuredState
from tests.fakes import FakeClient, FakeRobot

AHEAD = Twist.planar(0.3, 0.0)
RISE = Twist(Vector3(0.0, 0.0, 0.2), Vector3())


class Tasks:
    """What is running, and why it was paused."""

    def __init__(self) -> None:
        self.running = False
        self.paused: list[str] = []

    def pause(self, reason: Notice, level: str = "info") -> None:
        if self.running:
            self.running = False
            self.paused.append(reason.code)


class Driven:
    """A robot of a kind, with anna at its controls and bert beside her."""

    def __init__(self, kind: str = "wheels", **measured: Any) -> None:
        self.now, self.kept = 10.0, {}
        self.measured = MeasuredState(**measured)
        self.robot, self.tasks = FakeRobot(), Tasks()
        self.robot.info = msgspec.structs.replace(self.robot.info, kind=kind)
        self.gate = CommandGate(self.robot.info)
        self.anna, self.bert = FakeClient("anna", self.now), FakeClient("bert", self.now)
        self.codes: list[str] = []
        self.teleop = Teleop(
            self.gate,
            GuardedRobot(self.robot, lambda: self.gate.stopped),
            self.tasks,
            SafeState(kind, SafeStateSettings()),
            Options(ControlSettings(), lambda name: self.kept.get(name, ""), lambda *_: None),
            say=lambda _, said, *__, **___: self.codes.append(said.code),
            clock=lambda: self.now,
            measured=lambda: self.measured,
            go_home=lambda: False,
        )

    def push(self, twist: Twist = AHEAD, after: float = 0.05) -> str:
        self.now += after
        return self.teleop.drive(self.anna, twist, None)

    def step(self, after: float = 0.05) -> None:
        self.now += after
        self.teleop.step(self.now)

    def did(self) -> list[Twist | None]:
        """What the robot was told since the last look."""
        done = list(self.robot.commands)
        self.robot.commands.clear()
        return done


def test_the_robot_brakes_when_no_command_follows() -> None:
    driven = Driven()
    driven.push()
    driven.step(HOLD_TIME + 0.01)
    assert driven.did() == [AHEAD, None]


def test_the_robot_brakes_in_the_step_in_which_its_driver_is_gone() -> None:
    driven = Driven()
    driven.push()
    driven.teleop.on_gone(driven.anna, driven.now)
    assert driven.did() == [AHEAD, None]


def test_the_robot_brakes_in_the_step_in_which_control_is_handed_over() -> None:
    driven = Driven()
    driven.push()
    driven.teleop.request(driven.bert)
    driven.teleop.grant(driven.anna, driven.now)
    assert driven.did() == [AHEAD, None]


def test_a_robot_that_was_put_back_is_in_no_safe_state_any_more() -> None:
    driven = Driven("quadrotor", height=2.0)
    driven.teleop.rest(driven.now)
    driven.step()
    assert None not in driven.did(), "it hovers"
    driven.teleop.put_back()
    driven.step()
    assert driven.did() == []


def test_a_stick_that_was_held_while_the_robot_was_put_back_is_heard_at_zero_first() -> None:
    driven = Driven()
    driven.push()
    driven.teleop.put_back()
    assert driven.push() == LET_GO_SENTENCE
    driven.push(Twist())
    assert driven.push() == ""


def test_a_kind_that_only_brakes_stays_as_it_is_when_a_driver_is_lost_who_did_not_drive() -> None:
    """It stands already; what moves it is not from here, as where a robot behind has a driver of its own."""
    driven = Driven()
    driven.gate.acquire(driven.anna, driven.now)
    driven.step(CONTROL_TIMEOUT + 0.1)
    driven.step()
    assert driven.codes == [Code.CONTROL_LAPSED]
    assert driven.did() == []


def test_a_kind_that_does_more_than_brake_takes_its_safe_state_when_its_driver_is_lost() -> None:
    driven = Driven("quadrotor", height=2.0)
    driven.gate.acquire(driven.anna, driven.now)
    driven.step(CONTROL_TIMEOUT + 0.1)
    assert driven.did() == [Twist()], "it hovers"


def test_who_drives_ends_the_safe_state() -> None:
    driven = Driven("quadrotor", height=2.0)
    driven.teleop.rest(driven.now)
    driven.did()
    driven.push()
    driven.step()
    assert driven.did() == [AHEAD]


def test_the_safe_state_yields_to_stop() -> None:
    driven = Driven("quadrotor", height=2.0)
    driven.teleop.rest(driven.now)
    driven.gate.stop("Bert")
    driven.did()
    driven.step()
    assert driven.did() == [], "STOP has braked it, and nothing else is told to the port"


def test_a_task_is_paused_by_the_stick_and_by_turning_over() -> None:
    driven = Driven()
    driven.tasks.running = True
    driven.push()
    driven.tasks.running, driven.measured = True, MeasuredState(roll=math.pi)
    driven.step()
    assert driven.tasks.paused == [Code.TASK_TAKEN_OVER, Code.TASK_OVERTURNED]


def test_a_task_goes_on_without_the_handheld_unless_it_was_told_to_stop() -> None:
    for stops, paused in (("off", []), ("on", [Code.TASK_LINK_LOST])):
        driven = Driven()
        driven.kept[LOST_LINK_STOPS_TASK] = stops
        driven.gate.acquire(driven.anna, driven.now)
        driven.tasks.running = True
        driven.step(CONTROL_TIMEOUT + 0.1)
        assert driven.tasks.paused == paused


def test_a_stick_starts_no_rotors() -> None:
    driven = Driven("quadrotor", height=0.1, landed=True)
    said = driven.push(RISE)
    assert isinstance(said, Notice)
    assert said.code == Code.DRIVE_ON_GROUND
    assert driven.did() == []


def test_a_stick_does_not_push_on_what_is_in_touch() -> None:
    driven = Driven(touched=0.0)
    driven.push()
    assert driven.robot.at_rest
    assert driven.codes == [Code.DRIVE_TOUCHES]
    driven.push(Twist.planar(-0.3, 0.0))
    assert driven.did()[-1] == Twist.planar(-0.3, 0.0)


def test_a_robot_that_cannot_be_reached_is_not_driven() -> None:
    driven = Driven()
    driven.robot.trouble = "The robot cannot be reached: no answer."
    assert driven.push() == driven.robot.trouble
    assert driven.did() == []
    driven.robot.trouble = ""
    assert driven.push() == LET_GO_SENTENCE
