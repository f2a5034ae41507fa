"""The beginning at a place: by a sweep that tells enough, and by none that does not."""

from __future__ import annotations

import math

import pytest
from msgspec.structs import replace

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus
from bridge.msgs.std_msgs import Header, Time
from robotside.core.pose2 import Pose2
from tests.fakes import Box, FakeRobot, Pillar
from tests.robotside.localisation.ride import Ride

FIELD = Box(-40.0, -40.0, 40.0, 40.0)
"""So wide that its walls are out of the laser's reach."""


def in_the_open(x: float, y: float, yaw: float) -> FakeRobot:
    """Beside a pillar and a short wall that are on the map, and a cone that is not."""
    robot = FakeRobot(
        start=(x, y, yaw),
        hall=FIELD,
        boxes=[Box(-14.2, 4.8, -13.8, 5.2), Box(3.0, -1.0, 3.2, 1.0), Box(1.0, 6.0, 1.4, 6.4)],
        pillars=[Pillar(x + 3.0, y - 2.0, 0.2)],
        beams=120,
    )
    robot.info = replace(robot.info, latitude=47.0, longitude=8.0)
    return robot


@pytest.mark.parametrize("start", [(-8.0, 0.0, 0.0), (-11.0, 4.0, 1.0), (0.5, 3.5, -2.0), (-5.0, -6.0, 2.5)])
def test_by_a_handful_of_ends_no_place_is_taken_and_the_told_uncertainty_says_so(
    start: tuple[float, float, float],
) -> None:
    ride = Ride(in_the_open(*start), None)
    ride.run(6.0)
    assert ride.estimator.pose == Pose2(0.0, 0.0, 0.0)  # where it supposed to be
    assert ride.estimator.spread > ride.error / 3.0
    assert not ride.estimator.sure
    assert "position_unseen" in ride.codes
    assert "position_unsure" not in ride.codes  # no other place fits as well: none can be told
    ride.estimator.place(Pose2(*start))
    ride.robot.drive(Twist.planar(0.3, 0.0))
    ride.run(4.0)
    assert ride.error < 0.1  # what somebody said stays, and the wheels go on from there
    assert ride.estimator.spread > 0.2
    assert not ride.estimator.sure


def test_satellites_that_come_late_say_where_it_is_that_sees_too_little() -> None:
    ride = Ride(in_the_open(-8.0, 0.0, 0.0), None)
    ride.run(4.0)
    assert ride.error == pytest.approx(8.0)
    metre = 1.0 / (111_412.84 * math.cos(math.radians(47.0)))
    ride.estimator._beacons.on_compass(0.0, ride.now)
    for _ in range(6):
        at = NavSatFix(Header(Time.at(ride.now)), NavSatStatus(), 47.0, 8.0 - 8.0 * metre)
        ride.estimator.on_fix(at)
        ride.run(0.5)
    assert ride.error < 0.5
    assert ride.estimator.spread > 0.5
    assert not ride.estimator.sure
