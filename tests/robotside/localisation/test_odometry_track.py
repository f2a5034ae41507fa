"""Where the robot was when a sensor measured."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.localisation.odometry_track import OdometryTrack


def track(*, velocity: Pose2 = ORIGIN) -> OdometryTrack:
    """A robot that came a metre along x in a second, and went on with that velocity."""
    made = OdometryTrack()
    made.add(10.0, Pose2(0.0, 0.0, 0.0))
    made.add(11.0, Pose2(1.0, 0.0, math.pi / 2), velocity)
    return made


def test_a_sensor_measures_where_the_robot_was_between_two_odometries() -> None:
    assert track().at(10.5) == pytest.approx((0.5, 0.0, math.pi / 4))


def test_a_sensor_that_measures_after_the_last_odometry_is_carried_on() -> None:
    moving = track(velocity=Pose2(0.5, 0.1, 2.0))
    assert moving.at(11.02) == pytest.approx((1.0 - 0.002, 0.01, math.pi / 2 + 0.04), abs=1e-9)


def test_it_is_not_carried_on_for_long_nor_before_what_is_remembered() -> None:
    moving = track(velocity=Pose2(0.5, 0.0, 0.0))
    for stamp in (11.1, 60.0):
        assert moving.at(stamp) == pytest.approx((1.0, 0.05, math.pi / 2))
    assert moving.at(9.0) == (0.0, 0.0, 0.0)
    assert OdometryTrack().at(9.0) is None


def test_one_that_does_not_know_its_speed_is_where_it_was() -> None:
    for velocity in (Pose2(math.nan, 0.0, 0.0), Pose2(0.0, 0.0, math.inf)):
        assert track(velocity=velocity).at(11.05) == (1.0, 0.0, math.pi / 2)
