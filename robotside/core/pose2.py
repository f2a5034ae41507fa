"""Poses in the plane: position and yaw."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Point, Pose, Quaternion

__all__ = ["ORIGIN", "Points", "Pose2"]

Points = NDArray[np.float64]
"""Places in the plane, shape (n, 2) [m]."""


class Pose2(NamedTuple):
    """A pose in the plane, or the transform from the frame that it describes to the frame it is given in."""

    x: float
    """[m]"""
    y: float
    """[m]"""
    yaw: float
    """[rad], 0 along x, anticlockwise."""

    def then(self, other: Pose2) -> Pose2:
        """`other`, given in this pose's own frame, in the frame that this pose is given in."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return Pose2(
            self.x + c * other.x - s * other.y,
            self.y + s * other.x + c * other.y,
            wrap(self.yaw + other.yaw),
        )

    def inverse(self) -> Pose2:
        """The outer frame as seen from this pose."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return Pose2(-c * self.x - s * self.y, s * self.x - c * self.y, wrap(-self.yaw))

    def since(self, earlier: Pose2) -> Pose2:
        """The motion from `earlier` to this pose, in the frame of `earlier`."""
        return earlier.inverse().then(self)

    def apply(self, points: Points) -> Points:
        """`points` of this pose's own frame in the outer frame."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        out = np.empty_like(points)
        out[:, 0] = self.x + c * points[:, 0] - s * points[:, 1]
        out[:, 1] = self.y + s * points[:, 0] + c * points[:, 1]
        return out

    def distance(self, x: float, y: float) -> float:
        """To a point of the outer frame [m]."""
        return math.hypot(x - self.x, y - self.y)

    def bearing(self, x: float, y: float) -> float:
        """Direction of a point of the outer frame as seen from here [rad], 0 ahead, positive to the left."""
        return wrap(math.atan2(y - self.y, x - self.x) - self.yaw)

    def to_msg(self) -> Pose:
        """The same pose as a message, on the ground."""
        return Pose(Point(self.x, self.y, 0.0), Quaternion.from_yaw(self.yaw))

    @classmethod
    def from_msg(cls, pose: Pose) -> Pose2:
        """Seen from above."""
        return cls(pose.position.x, pose.position.y, pose.orientation.yaw)


ORIGIN = Pose2(0.0, 0.0, 0.0)
"""The frame's own pose."""
