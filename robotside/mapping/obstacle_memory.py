"""The memory of obstacles that the map does not show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points
from robotside.mapping.occupancy_grid import Grid

__all__ = ["ObstacleMemory"]

CELL_SIZE = 0.1
"""Things within this are one [m]."""

MIN_CLEARANCE = 0.35
"""A laser point farther than this from everything on the map is something new [m]."""

LIFETIME = 30.0
"""How long something is remembered without being seen again [s]."""

SONAR_CLEARANCE_LIFETIME = (0.6, 8.0)
"""The same two for what is seen vaguely, as by sonars [m, s]."""


class ObstacleMemory:
    """Places in `map` where something stands that is not on the map."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid
        self._until: dict[tuple[int, int], float] = {}

    def update(self, points: Points, now: float, *, vague: bool = False) -> None:
        """Take in one sweep's end points, in `map`; `vague` when they may as well be somewhat aside."""
        lasts, fresh = SONAR_CLEARANCE_LIFETIME[1] if vague else LIFETIME, self.fresh(points, vague=vague)
        for x, y in set(map(tuple, np.round(points[fresh] / CELL_SIZE).astype(int).tolist())):
            self._until[x, y] = max(now + lasts, self._until.get((x, y), now))

    def fresh(self, points: Points, *, vague: bool = False) -> NDArray[np.bool_]:
        """Which `points`, in `map`, are of something that the map does not know."""
        return np.asarray(
            self._grid.clearance(points) > (SONAR_CLEARANCE_LIFETIME[0] if vague else MIN_CLEARANCE)
        )

    def points(self, now: float) -> Points:
        """What is remembered, shape (n, 2) [m]."""
        self._until = {cell: until for cell, until in self._until.items() if now < until}
        return np.array(list(self._until), dtype=np.float64).reshape(-1, 2) * CELL_SIZE

    def forget(self) -> None:
        """Start with nothing: the position was wrong, and so is all that was seen from it."""
        self._until.clear()

    def near(self, path: Points, reach: float, now: float) -> Points:
        """The remembered places within `reach` [m] of the points of `path`."""
        known = self.points(now)
        if not len(known) or not len(path):
            return known[:0]
        gaps = np.hypot(known[:, None, 0] - path[None, :, 0], known[:, None, 1] - path[None, :, 1])
        return np.asarray(known[gaps.min(axis=1) < reach])
