"""A method that is on and does not work is said once, over whatever is on the glass, and no longer than it lasts."""

from __future__ import annotations

from typing import Any

import pytest

from app.inputs.input_problems import CALM_TIME, MethodProblems


class Glass:
    """A screen, or the list of robots."""

    def __init__(self) -> None:
        self.said: list[str] = []
        self.shown = ""

    def say(self, text: str, level: str, about: str = "", stay: float = 0.0) -> None:
        self.said.append(text)
        self.shown = text

    def unsay(self, what: str) -> None:
        assert what in ("methods", self.shown)
        self.shown = ""


class Method:
    problem = ""


class Desk:
    """All that they ask the app for."""

    def __init__(self) -> None:
        self.time = 100.0
        self.connect, self.shell = Glass(), Glass()
        self.all = {"shake": Method(), "voice": Method()}
        self.on = ["shake", "voice"]
        self.methods: Any = self
        self.problems = MethodProblems(self)

    @property
    def armed(self) -> list[str]:
        return self.on

    def get(self, name: str) -> Method:
        return self.all[name]

    def wait(self, seconds: float = 0.5) -> None:
        for _ in range(round(seconds / 0.03)):
            self.time += 0.03
            self.problems.update(self.time)

    def ails(self, name: str, problem: str) -> None:
        self.all[name].problem = problem
        self.wait()


@pytest.fixture
def desk() -> Desk:
    return Desk()


@pytest.mark.parametrize("where", ["shell", "connect"])
def test_it_is_said_once_when_it_begins_and_unsaid_when_it_ends(desk: Desk, where: str) -> None:
    if where == "connect":
        desk.shell = None
    glass = getattr(desk, where)
    desk.wait()
    assert glass.said == []
    desk.ails("shake", "The motion sensor is silent.")
    desk.wait(20.0)
    assert glass.said == ["Shake: The motion sensor is silent."]
    desk.ails("shake", "")
    desk.wait(CALM_TIME)
    assert glass.shown == ""
    desk.ails("shake", "The motion sensor is silent.")
    assert len(glass.said) == 2


def test_one_that_comes_and_goes_in_a_moment_is_the_same_one(desk: Desk) -> None:
    for rate in (24, 25, 24):
        desk.ails("shake", f"The motion sensor delivers {rate} Hz.")
        desk.ails("shake", "")
    assert desk.shell.said == ["Shake: The motion sensor delivers 24 Hz."]


def test_one_that_is_off_is_not_told_of(desk: Desk) -> None:
    desk.on = ["voice"]
    desk.ails("shake", "The motion sensor is silent.")
    assert desk.shell.said == []


def test_several_that_begin_at_once_are_one_sentence_each(desk: Desk) -> None:
    desk.all["voice"].problem = "There is no microphone."
    desk.ails("shake", "This device has no motion sensor.")
    assert desk.shell.said == ["Shake: This device has no motion sensor. Voice: There is no microphone."]


def test_who_goes_to_a_robot_is_told_there_as_well(desk: Desk) -> None:
    shell, desk.shell = desk.shell, None
    desk.ails("voice", "There is no microphone.")
    desk.shell = shell
    desk.wait()
    assert (len(desk.connect.said), len(shell.said)) == (1, 1)
