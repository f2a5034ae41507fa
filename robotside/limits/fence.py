"""Where the robot may be: areas it stays in and areas it never enters, as one border with two sides."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from robotside.core.config import Ring
from robotside.core.pose2 import Points
from robotside.mapping.occupancy_grid import Grid

__all__ = ["Border", "Fence"]

_ASIDE = 1e-6
"""How far beside a piece of an edge it is asked whether one may be there [m]."""

_Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Border:
    """Straight pieces of a border; it does not know its sides."""

    starts: _Array
    """Shape (pieces, 2) [m]."""
    ends: _Array

    def distance(self, points: Points) -> _Array:
        """From each of `points`, shape (n, 2), to the nearest piece [m]; infinite without one."""
        if not len(self.starts):
            return np.full(len(points), math.inf)
        return np.asarray(np.sqrt(self.squares(points).min(axis=1)))

    def foot(self, point: Points) -> tuple[float, float] | None:
        """The place on it that is nearest to `point`, shape (1, 2); None without a piece."""
        if not len(self.starts):
            return None
        x, y = self._feet(point)[0, int(self.squares(point)[0].argmin())]
        return float(x), float(y)

    def squares(self, points: Points) -> _Array:
        """Squared distances, shape (points, pieces) [m2]."""
        return np.asarray(((points[:, None, :] - self._feet(points)) ** 2).sum(axis=2))

    def sampled(self, step: float) -> Points:
        """Places on it, at most `step` [m] apart, shape (n, 2)."""
        places = [np.empty((0, 2))]
        for start, end in zip(self.starts, self.ends, strict=True):
            count = math.ceil(math.hypot(*(end - start)) / step) + 1
            places.append(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))
        return np.concatenate(places)

    def _feet(self, points: Points) -> _Array:
        """The place on each piece that is nearest to each of `points`, shape (points, pieces, 2)."""
        along = self.ends - self.starts
        length = np.maximum((along**2).sum(axis=1), 1e-18)
        part = ((points[:, None, :] - self.starts) * along).sum(axis=2) / length
        return np.asarray(self.starts + np.clip(part, 0.0, 1.0)[:, :, None] * along)


class Fence:
    """Areas in `map`; areas of one kind that touch or overlap are one, with no border between them."""

    def __init__(self, keep_in: Sequence[Ring] = (), keep_out: Sequence[Ring] = ()) -> None:
        self._keep_in = [_closed(ring) for ring in keep_in]
        self._keep_out = [_closed(ring) for ring in keep_out]
        self._border = self._pieces()

    def __bool__(self) -> bool:
        """There is a place where the robot may not be."""
        return bool(self._keep_in or self._keep_out)

    def allows(self, points: Points) -> NDArray[np.bool_]:
        """The robot's centre may be at each of `points`, shape (n, 2)."""
        allowed = np.full(len(points), not self._keep_in)
        for ring in self._keep_in:
            allowed |= _inside(ring, points)
        for ring in self._keep_out:
            allowed &= ~_inside(ring, points)
        return allowed

    def clearance(self, points: Points) -> _Array:
        """From each of `points`, shape (n, 2), to the border [m]; negative where one may not be, infinite without one."""
        far = self._border.distance(points)
        return np.where(self.allows(points), far, -far)

    def around(self, x: float, y: float, reach: float) -> Border:
        """The part of the border that is within `reach` [m] of a place."""
        near = self._border.squares(np.array([[x, y]]))[0] <= reach * reach
        return Border(self._border.starts[near], self._border.ends[near])

    def inward(self, x: float, y: float) -> tuple[float, float]:
        """The direction in which `clearance` grows fastest, of length 1; (0, 0) on the border and without one."""
        here = np.array([[x, y]])
        foot = self._border.foot(here)
        if foot is None:
            return 0.0, 0.0
        dx, dy = x - foot[0], y - foot[1]
        far = math.hypot(dx, dy) * (1.0 if self.allows(here)[0] else -1.0)
        return (dx / far, dy / far) if far else (0.0, 0.0)

    def marked(self, grid: Grid, margin: float = 0.0) -> Grid:
        """The same map with every cell occupied that is forbidden, on the border or within `margin` [m] of either."""
        if not self:
            return grid
        barred = replace(grid, occupied=~self._raster(grid)).marked(self._border.sampled(grid.resolution / 2))
        return replace(grid, occupied=grid.occupied | (barred.distance < margin))

    def _raster(self, grid: Grid) -> NDArray[np.bool_]:
        """Whether the robot may be at the centre of each cell, row by row: far quicker than cell by cell."""
        rows, columns = grid.occupied.shape
        x = np.asarray(grid.x + (np.arange(columns) + 0.5) * grid.resolution, dtype=np.float64)
        allowed = np.full((rows, columns), not self._keep_in)
        for row in range(rows):
            y = grid.y + (row + 0.5) * grid.resolution
            for ring in self._keep_in:
                allowed[row] |= _inside_row(ring, x, y)
            for ring in self._keep_out:
                allowed[row] &= ~_inside_row(ring, x, y)
        return allowed

    def _pieces(self) -> Border:
        """The pieces of all edges on whose two sides different things hold."""
        rings = [*self._keep_in, *self._keep_out]
        if not rings:
            return Border(np.empty((0, 2)), np.empty((0, 2)))
        starts = np.concatenate([ring[:-1] for ring in rings])
        ends = np.concatenate([ring[1:] for ring in rings])
        pieces = [_cut(start, end, starts, ends) for start, end in zip(starts, ends, strict=True)]
        first = np.concatenate([piece[:-1] for piece in pieces])
        last = np.concatenate([piece[1:] for piece in pieces])
        along = last - first
        aside = np.column_stack([-along[:, 1], along[:, 0]])
        aside *= _ASIDE / np.maximum(np.hypot(*along.T), 1e-12)[:, None]
        middle = (first + last) / 2
        real = self.allows(middle + aside) != self.allows(middle - aside)
        return Border(first[real], last[real])


