"""Speed limits for twists."""

from __future__ import annotations

import math

from bridge.msgs.geometry_msgs import Twist, Vector3

__all__ = ["slower", "within"]


def within(value: float, most: float) -> float:
    """`value`, no farther from 0 than `most`, in its unit."""
    return max(-most, min(most, value))


def slower(twist: Twist, speed: float, turn: float) -> Twist:
    """`twist` in its direction at no more than `speed` [m/s], and at no more than `turn` [rad/s] about each axis."""
    v, w = twist.linear, twist.angular
    fast = math.hypot(v.x, v.y, v.z)
    scale = speed / fast if fast > speed else 1.0
    return Twist(
        Vector3(v.x * scale, v.y * scale, v.z * scale),
        Vector3(within(w.x, turn), within(w.y, turn), within(w.z, turn)),
    )
