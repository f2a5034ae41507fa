"""The memory of obstacles that the map does not show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.sight import Sight

__all__ = ["ObstacleMemory"]

CELL_SIZE = 0.1
"""Things within this are one [m]."""

MIN_CLEARANCE = 0.35
"""A laser point farther than this from everything on the map is something new [m]."""

LIFETIME = 30.0
"""How long something is remembered that is neither seen again nor seen through [s]."""

SONAR_CLEARANCE_LIFETIME = (0.6, 8.0)
"""The same two for what is seen vaguely, as by sonars [m, s]."""

NEWEST_SHARE = 0.4
"""Of the newest sweep in where something is said to stand: one sweep errs by some centimetres."""

MAX_ASIDE = 5
"""After more sweeps than this that met something close by but nothing right there, it was the same thing seen askew."""

_HALF_SPAN = 1 << 31
"""Cells on each side of the map's origin that a key tells apart."""


class ObstacleMemory:
    """Places in `map` where something stands that is not on the map."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid
        self.cleared = 0
        """Counts each time that something remembered was forgotten: a way that was blocked may be free."""
        self._keys: NDArray[np.int64] = np.empty(0, dtype=np.int64)
        """The cells, in order."""
        self._places: Points = np.empty((0, 2))
        self._kept_off: Points = np.empty((0, 2))
        self._until: NDArray[np.float64] = np.empty(0)
        self._misses: NDArray[np.int64] = np.empty(0, dtype=np.int64)
        """Sweeps in a row that saw through."""
        self._aside: NDArray[np.int64] = np.empty(0, dtype=np.int64)
        """Sweeps in a row that met something close by and nothing right there."""

    def update(self, points: Points, now: float, *, vague: bool = False, sight: Sight | None = None) -> None:
        """Take in one sweep's end points, in `map`; `vague` when they may as well be somewhat aside.

        Where `sight` tells that the sweep saw through what is remembered, that is forgotten after a sweep or two.
        """
        lasts = SONAR_CLEARANCE_LIFETIME[1] if vague else LIFETIME
        if sight is not None:
            self._clear(sight)
        points = points[self.fresh(points, vague=vague)]
        if not len(points):
            return
        cells = np.round(points / CELL_SIZE).astype(np.int64) + _HALF_SPAN
        keys, back, counts = np.unique(
            (cells[:, 0] << 32) | cells[:, 1], return_inverse=True, return_counts=True
        )
        middles = np.column_stack([np.bincount(back, points[:, axis]) / counts for axis in (0, 1)])
        at: NDArray[np.intp] = np.asarray(np.searchsorted(self._keys, keys))
        known = np.zeros(len(keys), dtype=np.bool_)
        inside = at < len(self._keys)
        known[inside] = self._keys[at[inside]] == keys[inside]
        old, new = at[known], ~known
        self._places[old] += NEWEST_SHARE * (middles[known] - self._places[old])
        self._until[old] = np.maximum(self._until[old], now + lasts)
        self._misses[old] = self._aside[old] = 0
        if new.any():
            self._keys = np.insert(self._keys, at[new], keys[new])
            self._places = np.insert(self._places, at[new], middles[new], axis=0)
            self._until = np.insert(self._until, at[new], now + lasts)
            self._misses = np.insert(self._misses, at[new], 0)
            self._aside = np.insert(self._aside, at[new], 0)

    def fresh(self, points: Points, *, vague: bool = False) -> NDArray[np.bool_]:
        """Which `points`, in `map`, are of something that the map does not know."""
        return np.asarray(
            self._grid.clearance(points) > (SONAR_CLEARANCE_LIFETIME[0] if vague else MIN_CLEARANCE)
        )

    def points(self, now: float) -> Points:
        """What is remembered, where it was seen last, shape (n, 2) [m]."""
        if len(self._until) and self._until.min() <= now:
            self._keep(now < self._until)
        return np.array(self._places, dtype=np.float64)

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing was seen."""
        self._until = self._until + seconds

    def keep_off(self, points: Points) -> None:
        """Have ways planned round `points` too, in `map`, though nothing stands there; until the next such call."""
        self._kept_off = points

    def planned(self, now: float) -> Points:
        """What ways are planned round: what is remembered, and what is kept off."""
        return np.concatenate([self.points(now), self._kept_off])

    def forget(self) -> None:
        """Start with nothing: the position was wrong, and so is all that was seen from it."""
        self._keep(np.zeros(len(self._keys), dtype=np.bool_))

    def near(self, path: Points, reach: float, now: float) -> Points:
        """The remembered places within `reach` [m] of the points of `path`."""
        known = self.points(now)
        if not len(known) or not len(path):
            return known[:0]
        # most of what is remembered lies far from the way
        low, high = path.min(axis=0) - reach, path.max(axis=0) + reach
        known = np.asarray(known[((known >= low) & (known <= high)).all(axis=1)])
        if not len(known):
            return known
        gaps = np.hypot(known[:, None, 0] - path[None, :, 0], known[:, None, 1] - path[None, :, 1])
        return np.asarray(known[gaps.min(axis=1) < reach])

    def _clear(self, sight: Sight) -> None:
        """Count for each place the sweeps in a row that saw through it, and forget it after enough of them."""
        if not len(self._keys):
            return
        through, beside = sight.through(self._places), sight.beside(self._places)
        self._misses = np.where(through, self._misses + 1, 0)
        self._aside += beside
        gone = (self._misses >= sight.sweeps) | (self._aside > MAX_ASIDE)
        if gone.any():
            self._keep(~gone)

    def _keep(self, kept: NDArray[np.bool_]) -> None:
        self.cleared += 1
        self._keys, self._places = self._keys[kept], self._places[kept]
        self._until, self._misses, self._aside = self._until[kept], self._misses[kept], self._aside[kept]
