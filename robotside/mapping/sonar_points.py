"""A ring of sonars as points: an echo gives the distance within its cone, but not the direction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.pilothouse_msgs import SonarRing
from robotside.core.pose2 import Points, Pose2
from robotside.mapping.sight import ConeSight

__all__ = ["MAX_OBSTACLE_RANGE", "SonarProjection"]

MAX_OBSTACLE_RANGE = 1.5
"""Beyond this a cone is too wide to say where something stands [m]."""

TOUCHING_SHARE = 0.7
"""An obstacle too close to be measured is assumed at this part of the shortest range."""

MAX_ECHO_RANGE = 4.0
"""Beyond this an echo says nothing of where the robot is [m]."""

CONE_PLACES = np.array([-0.35, 0.0, 0.35])
"""Places across a cone that are taken for its end, in widths; not its very edges, or no door were wide enough."""

ARC_PLACES = np.linspace(-0.5, 0.5, 7)
"""Places on the end of a cone that may have given the echo, in widths."""


class SonarProjection:
    """Turns rings of distances into points."""

    def points(self, ring: SonarRing) -> Points:
        """Where something may stand, in `base_link`: across the end of every cone that met something near.

        What is too close to be measured stands right before its sonar.
        """
        return _ends(ring, -np.inf, MAX_OBSTACLE_RANGE, CONE_PLACES).reshape(-1, 2)

    def arcs(self, ring: SonarRing) -> NDArray[np.float64]:
        """The ends of all cones that measured something not too far away, shape (echoes, places, 2) in `base_link` [m]."""
        return _ends(ring, 0.0, MAX_ECHO_RANGE, ARC_PLACES)

    def sight(self, ring: SonarRing, pose: Pose2, doubt: float = 0.0) -> ConeSight:
        """What the ring saw through from the robot's `pose`, give or take `doubt` [m].

        A cone that met nothing (+inf) is free as far as a sonar reaches; one that measured nothing, or too near, is not.
        """
        ranges = np.asarray(ring.ranges, dtype=np.float64)
        bearings = np.asarray(ring.bearings, dtype=np.float64)[: len(ranges)]
        with np.errstate(invalid="ignore"):
            free = np.where(ranges >= ring.range_min, np.minimum(ranges, ring.range_max), 0.0)
        return ConeSight(pose, bearings, ring.field_of_view, ring.radius, free[: len(bearings)], doubt)


def _ends(ring: SonarRing, least: float, most: float, across: Points) -> NDArray[np.float64]:
    """Places across the ends of the cones whose ranges are in between, shape (cones, places, 2)."""
    ranges = np.asarray(ring.ranges, dtype=np.float64)
    bearings = np.asarray(ring.bearings, dtype=np.float64)[: len(ranges)]
    ranges = ranges[: len(bearings)]
    met = (ranges >= least) & (ranges < min(ring.range_max, most))  # not NaN
    measured = np.maximum(ranges[met], TOUCHING_SHARE * ring.range_min)
    reach = (ring.radius + measured)[:, None]
    angles = bearings[met][:, None] + ring.field_of_view * across
    return np.stack([reach * np.cos(angles), reach * np.sin(angles)], axis=-1)
