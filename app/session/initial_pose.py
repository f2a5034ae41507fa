"""The pose that an operator points at on the map, as the robot's localisation takes it."""

from __future__ import annotations

import math

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.std_msgs import Header, Time

__all__ = ["initial_pose"]

POINTED_VARIANCE = (0.25, 0.25, 0.07)
"""Variance of a place pointed at by finger: x, y [m2] and yaw [rad2]."""


def initial_pose(x: float, y: float, yaw: float, stamp: float) -> PoseWithCovarianceStamped:
    """(x, y) in `map` [m] and `yaw` [rad] at the robot's time `stamp` [s]; NaN where its clock is not known."""
    covariance = [0.0] * 36
    for index, variance in zip((0, 7, 35), POINTED_VARIANCE, strict=True):
        covariance[index] = variance
    header = Header(Time.at(stamp) if math.isfinite(stamp) else Time(), "map")
    pose = Pose(Point(x, y), Quaternion.from_yaw(yaw))
    return PoseWithCovarianceStamped(header, PoseWithCovariance(pose, covariance))
