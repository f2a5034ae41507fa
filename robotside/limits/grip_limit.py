"""The grip of the ground as a limit: no more braking is counted on than it gives, and bends are no faster than it holds with ease."""

from __future__ import annotations

import math
from dataclasses import replace

from bridge.msgs.geometry_msgs import Twist
from robotside.kinds.vehicle_kind import Handling
from robotside.limits.clamped_twist import scaled

__all__ = ["BEND_SHARE", "BRAKING_SHARE", "braked_by", "held_in_bend"]

_GRAVITY = 9.81
"""[m/s2]"""
BRAKING_SHARE = 0.75
"""Part of what friction gives that braking counts on: loads are uneven, and wheels slip before they hold."""
BEND_SHARE = 0.5
"""Part of it that a bend may take, so that the robot can steer and brake in it as well."""


def braked_by(handling: Handling, grip: float | None) -> Handling:
    """`handling` with no more braking than a ground of that friction coefficient gives; None for one that is not known."""
    if grip is None:
        return handling
    return replace(handling, braking=min(handling.braking, BRAKING_SHARE * grip * _GRAVITY))


def held_in_bend(twist: Twist, handling: Handling, grip: float | None) -> Twist:
    """`twist` at no more speed than that at which its bend takes its part of the grip; one that steers stays on its arc."""
    if grip is None:
        return twist
    aside = math.hypot(twist.linear.x, twist.linear.y) * abs(twist.angular.z)
    most = BEND_SHARE * grip * _GRAVITY
    if aside <= most:
        return twist
    # one that steers turns more slowly as it goes more slowly
    return scaled(twist, math.sqrt(most / aside) if handling.steers else most / aside, handling)
