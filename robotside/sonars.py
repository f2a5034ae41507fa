"""A ring of sonars as points: each tells how far the nearest thing in its cone is, and not where in the cone."""

from __future__ import annotations

import numpy as np

from bridge.msgs.pilothouse_msgs import SonarRing
from robotside.pose2 import Points

__all__ = ["NEAR", "Sonars"]

NEAR = 1.5
"""Beyond this a cone is too wide to say where something stands [m]."""

EDGES = np.array([-0.35, 0.0, 0.35])
"""Places across a cone that are taken for its end, in widths; not its very edges, or no door were wide enough."""


class Sonars:
    """Turns rings of distances into points."""

    def points(self, ring: SonarRing) -> Points:
        """Where something may stand, in `base_link`: across the end of every cone that met something near.

        What is too close to be measured stands right before its sonar.
        """
        ranges = np.asarray(ring.ranges, dtype=np.float64)
        bearings = np.asarray(ring.bearings, dtype=np.float64)[: len(ranges)]
        ranges = ranges[: len(bearings)]
        met = ranges < min(ring.range_max, NEAR)  # not NaN
        reach = ring.radius + np.maximum(ranges[met], ring.range_min)
        angles = bearings[met][:, None] + ring.field_of_view * EDGES
        return np.column_stack(
            [(reach[:, None] * np.cos(angles)).ravel(), (reach[:, None] * np.sin(angles)).ravel()]
        )
