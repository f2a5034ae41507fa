"""The rings of sonars that are laid on the map together: one alone has too few echoes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Pose2

__all__ = ["SonarRings"]

SONAR_RINGS = 4
"""Of sonars that are laid on the map together."""


class SonarRings:
    """Keeps the last rings until there are enough of them, where odometry has them."""

    def __init__(self) -> None:
        self._rings: list[NDArray[np.float64]] = []

    def clear(self) -> None:
        """Begin anew."""
        self._rings.clear()

    def add(self, arcs: NDArray[np.float64], odom: Pose2) -> NDArray[np.float64] | None:
        """Keep a ring, measured with the odometry at `odom`: ends of cones in `base_link`, shape (echoes, places, 2) [m].

        Returns all rings that were kept in today's `base_link`, once there are enough; None before.
        """
        self._rings.append(odom.apply(arcs.reshape(-1, 2)).reshape(arcs.shape))
        if len(self._rings) < SONAR_RINGS:
            return None
        ends = np.concatenate(self._rings)
        self.clear()
        return odom.inverse().apply(ends.reshape(-1, 2)).reshape(ends.shape)
