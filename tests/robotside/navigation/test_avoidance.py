"""Arcs that stay free."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robotside.core.pose2 import Points
from robotside.navigation.avoidance import HORIZON, Avoidance, free_lengths

REACH = 0.3
NOTHING: Points = np.empty((0, 2))


def free(curvature: float, *points: tuple[float, float]) -> float:
    return float(free_lengths(np.array([curvature]), np.array(points, dtype=float).reshape(-1, 2), REACH)[0])


def by_walking(curvature: float, point: tuple[float, float]) -> float:
    """The same by small steps."""
    for step in range(int(HORIZON / 0.001)):
        s = step * 0.001
        angle = s * curvature
        x = math.sin(angle) / curvature if curvature else s
        y = (1 - math.cos(angle)) / curvature if curvature else 0.0
        if math.hypot(point[0] - x, point[1] - y) < REACH:
            return s
    return HORIZON


@pytest.mark.parametrize("curvature", [-3.0, -1.0, -0.3, 0.0, 0.3, 1.0, 3.0])
@pytest.mark.parametrize(
    "point", [(1.0, 0.0), (1.5, 0.4), (0.8, -0.5), (-1.0, 0.2), (0.0, 0.7), (0.5, 1.2), (2.0, -1.0)]
)
def test_the_free_length_of_an_arc_is_what_walking_it_tells(
    curvature: float, point: tuple[float, float]
) -> None:
    assert free(curvature, point) == pytest.approx(by_walking(curvature, point), abs=0.01)


def test_a_point_inside_the_disc_blocks_only_what_leads_to_it() -> None:
    assert free(0.0, (0.2, 0.0)) == 0.0
    assert free(0.0, (-0.2, 0.0)) == HORIZON


def test_with_nothing_in_sight_it_takes_the_wanted_arc() -> None:
    way = Avoidance(0.18, max_yaw_rate=1.9).choose(1.0, 0.2, 0.5, NOTHING)
    assert way.twist.linear.x == pytest.approx(0.5)
    assert way.twist.angular.z == pytest.approx(0.5 * 2 * math.sin(0.2))
    assert not way.blocked


def test_an_aim_far_aside_is_turned_to_on_the_spot() -> None:
    way = Avoidance(0.18, max_yaw_rate=1.9).choose(1.0, -2.0, 0.5, NOTHING)
    assert way.twist.linear.x == 0.0
    assert way.twist.angular.z < 0.0


@pytest.mark.parametrize("aside", [0.1, -0.1])
def test_it_swerves_to_the_free_side(aside: float) -> None:
    pillar = np.array([[1.0, aside]])
    way = Avoidance(0.18, max_yaw_rate=1.9).choose(2.0, 0.0, 0.5, pillar)
    assert way.twist.linear.x > 0.0
    assert way.twist.angular.z * aside < 0.0


def test_towards_the_end_of_a_blind_alley_it_is_slow_and_at_it_it_stands() -> None:
    along, across = np.linspace(-1.0, 1.2, 45), np.linspace(-0.5, 0.5, 21)
    left, right = (np.column_stack([along, np.full(45, side)]) for side in (0.5, -0.5))
    alley = np.concatenate([left, right, np.column_stack([np.full(21, 0.75), across])])
    slow = Avoidance(0.18, max_yaw_rate=1.9).choose(2.0, 0.0, 0.6, alley)
    assert 0.0 < slow.twist.linear.x < 0.6
    close = Avoidance(0.18, max_yaw_rate=1.9).choose(2.0, 0.0, 0.6, alley - [0.3, 0.0])
    assert close.blocked
    assert close.twist.linear.x == 0.0


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_however_near_its_way_leads_by_something_the_body_keeps_off_it(side: float) -> None:
    """The way passes at 0.19 m, which is a centimetre beside the body: a share of the clearance is kept all the same."""
    avoidance = Avoidance(0.18, max_yaw_rate=1.9, clearance=0.05)
    way = avoidance.choose(2.0, 0.0, 0.5, np.array([[0.8, 0.19 * side]]), room=0.19)
    assert way.twist.angular.z * side < 0.0
    assert avoidance.choose(2.0, 0.0, 0.5, np.array([[0.8, 0.25 * side]]), room=0.25).twist.linear.x > 0.0
