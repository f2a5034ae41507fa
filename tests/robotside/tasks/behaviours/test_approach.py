"""The last metres to a dock, by geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Point32
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.pose2 import Pose2
from robotside.tasks.behaviours.approach import CREEP_SPEED, Approach

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
    ("point", "taken"), [((1.7, 0.0), True), ((1.7, 0.5), False), ((1.0, 0.0), False), ((1.99, 0.1), False)]
)
def test_what_stands_where_it_would_stand_has_taken_the_dock(point, taken):
    assert ROUND.taken(np.array([point]), DOCK) is taken


def test_the_room_behind_is_from_its_back_to_the_nearest_thing():
    assert ROUND.room_behind(np.array([(-1.0, 0.1), (-0.5, 0.6), (0.5, 0.0)])) == pytest.approx(0.82)
    assert ROUND.room_behind(np.empty((0, 2))) == math.inf
