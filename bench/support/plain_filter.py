"""The peer of the bench of localisation: a Kalman filter over matched sweeps that takes each sweep's errors for its own."""

from __future__ import annotations

import numpy as np

from robotside.core.pose2 import Points
from robotside.localisation.scan_matching import MAX_BEAMS, MIN_FIT, Localiser

__all__ = ["PlainFilter"]


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
