"""Station keeping of a robot that current, wind or its own way carries: it reports the drift and returns.

Pure: what the robot measures is passed in.
"""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from robotside.core.notice import Notice, Problem
from robotside.motion.speed_limit import within

__all__ = ["RETURN_BELOW", "RETURN_UNTIL", "CREEP_SPEED", "MIN_DRIFT", "DriftMonitor", "back", "way_back"]

RETURN_BELOW, RETURN_UNTIL = 0.0, 0.4
"""With less room than the first one that drifts goes back, until it has the second [m]."""
RETURN_SPEED, RETURN_YAW_RATE, RETURN_GAIN = 0.35, 0.5, 1.0
"""So fast it goes back [m/s, rad/s], turning towards the inside [1/s]."""
CREEP_SPEED = 0.25
"""A boat that is to turn without going makes so much way, for the rudder needs it [m/s]."""
MIN_DRIFT = 0.02
"""Slower than this nothing drifts [m/s]."""
MIN_ASTERN, MIN_REVERSAL = 0.2, 0.4
"""With the inside farther behind it than the first, a cosine, it begins astern; beyond the second it goes the other way than
it does: it has turned, and would go out."""


def way_back(inward: tuple[float, float], before: float) -> float:
    """1 for ahead and -1 for astern, the one that leads back to where it is `inward` in `base_link`; `before` it went so, 0 for neither."""
    if before:
        return before if before * inward[0] > -MIN_REVERSAL else -before
    return 1.0 if inward[0] >= -MIN_ASTERN else -1.0


def back(inward: tuple[float, float], way: float) -> Twist:
    """The way back to the inside, which is `inward` in `base_link`: ahead for a `way` of 1 or astern for -1, turning there.

    A `way` of 0 is that of one that turns where it is: bow first, and no faster than it looks there.
    """
    bow = way or 1.0
    turn = RETURN_GAIN * math.atan2(bow * inward[1], bow * inward[0])
    speed = bow * RETURN_SPEED * (1.0 if way else max(0.0, inward[0]))
    return Twist.planar(speed, within(turn, RETURN_YAW_RATE))


class DriftMonitor:
    """Reports once that a robot drifts over its fence, and again after it was back."""

    def __init__(self) -> None:
        self._said = False

    def check(self, name: str, room: float, outward: float, *, returns: bool = False) -> Problem:
        """The sentence about a robot with this `room` [m] that goes `outward` [m/s]; empty for none."""
        if room > RETURN_UNTIL:
            self._said = False
        if self._said or room > RETURN_BELOW or outward < MIN_DRIFT:
            return ""
        self._said = True
        name = name or "The robot"
        does = "towards its fence; it goes back by itself" if returns else "over its fence"
        return Notice(Code.FENCE_DRIFT, f"{name} drifts {does}.", robot=name)
