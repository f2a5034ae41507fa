"""The planned way of the robot, published as `/plan`."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from bridge.msgs.geometry_msgs import PoseStamped
from bridge.msgs.nav_msgs import Path
from bridge.msgs.std_msgs import Header, Time
from robotside.core.bus import Publish
from robotside.core.pose2 import Points, Pose2

__all__ = ["PlanPublisher"]


class PlanPublisher:
    """Publishes each plan."""

    def __init__(self, publish: Publish, now: Callable[[], float]) -> None:
        """`now` is the robot's clock [s], by which plans are stamped."""
        self._publish, self._now = publish, now

    def show(self, path: Points) -> None:
        """Publish the points of a way in `map`, none for no way."""
        header = Header(Time.at(self._now()), "map")
        poses = [PoseStamped(header, pose.to_msg()) for pose in _directed(path)]
        self._publish("/plan", Path(header, poses))


def _directed(path: Points) -> list[Pose2]:
    """The points of a path as poses that look along it."""
    if len(path) < 2:
        return []
    steps = np.diff(path, axis=0)
    yaws = np.arctan2(steps[:, 1], steps[:, 0])
    yaws = np.append(yaws, yaws[-1])
    return [Pose2(float(x), float(y), float(yaw)) for (x, y), yaw in zip(path, yaws, strict=True)]
