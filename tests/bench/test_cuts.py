"""A cut link is judged by what the robot's port was told."""

from __future__ import annotations

import math

import pytest

from bench.support.cuts import CODE, Cut, judge
from bench.support.many_cuts import moved_again

GIVEN = {1: 10.0, 2: 10.05}


def judged(*told: tuple[object, ...]) -> Cut:
    return judge(told, GIVEN, hard=True)


def drive(at: float, number: int, speed: float = 0.7) -> tuple[object, ...]:
    return "drive", at, speed, number * CODE


def test_zero_counts_from_when_the_last_command_was_given() -> None:
    found = judged(drive(10.01, 1), drive(10.07, 2), ("stop", 10.3))
    assert found.zero == pytest.approx(0.25)
    assert not found.missed


def test_a_robot_that_was_never_driven_has_not_obeyed() -> None:
    assert not judged().obeyed
    assert not judged(("stop", 10.0)).obeyed
    assert judged(drive(10.07, 2), ("stop", 10.3)).obeyed


def test_a_twist_that_only_turns_is_rest() -> None:
    assert judged(drive(10.07, 2), drive(10.3, 2, 0.0)).zero == pytest.approx(0.25)


def test_a_robot_that_is_not_told_to_rest_is_a_miss() -> None:
    found = judged(drive(10.07, 2))
    assert found.zero == math.inf == found.rest
    assert found.missed


def test_what_moves_it_and_was_given_after_the_cut_is_counted() -> None:
    told = drive(10.01, 1), ("stop", 10.3), drive(11.0, 2), ("stop", 11.2)
    assert judge(told, GIVEN, hard=False, severed=10.02).old == 1
    assert judge(told, GIVEN, hard=False, severed=10.1).old == 0


def test_one_that_is_told_to_rest_too_late_is_a_miss() -> None:
    assert judged(drive(10.07, 2), ("stop", 10.36)).missed


def test_an_old_command_that_comes_after_it_stood_is_a_miss() -> None:
    assert judged(drive(10.01, 1), ("stop", 10.25), drive(10.9, 2), ("stop", 10.91)).missed


def test_rest_and_way_are_by_its_odometry_after_the_last_command() -> None:
    speeds = [("speed", 9.9, 0.7), ("speed", 10.1, 0.5), ("speed", 10.3, 0.5), ("speed", 10.4, 0.0)]
    found = judged(drive(10.07, 2), ("stop", 10.3), *speeds)
    assert found.rest == pytest.approx(0.1)
    assert found.way == pytest.approx(0.5 * 0.3)


def test_motion_after_the_rest_that_follows_a_cut_is_late_and_no_other() -> None:
    before = [drive(9.5, 1), ("stop", 9.7), drive(9.9, 1), drive(10.1, 1)]
    assert moved_again([*before, ("stop", 10.3)], severed=10.0) == 0
    assert moved_again([*before, drive(10.3, 2, 0.0), drive(10.4, 2), drive(10.5, 3)], severed=10.0) == 2
