"""Small pieces of control that several vehicles share."""

from __future__ import annotations

import math

from msgspec.structs import replace

from bridge.msgs.pilothouse_msgs import Manoeuvre

__all__ = ["filled", "given", "towards", "within"]


def towards(now: float, goal: float, limit: float) -> float:
    """`goal`, or as far towards it from `now` as `limit` allows."""
    return min(max(goal, now - limit), now + limit)


def within(value: float, limit: float) -> float:
    """`value`, cut to what lies between -`limit` and `limit`."""
    return min(max(value, -limit), limit)


def given(value: float, otherwise: float) -> float:
    """`value`, or `otherwise` where it is NaN."""
    return otherwise if math.isnan(value) else value


def filled(order: Manoeuvre, yaw: float, height: float = math.nan) -> Manoeuvre:
    """`order` with the heading [rad] and the height [m] that are kept where it names none; NaN for one that is not kept."""
    return replace(order, yaw=given(order.yaw, yaw), height=given(order.height, height))
