"""The peer of the bench of localisation: a Kalman filter over matched sweeps that takes each sweep's errors for its own."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from robotside.core.pose2 import Points, Pose2
from robotside.localisation.scan_matching import (
    INDEPENDENT_SHARE,
    LOSS_DISTANCE,
    MAX_BEAMS,
    MAX_FIT_DISTANCE,
    MIN_FIT,
    Localiser,
    Match,
)

__all__ = ["PlainFilter"]


HIT_SPREAD = 0.06
"""Of a sweep's end points about the map's surfaces [m], all errors taken together."""


class PlainFilter(Localiser):
    """Believes every sweep as if it knew nothing of the one before; sure by the fit of the last sweeps alone."""

    def correct(self, points: Points) -> None:
        """Lay one sweep on the map."""
        if self.pose is None or len(points) < 10:
            self._bad += self.pose is not None
            return
        match = self._fit(self.pose, points[:: max(1, len(points) // MAX_BEAMS)])
        self.fit = match.fit
        self._bad = self._bad + 1 if match.fit < MIN_FIT else 0
        if match.fit >= 0.5 * MIN_FIT:
            self.pose = match.pose
            self.covariance = np.asarray(np.linalg.inv(match.information), dtype=np.float64)

    def _fit(self, start: Pose2, points: Points) -> Match:
        prior = np.linalg.inv(self.covariance)
        pose = start
        for _ in range(6):
            gradient, information, fit = self._misfit(pose, points)
            off = np.array([pose.x - start.x, pose.y - start.y, wrap(pose.yaw - start.yaw)])
            total = information + prior
            step = np.linalg.solve(total, -(gradient + prior @ off)).tolist()
            pose = Pose2(pose.x + step[0], pose.y + step[1], wrap(pose.yaw + step[2]))
            if abs(step[0]) + abs(step[1]) < 1e-3 and abs(step[2]) < 5e-4:
                break
        return Match(pose, total, fit)

    def _misfit(self, pose: Pose2, points: Points) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
        """Gradient and Gauss-Newton information at `pose` in x, y and yaw, and how many points fit."""
        placed = pose.apply(points)
        off, gx, gy = self.field.read(placed).T
        turn = gy * (placed[:, 0] - pose.x) - gx * (placed[:, 1] - pose.y)
        jacobian = np.column_stack([gx, gy, turn])
        weight = INDEPENDENT_SHARE / HIT_SPREAD**2 / (1.0 + (off / LOSS_DISTANCE) ** 2) ** 2
        weighted = jacobian * weight[:, None]
        return weighted.T @ off, weighted.T @ jacobian, float((np.abs(off) < MAX_FIT_DISTANCE).mean())
