"""Waiting before a way that is blocked by something that may go."""

from __future__ import annotations

import msgspec
import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.navigation.way_wait import BLOCKED_TIMEOUT
from tests.fakes import Box, FakeRobot

ROW = np.column_stack([np.zeros(121), np.arange(-6.0, 6.05, 0.1)])
"""Across the whole hall."""
GOAL = Goal("Point 2", 6.0, 0.0)
NOTHING = np.empty((0, 2))


class Leg:
    """A robot that is sent on while something stands across the hall."""

    def __init__(self, *boxes: Box, kind: str = "wheels", row: np.ndarray = ROW) -> None:
        self.robot = FakeRobot(start=(-6.0, 0.0, 0.0), boxes=boxes)
        self.robot.info = msgspec.structs.replace(self.robot.info, kind=kind, radius=0.25)
        self.navigator = Navigator(self.robot, Grid.from_msg(self.robot.map()), lambda _: None)
        self.row = row
        self.now = 0.0
        self.navigator.head_for(GOAL)

    def wait(self, seconds: float, *, seen: bool = True) -> LegState:
        end, leg = self.now + seconds, LegState.UNDER_WAY
        while self.now < end and leg is LegState.UNDER_WAY:
            if seen:
                self.navigator.obstacles.update(self.row, self.now)
            leg = self.navigator.update(Pose2(*self.robot.pose), NOTHING, self.now)
            self.now += 0.1
        return leg


def test_it_stands_and_says_where_the_way_is_blocked() -> None:
    leg = Leg()
    assert leg.wait(3.0) is LegState.UNDER_WAY
    assert leg.navigator.blocked.startswith("Way blocked")
    assert leg.navigator.blocked.endswith("waiting.")
    assert leg.robot.at_rest
    assert not leg.navigator.reason


def test_it_goes_on_by_itself_when_the_way_is_free() -> None:
    leg = Leg()
    leg.wait(3.0)
    leg.navigator.obstacles.forget()
    leg.wait(2.0, seen=False)
    assert leg.navigator.blocked == ""
    assert leg.navigator.controller.under_way


def test_while_nothing_goes_it_does_not_look_for_a_way_again_and_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    leg = Leg()
    leg.wait(3.0)
    asked: list[float] = []
    monkeypatch.setattr(leg.navigator, "_ask", asked.append)
    leg.wait(20.0)
    assert not asked


def test_after_the_stated_time_it_gives_up_with_a_sentence() -> None:
    leg = Leg()
    assert leg.wait(BLOCKED_TIMEOUT + 20.0) is LegState.BLOCKED
    assert BLOCKED_TIMEOUT < leg.now < BLOCKED_TIMEOUT + 10.0
    said = str(leg.navigator.reason)
    assert said.startswith("The way to Point 2 at (6.0, 0.0) is blocked")
    assert said.endswith(f"it did not become free within {BLOCKED_TIMEOUT:.0f} s.")


def test_what_was_waited_before_counts_when_the_way_is_blocked_again() -> None:
    leg = Leg()
    leg.wait(BLOCKED_TIMEOUT - 5.0)
    leg.navigator.obstacles.forget()
    leg.wait(1.0, seen=False)
    assert leg.navigator.controller.under_way
    leg.navigator.controller.forget()
    assert leg.wait(20.0) is LegState.BLOCKED


def test_walls_of_the_map_end_it_at_once() -> None:
    leg = Leg(Box(-0.2, -6.0, 0.2, 6.0))
    assert leg.wait(3.0) is LegState.BLOCKED
    assert leg.navigator.reason == "There is no way to Point 2 at (6.0, 0.0)."


def test_one_that_is_not_patient_does_not_wait() -> None:
    leg = Leg()
    leg.navigator.head_for(GOAL, patient=False)
    assert leg.wait(3.0) is LegState.BLOCKED
    assert leg.now < 5.0  # it looks for one, and does no more


def test_a_truck_waits_as_well() -> None:
    leg = Leg(kind="ackermann")
    leg.wait(45.0)
    assert leg.navigator.blocked.startswith("Way blocked")
    leg.navigator.obstacles.forget()
    leg.wait(2.0, seen=False)
    assert leg.navigator.controller.under_way
