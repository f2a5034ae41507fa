"""A laser sweep as points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import ORIGIN, Points, Pose2
from robotside.mapping.sight import BeamSight

__all__ = ["LaserProjection"]


class LaserProjection:
    """Turns sweeps into end points, for a laser mounted at `mount` in `base_link`."""

    def __init__(self, mount: Pose2 = ORIGIN) -> None:
        self._mount = mount
        self._shape: tuple[int, float, float] | None = None
        self._beams: NDArray[np.float64] = np.empty((0, 2))

    def points(self, scan: LaserScan) -> Points:
        """Where beams ended on something, in `base_link`; beams that met nothing or are invalid are left out."""
        ranges = np.frombuffer(scan.ranges, dtype=np.float32).astype(np.float64)
        shape = len(ranges), scan.angle_min, scan.angle_increment
        if shape != self._shape:
            angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
            self._shape, self._beams = shape, np.column_stack([np.cos(angles), np.sin(angles)])
        with np.errstate(invalid="ignore"):
            hit = (ranges > scan.range_min) & (ranges < scan.range_max)
        points = self._beams[hit] * ranges[hit][:, None]
        return points if self._mount == ORIGIN else self._mount.apply(points)

    def sight(self, scan: LaserScan, pose: Pose2, doubt: float = 0.0) -> BeamSight | None:
        """What the sweep saw through from the robot's `pose`, give or take `doubt` [m]; None for a sweep in no direction.

        A beam that met nothing (+inf) is free as far as the laser reaches; one that measured nothing, or too near, is not.
        """
        ranges = np.frombuffer(scan.ranges, dtype=np.float32).astype(np.float64)
        first, step = scan.angle_min, scan.angle_increment
        if not step or not len(ranges):
            return None
        with np.errstate(invalid="ignore"):
            free = np.where(ranges > scan.range_min, np.minimum(ranges, scan.range_max), 0.0)
        if step < 0:  # mounted upside down
            first, step, free = first + step * (len(free) - 1), -step, free[::-1]
        return BeamSight(pose.then(self._mount), first, step, free, doubt)
