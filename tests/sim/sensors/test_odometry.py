"""Wheel odometry against the arc that two wheels roll off, written out by hand."""

from __future__ import annotations

import math

import pytest

from sim.core.noise import Noise
from sim.physics.bodies import Joint
from sim.sensors.odometry import OdometryParameters, WheelOdometry

RADIUS, BASE, RATE = 0.1, 0.5, 200
EXACT = OdometryParameters(rate=20.0, radius_error=0.0, mismatch=0.0, base_error=0.0, slip=0.0)


def rolled(left: float, right: float, seconds: float = 2.0, yaw: float = 0.0) -> WheelOdometry:
    """Odometry after its wheels have turned at these speeds [rad/s], from (1, 2) at `yaw`."""
    odometry = WheelOdometry(
        EXACT, radius=RADIUS, base=BASE, ticks=1e6, pose=(1.0, 2.0, yaw), noise=Noise(0, "odometry", on=False)
    )
    for step in range(1, round(seconds * RATE) + 1):
        at = step / RATE
        odometry.update(Joint(left * at, left, 0.0), Joint(right * at, right, 0.0))
    return odometry


@pytest.mark.parametrize(("left", "right"), [(2.0, 4.0), (4.0, 2.0), (-3.0, 3.0), (-2.0, -2.5)])
def test_the_faster_wheel_is_outside_and_a_turn_to_the_left_is_positive(left: float, right: float) -> None:
    speed, turn = RADIUS * (left + right) / 2, RADIUS * (right - left) / BASE
    odometry = rolled(left, right, yaw=0.4)
    radius, end = speed / turn, 0.4 + turn * 2.0
    x = 1.0 + radius * (math.sin(end) - math.sin(0.4))
    y = 2.0 - radius * (math.cos(end) - math.cos(0.4))
    assert odometry.pose == pytest.approx((x, y, end), abs=1e-3)
    twist = odometry.odometry(7.0).twist.twist
    assert (twist.linear.x, twist.angular.z) == pytest.approx((speed, turn))
    assert (twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y) == (0.0, 0.0, 0.0, 0.0)


def test_put_back_it_starts_from_there_and_is_sure_again() -> None:
    odometry = rolled(3.0, 3.5, seconds=20.0)
    doubtful = odometry.odometry(0.0).pose.covariance[0]
    odometry.restart((-1.0, 0.5, 1.0))
    pose = odometry.odometry(0.0).pose
    assert (pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.yaw) == pytest.approx(
        (-1.0, 0.5, 1.0)
    )
    assert pose.covariance[0] < doubtful / 100
