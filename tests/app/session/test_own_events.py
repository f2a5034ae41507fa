"""What is said of this handheld and what of another of the same name."""

from __future__ import annotations

import math

import pytest

from app.core.command_origin import Origin, gave_stop
from app.session.own_events import OwnName
from bridge.msgs.pilothouse_msgs import ControlStatus, Event, TaskStatus
from bridge.msgs.std_msgs import Time

CLOCK = 5000.0
"""The operators' [s]."""


@pytest.fixture
def name() -> OwnName:
    return OwnName("t1", "vm", lambda: 100.0)


def told(text: str, kind: str = "control", at: float = CLOCK) -> Event:
    return Event(id=1, kind=kind, text=text, stamp=Time.at(at))


def said(name: OwnName, text: str, **words: object) -> str:
    return name.said(told(text), CLOCK, **words).text  # type: ignore[arg-type]


def test_nothing_is_said_to_you_before_the_robot_has_named_you(name: OwnName) -> None:
    assert name.undecided(told("vm has control."), CLOCK)
    assert said(name, "vm has control.") == "vm has control."


@pytest.mark.parametrize(("mine", "other"), [("vm", "vm (2)"), ("vm (2)", "vm")])
def test_of_two_of_one_name_each_is_told_what_is_about_itself(name: OwnName, mine: str, other: str) -> None:
    name.hear(ControlStatus(driver=other, driver_id="t2"))
    assert name.known == ""
    name.hear(ControlStatus(driver=mine, driver_id="t1"))
    assert said(name, f"{mine} has control.") == "You have control."
    assert said(name, f"{other} has control.") == f"{other} has control."
    assert said(name, f"STOP pressed by {mine}.") == "You pressed STOP."
    assert said(name, f"Stopped by {mine}.") == "STOP paused the task."
    assert said(name, f"Paused by {mine}.") == "You paused."
    assert said(name, f"Paused by {other}.") == f"Paused by {other}."
    assert said(name, f"Discarded by {mine}.") == "You discarded it."
    assert said(name, f"Canceled by {mine}.") == "You canceled it."
    assert said(name, f"Canceled by {other}.") == f"Canceled by {other}."
    assert said(name, f"STOP released by {other}.") == f"STOP released by {other}."


def test_who_asks_is_named_as_well(name: OwnName) -> None:
    name.hear(ControlStatus(driver="vm", driver_id="t2", requested_by="vm (2)", requested_by_id="t1"))
    assert name.known == "vm (2)"


def test_who_has_just_pressed_stop_without_control_is_told_so(name: OwnName) -> None:
    assert said(name, "STOP pressed by vm (2).", asked=True) == "You pressed STOP."
    assert said(name, "STOP pressed by Anna.", asked=True) == "STOP pressed by Anna."


def test_a_stop_that_was_guessed_says_what_gave_it_and_its_task_is_no_second_alarm(name: OwnName) -> None:
    name.hear(ControlStatus(driver="vm (2)", driver_id="t1"))
    how = gave_stop(Origin("voice", 0.99, said="the bus will stop"))
    assert how == "Your voice gave STOP: “the bus will stop”, 99 % sure."
    assert said(name, "STOP pressed by vm (2).", how=how) == how
    assert said(name, "STOP pressed by vm.", how=how) == "STOP pressed by vm."
    alarm = Event(id=2, kind="task", level="alarm", text="Stopped by vm (2).", stamp=Time.at(CLOCK))
    told_here = name.said(alarm, CLOCK, how=how)
    assert (told_here.text, told_here.level) == ("STOP paused the task.", "info")
    assert gave_stop(Origin("shake", said="left-right")) == "A shake gave STOP: “left-right”."
    assert gave_stop(Origin("button")) == "", "a finger knows what it did"


def test_why_the_task_is_paused_is_told_of_you_as_well(name: OwnName) -> None:
    paused = TaskStatus(state="PAUSED", reason="Paused by vm (2).", stamp=Time.at(CLOCK))
    stopped = TaskStatus(state="PAUSED", reason="Stopped by vm (2).", stamp=Time.at(CLOCK))
    assert name.task(paused, CLOCK) is paused, "not known yet"
    name.hear(ControlStatus(driver="vm (2)", driver_id="t1"))
    assert name.task(paused, CLOCK).reason == "You paused."
    assert name.task(stopped, CLOCK).reason == "You pressed STOP."
    name.hear(ControlStatus(driver="vm", driver_id="t1"))
    assert name.task(paused, CLOCK) is paused, "that is another"


def test_what_was_before_this_handheld_came_is_not_about_it(name: OwnName) -> None:
    name.hear(ControlStatus(driver="vm", driver_id="t1"))
    old = told("vm has control.", at=CLOCK - 60.0)
    assert name.said(old, CLOCK).text == "vm has control."
    assert name.said(old, math.nan).text == "You have control.", "with no clock the name alone tells"


def test_a_handheld_without_a_name_is_never_meant() -> None:
    assert not OwnName("t1", "", lambda: 0.0).undecided(told(" has control."), CLOCK)
