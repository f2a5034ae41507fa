"""What an agent sees of sensors that see nothing, or are touched."""

from __future__ import annotations

import math

import numpy as np

from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo, SonarRing
from bridge.msgs.sensor_msgs import LaserScan
from sim.training.measurements import Measurements

INFO = RobotInfo(max_speed=1.0, max_yaw_rate=2.0)
ODD = Float32Array([math.inf, -math.inf, math.nan, 2.5])


def test_nothing_in_range_is_the_farthest_and_a_touch_is_zero() -> None:
    for topic, message in (
        ("/scan", LaserScan(ranges=ODD, range_max=12.0)),
        ("/sonar", SonarRing(ranges=ODD, range_max=12.0)),
    ):
        seen = Measurements(INFO, [(topic, message)])
        assert seen.seen()["ranges"].tolist() == [12.0, 0.0, 12.0, 2.5]
        assert seen.spaces()["ranges"].contains(seen.seen()["ranges"])


def test_a_robot_without_either_sees_none() -> None:
    assert set(Measurements(INFO, []).seen()) == {"velocity"}


def test_a_speed_beyond_the_bounds_is_cut_to_them() -> None:
    flung = Odometry(twist=TwistWithCovariance(Twist(Vector3(9.0, 0.1, 0.0), Vector3(0.0, 0.0, -1.0))))
    seen = Measurements(INFO, [("/odom", flung)])
    assert np.allclose(seen.seen()["velocity"], [2.0, 0.1, 0.0, -1.0])
    assert seen.spaces()["velocity"].contains(seen.seen()["velocity"])
