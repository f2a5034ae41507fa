"""Height, roll and pitch of a robot, and how well they are known."""

from __future__ import annotations

import math
from statistics import fmean

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, Quaternion, Vector3, zeros36
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import FluidPressure, Imu, Range
from bridge.msgs.std_msgs import Header, Time
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.localisation.height_and_attitude import (
    AIR_PRESSURE,
    LEVEL_HEIGHT,
    LEVEL_TILT,
    UNKNOWN_HEIGHT,
    UNKNOWN_TILT,
    UNTOLD_HEIGHT,
    UNTOLD_TILT,
    WATER_WEIGHT,
    HeightAndAttitude,
)

HEIGHT, ROLL, PITCH = 14, 21, 28


def of(kind: str) -> HeightAndAttitude:
    return HeightAndAttitude(RobotInfo(kind=kind))


def odometry(
    z: float, variance: float = 0.0, *, at: float = 1.0, roll: float = 0.0, told: float = 0.0
) -> Odometry:
    covariance = zeros36()
    covariance[HEIGHT], covariance[ROLL], covariance[PITCH] = variance, told, told
    pose = Pose(Point(1.0, 2.0, z), Quaternion.from_rpy(roll, 0.0, 0.4))
    return Odometry(header=Header(Time.at(at)), pose=PoseWithCovariance(pose, covariance))


def unit(roll: float, pitch: float, *, at: float = 1.0, told: float = 0.0, rate: float = 0.0) -> Imu:
    return Imu(
        header=Header(Time.at(at)),
        orientation=Quaternion.from_rpy(roll, pitch, 2.0),
        orientation_covariance=[told, 0.0, 0.0, 0.0, told, 0.0, 0.0, 0.0, told],
        angular_velocity=Vector3(rate, 0.0, 0.0),
    )


def gauge(depth: float, noise: float = 0.0) -> FluidPressure:
    return FluidPressure(
        fluid_pressure=AIR_PRESSURE + WATER_WEIGHT * depth, variance=(WATER_WEIGHT * noise) ** 2
    )


def said(robot: HeightAndAttitude) -> PoseWithCovariance:
    return robot.posed(Pose2(1.0, 2.0, 0.4), zeros36())


def test_nothing_is_ever_said_to_be_exact() -> None:
    for kind in ("wheels", "ackermann", "boat", "hexapod", "quadrotor", "hovercraft", ""):
        robot = of(kind)
        robot.on_odometry(odometry(0.0))
        for place in (HEIGHT, ROLL, PITCH):
            assert said(robot).covariance[place] > 0, (kind, place)


def test_the_floor_is_level_as_far_as_a_robot_on_wheels_knows() -> None:
    robot = of("wheels")
    assert math.isnan(robot.height)
    assert robot.spread == UNKNOWN_HEIGHT
    robot.on_odometry(odometry(0.0))
    assert (robot.height, robot.spread) == (0.0, LEVEL_HEIGHT)
    assert said(robot).covariance[ROLL] == pytest.approx(LEVEL_TILT**2)


def test_odometry_tells_the_height_and_how_well_it_knows_it() -> None:
    robot = of("quadrotor")
    robot.on_odometry(odometry(2.0, 0.04))
    assert (robot.height, robot.spread) == (2.0, pytest.approx(0.2))
    robot.on_odometry(odometry(2.5))
    assert (robot.height, robot.spread) == (2.5, UNTOLD_HEIGHT)
    assert said(robot).covariance[ROLL] == pytest.approx(UNKNOWN_TILT**2)


def test_a_height_that_is_no_number_leaves_the_last_one_and_says_that_it_is_not_known() -> None:
    robot = of("quadrotor")
    robot.on_odometry(odometry(2.0, 0.04))
    robot.on_odometry(odometry(math.nan, 0.04))
    assert (robot.height, robot.spread) == (2.0, UNKNOWN_HEIGHT)
    robot.on_odometry(odometry(2.1, 0.04))
    assert (robot.height, robot.spread) == (2.1, pytest.approx(0.2))


def test_a_variance_that_is_none_counts_as_untold() -> None:
    robot = of("quadrotor")
    for wild in (-1.0, math.nan, math.inf):
        robot.on_odometry(odometry(2.0, wild))
        assert robot.spread == UNTOLD_HEIGHT


def test_the_unit_tells_roll_and_pitch_with_its_own_variance() -> None:
    robot = of("wheels")
    robot.on_imu(unit(0.1, -0.2, told=0.0009))
    robot.on_odometry(odometry(0.0))
    pose = said(robot)
    assert (pose.pose.orientation.roll, pose.pose.orientation.pitch) == pytest.approx((0.1, -0.2))
    assert pose.pose.orientation.yaw == pytest.approx(0.4), "the yaw is that of the place, not of the unit"
    assert pose.covariance[ROLL] == pose.covariance[PITCH] == pytest.approx(0.0009)
    robot.on_imu(unit(0.1, -0.2))
    assert said(robot).covariance[ROLL] == pytest.approx(UNTOLD_TILT**2)


