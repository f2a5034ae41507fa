"""Satellites and the compass, as far as they say where the robot is."""

from __future__ import annotations

import math

import pytest
from msgspec.structs import replace

from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus
from bridge.msgs.std_msgs import Header, Time
from robotside.core.pose2 import Pose2
from robotside.localisation.beacons import (
    FIX_SPREAD,
    FIXES_CONTRADICT,
    MAX_AGAINST_COMPASS,
    MAX_AGAINST_FIX,
    MIN_FIX_SPREAD,
    Beacons,
    variance_of,
)
from tests.fakes import FakeRobot

HERE = Pose2(0.0, 0.0, 0.5)


def beacons(now: float = 10.0, north: float = 0.0, variance: float = 0.25) -> Beacons:
    """Five fixes `north` [m] of the origin, and a compass that says 0.5 rad."""
    made = Beacons(replace(FakeRobot().info, latitude=45.0, longitude=-73.0))
    for _ in range(5):
        said = [variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, 1.0]
        latitude = 45.0 + north / 111_132.0
        made.on_fix(NavSatFix(Header(Time.at(now)), NavSatStatus(), latitude, -73.0, 0.0, said, 2))
    made.on_compass(0.5, now)
    return made


def test_a_guess_needs_enough_fixes_and_a_compass() -> None:
    assert beacons().guess == pytest.approx(HERE, abs=0.01)
    without = beacons()
    without.on_compass(math.nan, 10.0)
    assert without.guess is None
    assert Beacons(FakeRobot().info).guess is None


def test_places_are_the_less_likely_the_farther_they_are_off_and_old_fixes_say_nothing() -> None:
    said = beacons()
    assert said.log_likelihood(HERE, 11.0) == pytest.approx(0.0, abs=0.01)
    assert said.log_likelihood(Pose2(1.0, 0.0, 0.5), 11.0) == pytest.approx(-2.0, abs=0.05)
    assert said.log_likelihood(Pose2(99.0, 0.0, 0.5), 11.0) == -MAX_AGAINST_FIX
    turned = Pose2(0.0, 0.0, 0.5 + math.pi)
    assert said.log_likelihood(turned, 11.0) == pytest.approx(-MAX_AGAINST_COMPASS, abs=0.01)
    assert said.log_likelihood(Pose2(99.0, 0.0, 2.0), 14.0) == 0.0


def test_a_place_three_deviations_off_is_contradicted_and_one_that_is_known_badly_is_not() -> None:
    said = beacons(north=2.0)
    assert said.contradicts(HERE, 0.0, 11.0)
    assert not said.contradicts(HERE, 1.0, 11.0)
    assert not said.contradicts(HERE, 0.0, 20.0)
    assert not beacons(north=1.4).contradicts(HERE, 0.0, 11.0)


def test_many_looks_in_a_row_that_are_contradicted_are_told_once() -> None:
    said = beacons(north=2.0)
    looks = [said.contradict(HERE, 0.0, 10.0) for _ in range(2 * FIXES_CONTRADICT)]
    assert [n for n, told in enumerate(looks) if told] == [FIXES_CONTRADICT - 1]
    said.elsewhere()
    looks = [said.contradict(HERE, 1.0 if n == 5 else 0.0, 10.0) for n in range(2 * FIXES_CONTRADICT)]
    assert [n for n, told in enumerate(looks) if told] == [5 + FIXES_CONTRADICT]


def test_a_fix_that_is_none_is_not_remembered() -> None:
    made = Beacons(replace(FakeRobot().info, latitude=45.0, longitude=-73.0))
    assert made.on_fix(NavSatFix(Header(Time.at(1.0)), NavSatStatus(-1), 45.0, -73.0)) is None
    assert made.on_fix(NavSatFix(Header(Time.at(1.0)), NavSatStatus(), math.nan, -73.0)) is None


@pytest.mark.parametrize(
    ("said", "kind", "variance"),
    [
        (4.0, 2, 4.0),
        (4.0, 0, FIX_SPREAD**2),
        (math.nan, 2, FIX_SPREAD**2),
        (0.0, 2, FIX_SPREAD**2),
        (1e-9, 2, MIN_FIX_SPREAD**2),
    ],
)
def test_a_fix_counts_as_it_says_of_itself_and_none_is_perfect(
    said: float, kind: int, variance: float
) -> None:
    along = [said, 0.0, 0.0, 0.0, said, 0.0, 0.0, 0.0, 1.0]
    fix = NavSatFix(Header(Time.at(1.0)), NavSatStatus(), 45.0, -73.0, 0.0, along, kind)
    assert variance_of(fix) == variance