def _closed(ring: Ring) -> _Array:
    """The corners with the first one repeated at the end."""
    return np.array([*ring, ring[0]], dtype=np.float64)


def _inside_row(ring: _Array, x: _Array, y: float) -> NDArray[np.bool_]:
    """Whether each place of a row at height `y` lies within `ring`."""
    (ax, ay), (bx, by) = ring[:-1].T, ring[1:].T
    spans = (ay > y) != (by > y)
    if not spans.any():
        return np.zeros(len(x), dtype=np.bool_)
    meets = ax[spans] + (y - ay[spans]) / (by[spans] - ay[spans]) * (bx[spans] - ax[spans])
    return np.asarray(np.searchsorted(np.sort(meets), x) % 2 == 1)


def _inside(ring: _Array, points: Points) -> NDArray[np.bool_]:
    """Whether each point lies within `ring`: a line to the right crosses it an odd number of times."""
    x, y = points[:, 0, None], points[:, 1, None]
    (ax, ay), (bx, by) = ring[:-1].T, ring[1:].T
    spans = (ay > y) != (by > y)
    rise = np.where(by == ay, 1.0, by - ay)
    with np.errstate(over="ignore", invalid="ignore"):  # of sides as good as level, which span nothing
        crosses = spans & (x < ax + (y - ay) / rise * (bx - ax))
    return np.asarray(crosses.sum(axis=1) % 2 == 1)


def _cut(start: _Array, end: _Array, starts: _Array, ends: _Array) -> _Array:
    """The edge from `start` to `end` as corners of pieces: cut wherever one of the edges meets it."""
    along = end - start
    other = ends - starts
    cross = along[0] * other[:, 1] - along[1] * other[:, 0]
    apart = starts - start
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        here = (apart[:, 0] * other[:, 1] - apart[:, 1] * other[:, 0]) / cross
        there = (apart[:, 0] * along[1] - apart[:, 1] * along[0]) / cross
    # an edge in the same line meets it nowhere in particular, but the next one of its ring does at the corner
    meets = (there > -_ASIDE) & (there < 1.0 + _ASIDE) & np.isfinite(here)
    cuts = np.unique(np.concatenate(([0.0, 1.0], here[meets & (here > 0.0) & (here < 1.0)])))
    return np.asarray(start + cuts[:, None] * along)
