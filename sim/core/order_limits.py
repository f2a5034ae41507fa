"""Limits of the orders to a robot: a faulty order is refused, an excessive one is cut and reported."""

from __future__ import annotations

import math

import msgspec

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo

__all__ = ["check", "cut"]


def check(order: Manoeuvre, info: RobotInfo) -> None:
    """Raise ValueError when a part of `order` that must be a number is none, or one that may be NaN is infinite.

    So it does when what flies is sent below the ground, or the water, which are at 0.
    """
    linear, angular = order.twist.linear, order.twist.angular
    needed = {
        "twist": (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z),
        "steering": (order.steering,),
        "roll": (order.roll,),
        "pitch": (order.pitch,),
    }
    free = {"speed": order.speed, "throttle": order.throttle, "yaw": order.yaw, "height": order.height}
    wrong = [name for name, values in needed.items() if not all(map(math.isfinite, values))]
    wrong += [name for name, value in free.items() if math.isinf(value)]
    if wrong:
        raise ValueError(f"The {wrong[0]} of an order must be a number; the robot goes on as before.")
    if order.kind in _TO_HEIGHTS and order.height < 0 and "take_off" in info.manoeuvres:
        raise ValueError(f"{order.height:.3g} m is below the ground; {info.name} goes on as before.")


def cut(
    order: Manoeuvre, info: RobotInfo, heights: tuple[float, float] = (-math.inf, math.inf)
) -> tuple[Manoeuvre, str]:
    """`order` as the robot follows it, within all its limits, and one sentence where something was too much.

    `heights` are the lowest and the highest that it can go to [m]; a height that is left out, NaN, stays so.
    """
    linear, angular = order.twist.linear, order.twist.angular
    asked = math.hypot(linear.x, linear.y)
    share = min(1.0, info.max_speed / asked) if asked else 1.0
    followed = msgspec.structs.replace(
        order,
        twist=Twist(
            Vector3(linear.x * share, linear.y * share, _within(linear.z, info.max_climb)),
            Vector3(angular.x, angular.y, _within(angular.z, info.max_yaw_rate)),
        ),
        speed=_within(order.speed, info.max_speed),
        throttle=_within(order.throttle, 1.0),
        steering=_within(order.steering, info.max_steering or math.inf),
        roll=_within(order.roll, info.max_tilt or math.inf),
        pitch=_within(order.pitch, info.max_tilt or math.inf),
        height=order.height if math.isnan(order.height) else min(max(order.height, heights[0]), heights[1]),
    )
    return followed, _excess(order, asked, info) or _beyond(order, info, heights)


def _excess(order: Manoeuvre, speed: float, info: RobotInfo) -> str:
    """The part of an `order` that exceeds a limit, in one sentence, for that `speed` over ground [m/s]; empty when none does."""
    for says, asked, limit, unit in (
        ("goes", speed, info.max_speed, " m/s"),
        ("goes", order.speed, info.max_speed, " m/s"),
        ("climbs and sinks", order.twist.linear.z, info.max_climb or math.inf, " m/s"),
        ("turns", order.twist.angular.z, info.max_yaw_rate, " rad/s"),
        ("takes a throttle of", order.throttle, 1.0, ""),
        ("steers", order.steering, info.max_steering or math.inf, " rad"),
        ("leans", max(order.roll, order.pitch, key=abs), info.max_tilt or math.inf, " rad"),
    ):
        if abs(asked) > limit * _ROUNDING:
            return f"{info.name} {says} at most {limit:.3g}{unit}; {abs(asked):.3g}{unit} was requested."
    return ""


def _beyond(order: Manoeuvre, info: RobotInfo, heights: tuple[float, float]) -> str:
    """The height of an `order` that is too high or too low, in one sentence; empty when it is neither."""
    lowest, highest = heights
    if order.kind not in _TO_HEIGHTS or not (order.height < lowest or order.height > highest):
        return ""
    way, limit = ("higher", highest) if order.height > highest else ("lower", lowest)
    return f"{info.name} goes no {way} than {limit:.3g} m; {order.height:.3g} m was requested."


def _within(value: float, limit: float) -> float:
    """NaN for NaN."""
    return value if math.isnan(value) else max(-limit, min(limit, value))


_TO_HEIGHTS = ("course", "hover", "take_off")
_ROUNDING = 1 + 1e-9
"""An amount that exceeds a limit only by rounding does not exceed it."""
