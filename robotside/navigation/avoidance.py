"""Obstacle avoidance: the free arc nearest to the wanted one.

Arcs are those a robot drives with constant speed and yaw rate (the curvature-velocity method); the distance that
is free along each is exact, not sampled.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.geometry_msgs import Twist
from robotside.core.pose2 import Points
from robotside.motion.speed_limit import within

__all__ = ["HORIZON", "Avoidance", "AvoidanceResult", "free_lengths"]

HORIZON = 2.5
"""Obstacles farther away than this do not matter yet [m]."""

GAP = 0.10
"""Kept between the body and anything that the laser sees, where the way has so much room [m]."""

NARROW_SHARE = 0.6
"""Of the clearance that a way is planned with, so much is kept where it leads through a gap: the rest is for steering."""

STEERING_ERROR = 0.01
"""The way is left by so much at least [m]."""

CREEP_SPEED, SPEED_PER_ROOM = 0.12, 2.5
"""With no room beside the body it goes at the first, and faster by the second with each metre of it [m/s, 1/s]."""

FINE_CURVATURES = np.array([-0.8, -0.6, -0.4, -0.2, -0.1, 0.1, 0.2, 0.4, 0.6, 0.8])
"""Tried beside the wanted one in a gap, as differences to it [1/m]."""

BRAKING = 0.4
"""Deceleration counted on when something is ahead [m/s2]."""

CURVATURES = np.concatenate([np.linspace(-3.0, -0.25, 12), [0.0], np.linspace(0.25, 3.0, 12)])
"""Arcs that are tried beside the wanted one [1/m]; positive to the left."""

MIN_FREE_LENGTH = 0.35
"""An arc with less free length than this leads nowhere [m]."""


@dataclass(frozen=True, slots=True)
class AvoidanceResult:
    """The command for now."""

    twist: Twist
    blocked: bool
    """No arc leads on; the twist only turns, or nothing."""


def free_lengths(curvatures: NDArray[np.float64], points: Points, reach: float) -> NDArray[np.float64]:
    """How far a disc of radius `reach` [m] can go along each arc before it touches a point [m], up to HORIZON.

    `points` are in the disc's own frame. A point inside the disc counts only for arcs that lead towards it.
    """
    free = np.full(len(curvatures), HORIZON)
    if not len(points):
        return free
    k = curvatures[:, None]
    x, y = points[None, :, 0], points[None, :, 1]
    bent = np.where(np.abs(k) < 1e-3, 1e-3, k)
    radius = 1.0 / bent
    span = np.hypot(x, y - radius)
    size = np.abs(radius)
    with np.errstate(invalid="ignore", divide="ignore"):
        offset = np.arccos((size**2 + span**2 - reach**2) / (2.0 * size * span))
    side = np.sign(bent)
    angle = np.arctan2(x, side * (radius - y))
    inside = x * x + y * y < reach * reach
    angle = np.where((angle < -offset) & ~inside, angle + math.tau, angle)
    length = (angle - offset) * size
    length = np.where(inside, np.where(angle > 0.0, 0.0, HORIZON), length)
    length = np.where(np.isnan(offset) & ~inside, HORIZON, length)
    return np.asarray(np.clip(length, 0.0, HORIZON).min(axis=1))


class Avoidance:
    """Chooses the twist for one robot of `radius` [m]."""

    def __init__(self, radius: float, *, max_yaw_rate: float, clearance: float = GAP) -> None:
        """`clearance` is what ways are planned with at least [m]."""
        self._radius = radius
        self._least = radius + NARROW_SHARE * clearance
        self._usual = max(radius + GAP, self._least)
        self._turn = max_yaw_rate
        self._last = 0.0

    def choose(
        self,
        distance: float,
        bearing: float,
        speed: float,
        points: Points,
        room: float = math.inf,
    ) -> AvoidanceResult:
        """The twist towards an aim at `distance` [m] and `bearing` [rad], at up to `speed` [m/s].

        `points` are what the laser sees, in `base_link`; the way goes by at `room` [m] from the nearest of them.
        """
        if abs(bearing) > 1.0:
            return AvoidanceResult(Twist.planar(0.0, self._rate(2.0 * bearing)), False)
        wanted = 2.0 * math.sin(bearing) / max(distance, 0.1)
        near = points[np.hypot(points[:, 0], points[:, 1]) < HORIZON]
        # no more is kept than the way itself has, or no arc led through its gaps
        reach = max(self._least, min(self._usual, room - STEERING_ERROR))
        narrow = reach < self._usual
        curvatures = np.concatenate([CURVATURES, wanted + FINE_CURVATURES] if narrow else [CURVATURES])
        curvatures = np.append(curvatures, wanted)
        if narrow:
            speed = min(speed, CREEP_SPEED + SPEED_PER_ROOM * max(0.0, room - self._radius))
        free = free_lengths(curvatures, near, reach)
        needed = min(distance, MIN_FREE_LENGTH + speed * speed / (2 * BRAKING) + 0.4)
        best = self._best(curvatures, free, wanted, needed)
        if free[best] < min(MIN_FREE_LENGTH, distance * 0.5):
            return AvoidanceResult(Twist.planar(0.0, self._rate(1.5 * bearing)), True)
        return AvoidanceResult(self._along(float(curvatures[best]), float(free[best]), speed), False)

    def _best(
        self, curvatures: NDArray[np.float64], free: NDArray[np.float64], wanted: float, needed: float
    ) -> int:
        shortfall = np.clip(needed - free, 0.0, None) / needed
        away = np.abs(curvatures - wanted)
        swing = np.abs(curvatures - self._last)
        best = int(np.argmin(6.0 * shortfall + 0.5 * away + 0.1 * swing))
        self._last = float(curvatures[best])
        return best

    def _along(self, curvature: float, free: float, speed: float) -> Twist:
        by_room = math.sqrt(2.0 * BRAKING * max(0.0, free - 0.1))
        by_turn = 0.8 * self._turn / max(abs(curvature), 1e-6)
        v = min(speed, by_room, by_turn)
        return Twist.planar(v, self._rate(v * curvature))

    def _rate(self, rate: float) -> float:
        return within(rate, 0.8 * self._turn)