def test_an_attitude_is_less_sure_the_faster_it_turned_since() -> None:
    robot = of("quadrotor")
    robot.on_imu(unit(0.1, 0.0, at=0.9, told=1e-6, rate=2.0))
    robot.on_odometry(odometry(1.0, 0.01, at=1.0))
    assert said(robot).covariance[ROLL] == pytest.approx(1e-6 + 0.2**2)
    assert said(robot).covariance[PITCH] == pytest.approx(1e-6)


def test_a_unit_without_an_attitude_or_of_long_ago_does_not_count_and_odometry_does() -> None:
    robot = of("hexapod")
    blind = Imu(header=Header(Time.at(1.0)), orientation_covariance=[-1.0, *[0.0] * 8])
    robot.on_imu(blind)
    robot.on_imu(unit(math.nan, 0.0))
    robot.on_odometry(odometry(-1.0, 0.01, roll=0.3, told=0.0025))
    pose = said(robot)
    assert pose.pose.orientation.roll == pytest.approx(0.3)
    assert pose.covariance[ROLL] == pytest.approx(0.0025)
    robot.on_imu(unit(0.1, 0.0, at=1.0, told=1e-4))
    robot.on_odometry(odometry(-1.0, 0.01, at=1.2, roll=0.3))
    assert said(robot).pose.orientation.roll == pytest.approx(0.1)
    robot.on_odometry(odometry(-1.0, 0.01, at=1.6, roll=0.3))
    assert said(robot).pose.orientation.roll == pytest.approx(0.3)
    assert said(robot).covariance[ROLL] == pytest.approx(UNTOLD_TILT**2)


def test_a_gauge_finds_the_height_that_odometry_lost_and_is_not_taken_for_better_than_it_is() -> None:
    rng = np.random.default_rng(3)
    heights = []
    for _ in range(200):
        robot = of("hexapod")
        air, salt = rng.normal(0.0, 1500.0), rng.normal(0.0, 0.015)
        for step in range(60):
            robot.on_odometry(odometry(-1.0 - 0.02 * step, 1.0 + 0.01 * step))
            pressure = AIR_PRESSURE + air + WATER_WEIGHT * (1 + salt) * 5.0 + rng.normal(0.0, 60.0)
            robot.on_depth(FluidPressure(fluid_pressure=float(pressure), variance=3600.0))
        heights.append(robot.height)
        spread = robot.spread
    errors = np.array(heights) + 5.0
    assert abs(fmean(errors)) < 3 * spread / math.sqrt(200)
    assert float(np.sqrt((errors**2).mean())) == pytest.approx(spread, rel=0.25), (
        "the weather is not averaged out"
    )


def test_a_gauge_changes_nothing_where_odometry_knows_the_height_better() -> None:
    robot = of("hexapod")
    robot.on_odometry(odometry(-2.0, 0.0001))
    robot.on_depth(gauge(2.1, 0.01))
    assert (robot.height, robot.spread) == (-2.0, pytest.approx(0.01))


def test_odometry_that_began_under_water_is_put_where_the_gauge_is_however_sure_it_is() -> None:
    robot = of("hexapod")
    robot.on_odometry(odometry(0.0, 0.0001))
    robot.on_depth(gauge(3.0, 0.01))
    assert robot.height == pytest.approx(-3.0, abs=0.01)
    robot.on_odometry(odometry(-0.5, 0.0001))
    assert robot.height == pytest.approx(-3.5, abs=0.01)
    to_odom, to_base = robot.edges(Time.at(2.0), ORIGIN, ORIGIN)
    assert to_base.transform.translation.z == -0.5, "odometry goes on; its frame is lowered"
    assert to_odom.transform.translation.z == pytest.approx(-3.0, abs=0.01)


def test_what_is_straight_below_tells_the_height_of_one_that_flies_but_not_what_stands_there() -> None:
    robot = of("quadrotor")
    robot.on_imu(unit(0.3, 0.0))
    robot.on_odometry(odometry(3.0, 4.0))
    robot.on_range(Range(range=2.0 / math.cos(0.3)))
    assert robot.height == pytest.approx(2.02, abs=0.02)
    known = robot.spread
    assert known == pytest.approx(0.3)
    for nothing in (math.inf, -math.inf, math.nan, 0.0, 0.4):
        robot.on_range(Range(range=nothing))
    assert (robot.height, robot.spread) == (pytest.approx(2.02, abs=0.02), known)


def test_a_robot_on_the_ground_goes_by_neither() -> None:
    robot = of("wheels")
    robot.on_odometry(odometry(0.0))
    robot.on_depth(gauge(4.0))
    robot.on_range(Range(range=2.0))
    assert (robot.height, robot.spread) == (0.0, LEVEL_HEIGHT)


def test_an_odometry_that_begins_anew_takes_its_height_with_it() -> None:
    robot = of("hexapod")
    robot.on_odometry(odometry(-1.0, 4.0))
    robot.on_depth(gauge(3.0))
    assert robot.height == pytest.approx(-3.0, abs=0.05)
    robot.on_odometry(odometry(-2.8, 0.0001))
    assert (robot.height, robot.spread) == (-2.8, pytest.approx(0.01))
