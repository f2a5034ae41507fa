"""The stopping path: the places on the way of a command, braking included, for a kind of robot."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robotside.core.pose2 import Points, Pose2
from robotside.kinds.vehicle_kind import Handling

__all__ = ["REACTION_TIME", "REST", "PlanarVelocity", "reach", "track"]

REACTION_TIME = 0.15
"""From a command until the next one takes effect [s]: a period of odometry, and the drive's own lag."""

MAX_SPACING = 0.08
"""Between two places that are looked at, at most [m]."""
_MAX_SAMPLES = 240


class PlanarVelocity(NamedTuple):
    """Velocities in `base_link`."""

    x: float
    """Forward [m/s]."""
    y: float
    """To the left [m/s]."""
    turn: float
    """Anticlockwise [rad/s]."""

    @property
    def speed(self) -> float:
        """[m/s]"""
        return math.hypot(self.x, self.y)

    def scaled(self, part: float, turn: float = 1.0) -> PlanarVelocity:
        """With `part` of the speed and another of the turn rate."""
        return PlanarVelocity(part * self.x, part * self.y, turn * self.turn)


REST = PlanarVelocity(0.0, 0.0, 0.0)


def reach(start: PlanarVelocity, command: PlanarVelocity, handling: Handling) -> float:
    """How far `track` gets at most [m]."""
    fastest = max(start.speed, command.speed)
    return fastest * REACTION_TIME + fastest * fastest / (2 * handling.braking)


def track(
    pose: Pose2, start: PlanarVelocity, command: PlanarVelocity, handling: Handling, *, swings: bool = False
) -> Points:
    """Places on the way of a robot that moves as `start`, obeys `command` for REACTION_TIME and then brakes, (n, 2) [m].

    Its speed changes as `handling` says. Its turn rate does at once, or when it `swings` no faster than `handling` says;
    the wheels of one that steers are then left as they are while it brakes.
    """
    braking = handling.braking
    change = np.array([command.x - start.x, command.y - start.y])
    leap = max(math.hypot(*change), 1e-9)
    then = np.array([start.x, start.y]) + change * min(1.0, braking * REACTION_TIME / leap)
    left = max(math.hypot(*then), 1e-9)
    time = REACTION_TIME + left / braking
    count = min(_MAX_SAMPLES, max(4, math.ceil(max(start.speed, left) * time / MAX_SPACING)))
    step = time / count
    at = np.asarray((np.arange(count) + 0.5) * step, dtype=np.float64)
    obeying = (at < REACTION_TIME)[:, None]
    towards = np.minimum(1.0, braking * at / leap)[:, None] * change
    fading = np.maximum(0.0, 1.0 - braking * (at - REACTION_TIME) / left)[:, None]
    slowing = then * np.minimum(1.0, fading)
    velocity = np.where(obeying, np.array([start.x, start.y], dtype=np.float64) + towards, slowing)
    turn = _turning(start, command, handling, at, velocity, swings)
    yaw = pose.yaw + (np.cumsum(turn) - turn / 2) * step
    c, s = np.cos(yaw), np.sin(yaw)
    x = pose.x + np.cumsum(c * velocity[:, 0] - s * velocity[:, 1]) * step
    y = pose.y + np.cumsum(s * velocity[:, 0] + c * velocity[:, 1]) * step
    return np.column_stack([x, y])


def _turning(
    start: PlanarVelocity,
    command: PlanarVelocity,
    handling: Handling,
    at: Points,
    velocity: Points,
    swings: bool,
) -> Points:
    """The turn rate at each moment [rad/s]."""
    if handling.steers:
        told = command if command.speed > 1e-3 else start
        bend = told.turn / max(told.speed, 1e-3) * np.where(swings | (at < REACTION_TIME), 1.0, 0.0)
        return np.asarray(np.hypot(*velocity.T) * bend)
    if not swings:
        return np.where(at < REACTION_TIME, command.turn, 0.0)
    rate = handling.turning
    change = command.turn - start.turn
    then = start.turn + math.copysign(min(abs(change), rate * REACTION_TIME), change)
    obeying = start.turn + math.copysign(1.0, change) * np.minimum(abs(change), rate * at)
    fading = math.copysign(1.0, then) * np.maximum(0.0, abs(then) - rate * (at - REACTION_TIME))
    return np.where(at < REACTION_TIME, obeying, fading)
