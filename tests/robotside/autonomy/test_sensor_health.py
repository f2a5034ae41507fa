"""What the robot measures of itself, and which sensors are alive."""

from __future__ import annotations

import math

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import LineSensor
from bridge.msgs.sensor_msgs import BatteryState, Imu, LaserScan, Range
from robotside.autonomy.sensor_health import SENSOR_TIMEOUT, SensorHealth, needed
from robotside.core.pose2 import Pose2
from robotside.motion.stopping_path import PlanarVelocity

MOVING = Twist(Vector3(0.3, 0.1), Vector3(0.0, 0.0, 0.2))
ODOM = Odometry(pose=PoseWithCovariance(Pose(Point(0.0, 0.0, -2.0))), twist=TwistWithCovariance(MOVING))


def test_odometry_tells_the_speed_and_the_imu_how_it_is_tilted_and_the_height_is_what_was_made_of_both() -> (
    None
):
    sensor_health = SensorHealth()
    assert math.isnan(sensor_health.measured(None).height)
    sensor_health.on_message("/odom", ODOM, 1.0)
    sensor_health.on_message("/imu/data", Imu(orientation=Quaternion.from_rpy(0.1, -0.2, 3.0)), 1.0)
    found = sensor_health.measured(Pose2(1.0, 2.0, 3.0), height=-2.0, height_spread=0.1)
    assert (found.moving, found.height, found.height_spread) == (PlanarVelocity(0.3, 0.1, 0.2), -2.0, 0.1)
    assert math.isclose(found.roll, 0.1)
    assert math.isclose(found.pitch, -0.2)
    assert found.pose == (1.0, 2.0, 3.0)


def test_what_is_no_number_changes_nothing() -> None:
    sensor_health = SensorHealth()
    sensor_health.on_message("/odom", ODOM, 1.0)
    wild = TwistWithCovariance(Twist(Vector3(math.inf), Vector3(0.0, 0.0, math.nan)))
    sensor_health.on_message("/odom", Odometry(twist=wild), 1.1)
    assert sensor_health.measured(None).moving == PlanarVelocity(0.3, 0.1, 0.2)


def test_an_imu_without_orientation_says_nothing_of_it() -> None:
    sensor_health = SensorHealth()
    covariance = [-1.0, *[0.0] * 8]
    tilted = Quaternion.from_rpy(0.5, 0.5, 0.0)
    sensor_health.on_message("/imu/data", Imu(orientation=tilted, orientation_covariance=covariance), 1.0)
    assert sensor_health.measured(None).roll == 0.0


def test_what_it_drives_with_is_missed_from_the_start_and_the_rest_once_it_was_there() -> None:
    sensor_health = SensorHealth()
    assert sensor_health.silent(0.0) == ["odometry", "laser"]
    sensor_health.on_message("/odom", ODOM, 0.0)
    sensor_health.on_message("/scan", LaserScan(), 0.0)
    assert sensor_health.silent(SENSOR_TIMEOUT) == []
    sensor_health.on_message("/imu/data", Imu(), 0.0)
    sensor_health.on_message("/odom", ODOM, 2.0)
    assert sensor_health.silent(2.0) == ["laser", "IMU"]


def test_small_sensors_that_fell_silent_are_named() -> None:
    sensor_health = SensorHealth()
    for topic, message in (("/odom", ODOM), ("/scan", LaserScan()), ("/line_sensor", LineSensor())):
        sensor_health.on_message(topic, message, 0.0)
    sensor_health.on_message("/range/rear", Range(), 0.0)
    for topic, message in (("/odom", ODOM), ("/scan", LaserScan())):
        sensor_health.on_message(topic, message, 2.0)
    assert sensor_health.silent(2.0) == ["line sensor", "rear ultrasound"]


def test_which_sensors_it_needs_depends_on_its_kind_and_on_what_it_has() -> None:
    assert list(needed("wheels", ())) == ["/odom", "/scan"]
    assert list(needed("wheels", ("/odom", "/sonar"))) == ["/odom", "/sonar"]
    assert list(needed("ackermann", ("/sonar", "/scan"))) == ["/odom", "/scan"]
    for kind in ("boat", "hexapod", "quadrotor"):
        assert list(needed(kind, ("/odom",))) == ["/odom"]
    assert list(needed("boat", ("/scan",))) == ["/odom", "/scan"]


def test_a_boat_misses_no_laser() -> None:
    sensor_health = SensorHealth("boat")
    assert sensor_health.silent(0.0) == ["odometry"]
    sensor_health.on_message("/odom", ODOM, 0.0)
    assert sensor_health.silent(SENSOR_TIMEOUT) == []


def test_speed_is_over_ground_whichever_way_the_body_leans() -> None:
    sensor_health = SensorHealth()
    for roll, pitch, body, ground in (
        (0.0, 0.5, Vector3(math.cos(0.5), 0.0, math.sin(0.5)), (1.0, 0.0)),
        (0.8, 0.0, Vector3(0.0, math.cos(0.8), -math.sin(0.8)), (0.0, 1.0)),
        (0.8, 0.0, Vector3(0.0, math.sin(0.8), math.cos(0.8)), (0.0, 0.0)),
    ):
        leans = Pose(Point(), Quaternion.from_rpy(roll, pitch, 2.0))
        sensor_health.on_message(
            "/odom", Odometry(pose=PoseWithCovariance(leans), twist=TwistWithCovariance(Twist(body))), 1.0
        )
        moving = sensor_health.measured(None).moving
        assert math.isclose(moving.x, ground[0], abs_tol=1e-9)
        assert math.isclose(moving.y, ground[1], abs_tol=1e-9)


def test_it_charges_as_long_as_the_battery_says_so_and_is_heard() -> None:
    sensor_health = SensorHealth()
    sensor_health.on_message("/battery_state", BatteryState(power_supply_status=2), 1.0)
    assert not sensor_health.measured(None).charging
    sensor_health.on_message("/battery_state", BatteryState(power_supply_status=1), 2.0)
    sensor_health.on_message("/odom", ODOM, 11.9)
    assert sensor_health.measured(None).charging
    sensor_health.on_message("/odom", ODOM, 12.1)
    assert not sensor_health.measured(None).charging
