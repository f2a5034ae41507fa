"""Pure pursuit: steering and speed along a path."""

from __future__ import annotations

import math

import numpy as np

from robotside.core.pose2 import Points, Pose2
from robotside.kinds.vehicle_kind import PursuitParameters

__all__ = ["GOAL_TOLERANCE", "MIN_SPEED", "PathFollower"]

ON_WHEELS = PursuitParameters()
"""Of one that turns where it stands."""
GOAL_TOLERANCE, MIN_SPEED = ON_WHEELS.goal_tolerance, ON_WHEELS.min_speed
"""Its circle of arrival [m] and its least speed on the way [m/s]."""


class PathFollower:
    """Steers along one path."""

    def __init__(
        self,
        path: Points,
        *,
        cruise: float,
        final_speed: float = 0.0,
        parameters: PursuitParameters = ON_WHEELS,
    ) -> None:
        self.path, self._parameters = path, parameters
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
        passed = distance < self._parameters.passed_tolerance and distance > self._nearest_goal + 0.02
        self._nearest_goal = min(self._nearest_goal, distance)
        return distance < self._parameters.goal_tolerance or passed

    def aim(self, pose: Pose2, speed: float) -> tuple[float, float]:
        """Distance [m] and bearing [rad] of the point of the path to steer for, moving at `speed` [m/s]."""
        self._advance(pose)
        reach = self._parameters.lookahead + self._parameters.lookahead_time * abs(speed)
        ahead = self.ahead
        beyond = np.flatnonzero(np.hypot(ahead[:, 0] - pose.x, ahead[:, 1] - pose.y) >= reach)
        x, y = (ahead[beyond[0]] if len(beyond) else self.path[-1]).tolist()
        return pose.distance(x, y), pose.bearing(x, y)

    def speed(self, pose: Pose2, bearing: float, distance: float) -> float:
        """How fast to go [m/s], steering for a point at `bearing` and `distance`."""
        parameters = self._parameters
        bend = abs(2.0 * math.sin(bearing) / max(distance, 0.1))
        by_bend = math.sqrt(parameters.lateral_acceleration / bend) if bend > 0.1 else math.inf
        left = max(0.0, self.remaining(pose) - 0.5 * parameters.goal_tolerance)
        by_goal = math.sqrt(self._final**2 + 2.0 * parameters.deceleration * left)
        return max(parameters.min_speed, min(self._cruise, by_bend, by_goal))

    def _advance(self, pose: Pose2) -> None:
        while True:  # a way that was long looked for begins some way back
            window = self.path[self._index : self._index + 20]
            on = int(np.hypot(window[:, 0] - pose.x, window[:, 1] - pose.y).argmin())
            if not on:
                return
            self._index += on
