"""Reports of drive commands beyond the robot's limits, with what was asked for and what is allowed.

A slow link, a fence or a height slows an order too; what is told here is only what the driver asked too much of.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.notice import Notice, Problem
from robotside.motion.manoeuvres import Order
from robotside.records.events import Say

__all__ = ["REPORT_PERIOD", "LimitViolations", "excess"]

REPORT_PERIOD = 3.0
"""One client's excess is told at most this often [s]."""

ROUNDING_TOLERANCE = 1.01
"""A stick at its stop may be above the limit by so much: numbers are rounded on their way."""


QUANTITIES = {" m/s": "speed", " rad/s": "turn", " rad": "angle", "": "share"}
"""Unit, as it is written, to the kind of quantity of `bridge.core.codes`."""


def excess(order: Order, info: RobotInfo) -> Problem:
    """What of `order` is more than the robot may do, with what is allowed, as one sentence; empty when nothing is."""
    for says, asked, most, unit in _asked(order, info):
        if abs(asked) > most * ROUNDING_TOLERANCE:
            said = f"{info.name} {says} at most {_number(most)}{unit}; {_number(abs(asked))}{unit} was requested."
            code, kind = Code.DRIVE_EXCESSIVE, QUANTITIES[unit]
            return Notice(code, said, robot=info.name, asked=abs(asked), allowed=most, quantity=kind)
    return ""


def _asked(order: Order, info: RobotInfo) -> Iterator[tuple[str, float, float, str]]:
    """What is asked for: as what, how much, how much may be, in which unit."""
    twist = order if isinstance(order, Twist) else order.twist
    v, w = twist.linear, twist.angular
    yield "goes", math.hypot(v.x, v.y), info.max_speed, " m/s"
    if isinstance(order, Manoeuvre):
        yield "goes", _said(order.speed), info.max_speed, " m/s"
    if info.max_climb:
        yield "climbs and sinks", v.z, info.max_climb, " m/s"
    yield "turns", max(w.x, w.y, w.z, key=abs), info.max_yaw_rate, " rad/s"
    if not isinstance(order, Manoeuvre):
        return
    yield "takes a throttle of", _said(order.throttle), 1.0, ""
    if order.kind == "steer" and info.max_steering:
        yield "steers", order.steering, info.max_steering, " rad"
    if order.kind == "tilt" and info.max_tilt:
        yield "leans", max(order.roll, order.pitch, key=abs), info.max_tilt, " rad"


def _said(value: float) -> float:
    return 0.0 if math.isnan(value) else value


def _number(value: float) -> str:
    """A short number: a float may have 300 digits."""
    return f"{value:.3g}"


class LimitViolations:
    """Tells everyone, of each client now and then."""

    def __init__(self, info: RobotInfo, say: Say, clock: Callable[[], float]) -> None:
        """`info` is what the robot may do; `clock` is the operators' [s]."""
        self._info, self._say, self._clock = info, say, clock
        self._next: dict[str, float] = {}

    def check(self, client: str, order: Order) -> None:
        """`client`, by its id, is obeyed with this `order`, as far as it may be."""
        said = excess(order, self._info)
        now = self._clock()
        if said and now >= self._next.get(client, -math.inf):
            self._next[client] = now + REPORT_PERIOD
            self._say("command", said, "warn")

    def forget(self, client: str) -> None:
        """It is gone."""
        self._next.pop(client, None)
