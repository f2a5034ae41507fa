"""Following a path: where to steer and how fast, by pure pursuit."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robotside.core.pose2 import Points, Pose2

__all__ = ["ARRIVED", "CREEP", "Follower", "Manner"]

ARRIVED = 0.1
"""A goal is reached within this distance [m]; the rest up to the promised 0.3 m is for the position's own error."""

CREEP = 0.12
"""Least speed on the way [m/s]."""


@dataclass(frozen=True, slots=True)
class Manner:
    """How a kind of robot follows a path; as it stands here, one that turns where it stands."""

    arrived: float = ARRIVED
    """A goal is reached within this distance [m]."""
    missed: float = 0.22
    """A goal that gets farther away again within this distance is passed [m]."""
    lookahead: float = 0.5
    """Distance of the point steered for at rest [m]; grows with the speed."""
    lookahead_time: float = 0.6
    """[s]"""
    slowdown: float = 0.5
    """Deceleration planned for [m/s2]."""
    creep: float = CREEP
    """Least speed on the way [m/s]."""
    sideways: float = 0.5
    """Sideways acceleration allowed in a bend [m/s2]."""


ON_WHEELS = Manner()


class Follower:
    """Steers along one path."""

    def __init__(
        self, path: Points, *, cruise: float, final_speed: float = 0.0, manner: Manner = ON_WHEELS
    ) -> None:
        self.path, self._manner = path, manner
        steps = np.hypot(*np.diff(path, axis=0).T)
        self._left = np.concatenate((np.cumsum(steps[::-1])[::-1], [0.0]))
        self._cruise, self._final = cruise, final_speed
        self._index = 0
        self._nearest_goal = math.inf

    @property
    def length(self) -> float:
        """Of the whole path [m]."""
        return float(self._left[0])

    @property
    def ahead(self) -> Points:
        """What is left of the path, from beside the robot on."""
        return self.path[self._index :]

    def remaining(self, pose: Pose2) -> float:
        """Along the path to its end [m]."""
        x, y = self.path[self._index].tolist()
        return float(self._left[self._index]) + pose.distance(x, y)

    def arrived(self, pose: Pose2) -> bool:
        """The end of the path is reached, or was passed closely."""
        distance = pose.distance(*self.path[-1].tolist())
        passed = distance < self._manner.missed and distance > self._nearest_goal + 0.02
        self._nearest_goal = min(self._nearest_goal, distance)
        return distance < self._manner.arrived or passed

    def aim(self, pose: Pose2, speed: float) -> tuple[float, float]:
        """Distance [m] and bearing [rad] of the point of the path to steer for, moving at `speed` [m/s]."""
        self._advance(pose)
        reach = self._manner.lookahead + self._manner.lookahead_time * abs(speed)
        ahead = self.ahead
        beyond = np.flatnonzero(np.hypot(ahead[:, 0] - pose.x, ahead[:, 1] - pose.y) >= reach)
        x, y = (ahead[beyond[0]] if len(beyond) else self.path[-1]).tolist()
        return pose.distance(x, y), pose.bearing(x, y)

    def speed(self, pose: Pose2, bearing: float, distance: float) -> float:
        """How fast to go [m/s], steering for a point at `bearing` and `distance`."""
        manner = self._manner
        bend = abs(2.0 * math.sin(bearing) / max(distance, 0.1))
        by_bend = math.sqrt(manner.sideways / bend) if bend > 0.1 else math.inf
        left = max(0.0, self.remaining(pose) - 0.5 * manner.arrived)
        by_goal = math.sqrt(self._final**2 + 2.0 * manner.slowdown * left)
        return max(manner.creep, min(self._cruise, by_bend, by_goal))

    def _advance(self, pose: Pose2) -> None:
        while True:  # a way that was long looked for begins some way back
            window = self.path[self._index : self._index + 20]
            on = int(np.hypot(window[:, 0] - pose.x, window[:, 1] - pose.y).argmin())
            if not on:
                return
            self._index += on
