"""What an agent sees: the newest measurements of a robot as arrays of fixed shapes."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from bridge.msgs import Msg
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo, SonarRing
from bridge.msgs.sensor_msgs import LaserScan

__all__ = ["Measurements"]

SPARE = 2.0
"""Velocities are bounded by so many times the robot's limits: it may be pushed, or drift."""
RANGES = ("/scan", "/sonar")
MIN_SPEED = 0.5
"""Bounds of velocities are at least those of a robot with this limit [m/s, rad/s]."""

Array = NDArray[np.float32]


class Measurements:
    """The newest of each sensor that an agent sees; before the first one all are zero, and nothing is near."""

    def __init__(self, info: RobotInfo, messages: Iterable[tuple[str, Msg]]) -> None:
        """`messages` are the first ones of the robot that `info` describes, one of each sensor."""
        self.velocity: Array = np.zeros(4, dtype=np.float32)
        """Ahead, left, up [m/s] and turning left [rad/s], in `base_link`, by its odometry."""
        self.ranges: Array = np.zeros(0, dtype=np.float32)
        """Distances by its laser or its sonars, in the order of its beams [m]; the farthest that it measures for nothing; empty without either."""
        self._farthest = 0.0
        speed, turn = max(info.max_speed, MIN_SPEED), max(info.max_yaw_rate, MIN_SPEED)
        self._fastest = SPARE * np.array([speed, speed, max(info.max_climb, speed), turn], dtype=np.float32)
        self.take(messages)

    def take(self, messages: Iterable[tuple[str, Msg]]) -> None:
        """Go on by `messages`, oldest first; topics that an agent does not see change nothing."""
        for topic, message in messages:
            if topic == "/odom" and isinstance(message, Odometry):
                twist = message.twist.twist
                moves = (twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z)
                self.velocity = np.clip(np.array(moves, dtype=np.float32), -self._fastest, self._fastest)
            elif topic in RANGES and isinstance(message, LaserScan | SonarRing):
                self._see(np.asarray(message.ranges, dtype=np.float32), message.range_max)

    def spaces(self) -> dict[str, spaces.Space[Any]]:
        """The spaces of what is here."""
        found: dict[str, spaces.Space[Any]] = {"velocity": spaces.Box(-self._fastest, self._fastest)}
        if self.ranges.size:
            found["ranges"] = spaces.Box(0.0, self._farthest, self.ranges.shape, np.float32)
        return found

    def seen(self) -> dict[str, Array]:
        """Copies of all of it, by the names of `spaces`."""
        found = {"velocity": self.velocity.copy()}
        if self.ranges.size:
            found["ranges"] = self.ranges.copy()
        return found

    def _see(self, ranges: Array, farthest: float) -> None:
        """Infinity is nothing, minus infinity something that touches it, and NaN no echo: REP 117."""
        self._farthest = farthest
        self.ranges = np.clip(np.nan_to_num(ranges, nan=farthest, posinf=farthest, neginf=0.0), 0.0, farthest)
