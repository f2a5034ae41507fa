"""The last metres to a dock, by geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point32, Twist
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.pose2 import Pose2
from robotside.tasks.berthing.approach import CREEP_SPEED, Approach

ROUND = Approach.of(RobotInfo(radius=0.18))
TRUCK = Approach.of(
    RobotInfo(
        radius=1.6,
        min_radius=3.5,
        footprint=[Point32(2.5, 0.7), Point32(2.5, -0.7), Point32(-0.5, -0.7), Point32(-0.5, 0.7)],
    )
)
DOCK = Pose2(2.0, 0.0, 0.0)


def test_the_body_is_that_of_its_outline_or_of_its_circle():
    assert (ROUND.front, ROUND.rear, ROUND.half) == (0.18, 0.18, 0.18)
    assert (TRUCK.front, TRUCK.rear, TRUCK.half) == pytest.approx((2.5, 0.5, 0.7))


@pytest.mark.parametrize("way", [ROUND, TRUCK])
def test_it_comes_to_the_line_from_beside_it_and_ends_straight_and_slow(way):
    x, y, yaw = -way.standoffs[0] - way.front, 0.15, -0.12
    while -x - way.front > 0.0:
        twist = way.steer(Pose2(x, y, yaw))
        speed, turn = twist.linear.x, twist.angular.z
        if way.min_radius and speed:
            assert abs(turn) <= speed / way.min_radius + 1e-9
        x, y, yaw = (
            x + 0.05 * speed * math.cos(yaw),
            y + 0.05 * speed * math.sin(yaw),
            yaw + 0.05 * turn,
        )
    assert abs(y) < 0.02
    assert abs(yaw) < 0.08
    assert speed == CREEP_SPEED


def test_a_boat_leaves_faster_and_farther_along_what_guides_it():
    boat = Approach.of(RobotInfo(kind="boat", radius=0.5, min_radius=1.4))
    assert (boat.leave, boat.retreat, boat.guided) == (4.0, 0.35, 0.8)
    assert (ROUND.retreat, ROUND.guided) == (0.12, 0.1)


def test_one_that_turns_on_the_spot_turns_first():
    assert ROUND.steer(Pose2(-1.0, 0.0, 1.2)).linear.x == 0.0
    assert ROUND.steer(Pose2(-1.0, 0.0, 1.2)).angular.z < 0


@pytest.mark.parametrize(
    ("point", "blocked"),
    [((1.0, 0.0), True), ((1.0, 0.2), True), ((1.0, 0.3), False), ((1.9, 0.0), False), ((-0.5, 0.0), False)],
)
def test_what_stands_between_it_and_the_dock_is_in_the_way(point, blocked):
    assert ROUND.blocked(np.array([point]), DOCK) is blocked


@pytest.mark.parametrize(
    ("point", "gap", "blocked"),
    [
        ((5.0, 0.2), 0.3, False),  # straight ahead, where its bend does not lead
        ((4.5, -1.8), 0.3, True),
        ((6.5, -2.2), 0.3, True),
        ((6.5, -2.2), 2.5, False),
        ((6.5, -0.9), 0.3, False),
        ((0.5, -0.73), 0.3, False),  # beside it already
        ((2.52, -0.8), 0.3, True),
    ],
)
def test_what_a_truck_comes_to_on_its_bends_is_in_the_way(point, gap, blocked):
    askew = Pose2(-8.5, 0.6, 0.3)
    assert TRUCK.blocked(np.array([point]), askew.inverse(), gap) is blocked


@pytest.mark.parametrize(
    ("point", "taken"), [((1.7, 0.0), True), ((1.7, 0.5), False), ((1.0, 0.0), False), ((1.99, 0.1), False)]
)
def test_what_stands_where_it_would_stand_has_taken_the_dock(point, taken):
    assert ROUND.taken(np.array([point]), DOCK) is taken


def test_the_room_behind_is_from_its_back_to_the_nearest_thing():
    assert ROUND.room_behind(np.array([(-1.0, 0.1), (-0.5, 0.6), (0.5, 0.0)])) == pytest.approx(0.82)
    assert ROUND.room_behind(np.empty((0, 2))) == math.inf


@pytest.mark.parametrize(
    ("x", "y", "yaw", "reaches"),
    [
        (-8.5, 0.0, 0.0, True),
        (-8.5, 0.4, -0.1, True),
        (-4.5, 0.9, 0.0, False),
        (-4.5, 0.0, 0.5, False),
        (-8.5, 0.0, 2.0, False),
    ],
)
def test_bends_lead_onto_the_line_only_from_far_enough_away(x, y, yaw, reaches):
    assert TRUCK.reaches(Pose2(x, y, yaw)) is reaches


def test_one_that_turns_on_the_spot_reaches_every_line():
    assert ROUND.reaches(Pose2(-0.5, 1.5, 2.0))


def test_the_front_of_a_truck_comes_to_the_line_first():
    assert TRUCK.steer(Pose2(-5.0, 0.2, -0.08)).angular.z == pytest.approx(0.0, abs=0.03)
    assert TRUCK.steer(Pose2(-5.0, 0.0, 0.1)).angular.z < -0.01
    assert TRUCK.aside(Pose2(-5.0, 0.1, 0.04)) == pytest.approx(0.2, abs=0.001)


@pytest.mark.parametrize(
    ("y", "yaw", "off"), [(0.0, 0.0, False), (0.05, 0.0, True), (0.0, 0.02, True), (-0.4, 0.16, True)]
)
def test_off_the_line_is_the_front_aside_or_the_robot_askew(y, yaw, off):
    assert TRUCK.off(Pose2(-2.7, y, yaw)) is off


def test_slow_it_orders_the_angle_of_its_wheels():
    way = Approach.of(RobotInfo(radius=1.6, min_radius=3.5, max_steering=0.5, manoeuvres=["twist", "steer"]))
    order = way.order(Twist.planar(0.08, 0.08 / 3.5))
    assert (order.kind, order.speed) == ("steer", 0.08)
    assert order.steering == pytest.approx(0.5)
    assert way.order(Twist.planar(0.08, 0.0)).steering == 0.0
    assert not TRUCK.lock
