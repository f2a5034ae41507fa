"""What the laser sees that the map does not know, remembered for a while."""

from __future__ import annotations

import numpy as np

from robotside.grid import Grid
from robotside.pose2 import Points

__all__ = ["Obstacles"]

CELL = 0.1
"""Things within this are one [m]."""

UNKNOWN = 0.35
"""A laser point farther than this from everything on the map is something new [m]."""

FADES = 30.0
"""How long something is remembered without being seen again [s]."""


class Obstacles:
    """Places in `map` where something stands that is not on the map."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid
        self._seen: dict[tuple[int, int], float] = {}

    def see(self, points: Points, now: float) -> None:
        """Take in one sweep's end points, in `map`."""
        fresh = points[self._grid.clearance(points) > UNKNOWN]
        for x, y in set(map(tuple, np.round(fresh / CELL).astype(int).tolist())):
            self._seen[x, y] = now

    def points(self, now: float) -> Points:
        """What is remembered, shape (n, 2) [m]."""
        self._seen = {cell: seen for cell, seen in self._seen.items() if now - seen < FADES}
        return np.array(list(self._seen), dtype=np.float64).reshape(-1, 2) * CELL

    def forget(self) -> None:
        """Start with nothing: the position was wrong, and so is all that was seen from it."""
        self._seen.clear()

    def near(self, path: Points, reach: float, now: float) -> Points:
        """The remembered places within `reach` [m] of the points of `path`."""
        known = self.points(now)
        if not len(known) or not len(path):
            return known[:0]
        gaps = np.hypot(known[:, None, 0] - path[None, :, 0], known[:, None, 1] - path[None, :, 1])
        return np.asarray(known[gaps.min(axis=1) < reach])
