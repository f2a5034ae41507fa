"""Small pieces of control that several vehicles share."""

from __future__ import annotations

import math

from msgspec.structs import replace

from bridge.msgs.pilothouse_msgs import Manoeuvre

__all__ = ["filled", "given", "towards", "within"]


def towards(now: float, goal: float, most: float) -> float:
    """`goal`, or as far towards it from `now` as `most` allows."""
    return min(max(goal, now - most), now + most)


def within(value: float, most: float) -> float:
    """`value`, cut to what lies between -`most` and `most`."""
    return min(max(value, -most), most)


def given(value: float, otherwise: float) -> float:
    """`value`, or `otherwise` where it is NaN."""
    return otherwise if math.isnan(value) else value


def filled(order: Manoeuvre, yaw: float, height: float = math.nan) -> Manoeuvre:
    """`order` with the heading [rad] and the height [m] that are kept where it names none; NaN for what is not kept."""
    return replace(order, yaw=given(order.yaw, yaw), height=given(order.height, height))
