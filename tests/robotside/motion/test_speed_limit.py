"""Speeds cut to what is allowed."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from robotside.motion.speed_limit import slower, within


def test_what_is_too_fast_keeps_its_direction() -> None:
    twist = slower(Twist(Vector3(3.0, 4.0, 0.0), Vector3(0.0, -0.4, 2.0)), 1.0, 0.5)
    assert (twist.linear.x, twist.linear.y, twist.linear.z) == pytest.approx((0.6, 0.8, 0.0))
    assert (twist.angular.x, twist.angular.y, twist.angular.z) == (0.0, -0.4, 0.5)


def test_what_is_allowed_stays_as_it_is() -> None:
    twist = Twist(Vector3(-0.6, 0.8, 0.0), Vector3(0.0, 0.0, -0.5))
    assert slower(twist, 1.0, 0.5) == twist
    assert slower(twist, math.inf, math.inf) == twist


@pytest.mark.parametrize(("value", "cut"), [(-3.0, -2.0), (-1.0, -1.0), (0.0, 0.0), (2.5, 2.0)])
def test_a_value_is_cut_on_both_sides(value: float, cut: float) -> None:
    assert within(value, 2.0) == cut
