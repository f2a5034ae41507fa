"""STOP is released by a hold of a second by one operator, counted by the robot, and not again at once."""

from __future__ import annotations

import math

import pytest

from robotside.control.stop_release import (
    MAX_HOLD_TIME,
    MAX_HOLDS,
    MIN_HOLD_TIME,
    NOT_HELD,
    PRESSED_SINCE,
    RELEASE_PAUSE,
    StopRelease,
)


@pytest.fixture
def holds() -> StopRelease:
    return StopRelease()


@pytest.mark.parametrize(
    ("after", "may"),
    [(0.0, False), (MIN_HOLD_TIME - 0.01, False), (MIN_HOLD_TIME, True), (MAX_HOLD_TIME, True)],
)
def test_a_hold_counts_between_one_second_and_five(holds: StopRelease, after: float, may: bool) -> None:
    assert holds.hold("anna", 10.0, 10.0) == ""
    assert (holds.objection("anna", 9.0, 10.0 + after) == "") is may


def test_a_hold_that_is_over_stays_over(holds: StopRelease) -> None:
    holds.hold("anna", 10.0, 10.0)
    assert holds.objection("anna", 9.0, 10.01 + MAX_HOLD_TIME) == NOT_HELD
    assert holds.objection("anna", 9.0, 12.0) == NOT_HELD


def test_a_clock_that_was_set_back_lengthens_no_hold(holds: StopRelease) -> None:
    holds.hold("anna", 10.0, 10.0)
    assert holds.objection("anna", -math.inf, 9.0) == NOT_HELD


def test_a_hold_that_begins_anew_counts_anew(holds: StopRelease) -> None:
    holds.hold("anna", 10.0, 10.0)
    holds.hold("anna", 10.9, 10.9)
    assert holds.objection("anna", 9.0, 11.5) != ""
    assert holds.objection("anna", 9.0, 12.0) == ""


def test_another_ones_hold_is_none(holds: StopRelease) -> None:
    holds.hold("anna", 10.0, 10.0)
    assert holds.objection("bert", 9.0, 11.5) == NOT_HELD


def test_a_stop_that_was_given_after_the_hold_began_stays(holds: StopRelease) -> None:
    holds.hold("anna", 10.0, 10.1)
    assert holds.objection("anna", 10.01, 11.5) == PRESSED_SINCE
    assert holds.objection("anna", 10.0, 11.5) == "", "one that is sent again was given before"


def test_a_hold_from_the_future_is_of_now(holds: StopRelease) -> None:
    holds.hold("anna", 99.0, 10.0)
    assert holds.objection("anna", 10.5, 11.5) == PRESSED_SINCE


def test_a_release_ends_every_hold_and_the_next_begins_a_pause_later(holds: StopRelease) -> None:
    holds.hold("anna", 10.0, 10.0), holds.hold("bert", 10.0, 10.0)
    holds.on_released(11.5)
    assert holds.objection("bert", 9.0, 11.6) == NOT_HELD
    said = holds.hold("anna", 12.0, 12.0)
    assert said == "STOP was released lately; hold Release again in 2.5 s."
    assert holds.objection("anna", 9.0, 14.0) == NOT_HELD
    assert holds.hold("anna", 14.5, 11.5 + RELEASE_PAUSE) == ""


def test_holds_of_many_push_out_the_oldest(holds: StopRelease) -> None:
    for number in range(MAX_HOLDS + 1):
        holds.hold(str(number), 10.0, 10.0)
    assert holds.objection("0", 9.0, 11.5) == NOT_HELD
    assert holds.objection("1", 9.0, 11.5) == ""


def test_a_hold_lasts_by_the_robots_time_however_long_ago_it_is_said_to_have_begun(
    holds: StopRelease,
) -> None:
    assert holds.hold("anna", 8.0, 10.0) == ""
    assert "longer" in holds.objection("anna", 7.0, 9.9 + MIN_HOLD_TIME)
    assert holds.objection("anna", 7.0, 10.0 + MIN_HOLD_TIME) == ""
