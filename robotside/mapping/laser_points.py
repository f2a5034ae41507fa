"""A laser sweep as points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import ORIGIN, Points, Pose2

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
