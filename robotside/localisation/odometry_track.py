"""The robot's way of the last seconds, to ask where it was when a sensor measured."""

from __future__ import annotations

import bisect
import math
from collections import deque

from bridge.core.units import wrap
from robotside.core.pose2 import ORIGIN, Pose2

__all__ = ["OdometryTrack"]

MAX_AHEAD = 0.1
"""A pose is told for a moment so long after the newest odometry at most [s]: twice the time until the next."""


class OdometryTrack:
    """The last seconds of poses, to ask where the robot was when a sensor measured."""

    def __init__(self) -> None:
        self._poses: deque[tuple[float, Pose2]] = deque(maxlen=60)
        self._velocity = ORIGIN

    def add(self, stamp: float, pose: Pose2, velocity: Pose2 = ORIGIN) -> None:
        """Remember `pose` at `stamp` [s], and the `velocity` from there on, ahead and left [m/s] and turning [rad/s]; NaN for unknown."""
        self._poses.append((stamp, pose))
        self._velocity = velocity if math.isfinite(sum(velocity)) else ORIGIN

    def forget(self) -> None:
        """The remembered path was wrong."""
        self._poses.clear()

    def at(self, stamp: float) -> Pose2 | None:
        """The pose at `stamp` [s], between its neighbours, or a little after the newest one as it went on from there; else the nearest one."""
        poses = self._poses
        if not poses:
            return None
        after = bisect.bisect_left(poses, stamp, key=lambda entry: entry[0])
        if after == 0:
            return poses[0][1]
        if after == len(poses):
            newest, pose = poses[-1]
            since = min(stamp - newest, MAX_AHEAD)
            return pose.then(Pose2(*(part * since for part in self._velocity)))
        (start, a), (end, b) = poses[after - 1], poses[after]
        part = (stamp - start) / (end - start) if end > start else 0.0
        return Pose2(
            a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), wrap(a.yaw + part * wrap(b.yaw - a.yaw))
        )
