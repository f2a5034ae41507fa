"""The geometry of a robot's fence: the areas that it stays in and those that it never enters, and the border of both.

The robot side keeps the robot to it and the handheld draws it, by the same arithmetic. The only module of `bridge` that
needs numpy.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["Border", "FenceGeometry", "Points", "Ring", "crosses_row"]

Points: TypeAlias = NDArray[np.float64]
"""Places in `map`, shape (n, 2) [m]."""
Ring: TypeAlias = Sequence[tuple[float, float]] | Points
"""Corners of an area [m], the first one not repeated."""

_ASIDE = 1e-6
"""Distance beside a piece of an edge at which its two sides are compared [m]."""


@dataclass(frozen=True, slots=True)
class Border:
    """Straight pieces of a border."""

    starts: Points
    """Shape (pieces, 2) [m]."""
    ends: Points

    def distance(self, points: Points) -> Points:
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

    def squares(self, points: Points) -> Points:
        """Squared distances, shape (points, pieces) [m2]."""
        return np.asarray(((points[:, None, :] - self._feet(points)) ** 2).sum(axis=2))

    def sampled(self, step: float) -> Points:
        """Places on it, at most `step` [m] apart, shape (n, 2)."""
        places = [np.empty((0, 2))]
        for start, end in zip(self.starts, self.ends, strict=True):
            count = math.ceil(math.hypot(*(end - start)) / step) + 1
            places.append(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))
        return np.concatenate(places)

    def _feet(self, points: Points) -> Points:
        """The place on each piece that is nearest to each of `points`, shape (points, pieces, 2)."""
        along = self.ends - self.starts
        length = np.maximum((along**2).sum(axis=1), 1e-18)
        part = ((points[:, None, :] - self.starts) * along).sum(axis=2) / length
        return np.asarray(self.starts + np.clip(part, 0.0, 1.0)[:, :, None] * along)


@dataclass(frozen=True, slots=True)
class _Pieces:
    """The pieces of all edges that are a border, as their rings run."""

    border: Border
    inner: NDArray[np.bool_]
    """It is of an area to stay in."""
    left: NDArray[np.bool_]
    """The robot's ground is on its left, not on its right."""


class FenceGeometry:
    """Areas in `map`; areas of one kind that touch or overlap are one, with no border between them."""

    def __init__(self, keep_in: Sequence[Ring] = (), keep_out: Sequence[Ring] = ()) -> None:
        """Each ring has at least three finite corners."""
        self.keep_in: list[Points] = [np.asarray(ring, dtype=np.float64) for ring in keep_in]
        """What it stays in; empty for everywhere."""
        self.keep_out: list[Points] = [np.asarray(ring, dtype=np.float64) for ring in keep_out]
        """What it never enters."""
        self._pieces = self._split()
        self.border: Border = self._pieces.border
        """Of the ground on which the robot's centre may be."""

    def __bool__(self) -> bool:
        """There is a place where the robot may not be."""
        return bool(self.keep_in or self.keep_out)

    @cached_property
    def edge(self) -> Border:
        """The border of what it stays in, with the robot's ground on the left of each piece."""
        return self._turned(self._pieces.inner)

    @cached_property
    def holes(self) -> Border:
        """The border of what it never enters, likewise."""
        return self._turned(~self._pieces.inner)

    def allows(self, points: Points) -> NDArray[np.bool_]:
        """Whether the robot's centre may be at each of `points`, shape (n, 2)."""
        allowed = np.full(len(points), not self.keep_in)
        for ring in self.keep_in:
            allowed |= _inside(ring, points)
        for ring in self.keep_out:
            allowed &= ~_inside(ring, points)
        return allowed

    def clearance(self, points: Points) -> Points:
        """From each of `points`, shape (n, 2), to the border [m]; negative where one may not be, infinite without one."""
        far = self.border.distance(points)
        return np.where(self.allows(points), far, -far)

    def around(self, x: float, y: float, reach: float) -> Border:
        """The part of the border that is within `reach` [m] of a place."""
        near = self.border.squares(np.array([[x, y]]))[0] <= reach * reach
        return Border(self.border.starts[near], self.border.ends[near])

    def inward(self, x: float, y: float) -> tuple[float, float]:
        """The direction in which `clearance` grows fastest, of length 1; (0, 0) on the border and without one."""
        here = np.array([[x, y]])
        foot = self.border.foot(here)
        if foot is None:
            return 0.0, 0.0
        dx, dy = x - foot[0], y - foot[1]
        far = math.hypot(dx, dy) * (1.0 if self.allows(here)[0] else -1.0)
        return (dx / far, dy / far) if far else (0.0, 0.0)

    def _turned(self, which: NDArray[np.bool_]) -> Border:
        starts, ends = self.border.starts[which], self.border.ends[which]
        left = self._pieces.left[which, None]
        return Border(np.where(left, starts, ends), np.where(left, ends, starts))

    def _split(self) -> _Pieces:
        """The pieces of all edges on whose two sides different things hold."""
        rings = [*self.keep_in, *self.keep_out]
        if not rings:
            none, nothing = np.empty((0, 2)), np.empty(0, dtype=np.bool_)
            return _Pieces(Border(none, none), nothing, nothing)
        starts = np.concatenate(rings)
        ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
        edges_inside = sum(map(len, self.keep_in))
        pieces = [_cut(start, end, starts, ends) for start, end in zip(starts, ends, strict=True)]
        first = np.concatenate([piece[:-1] for piece in pieces])
        last = np.concatenate([piece[1:] for piece in pieces])
        inner = np.repeat(np.arange(len(pieces)) < edges_inside, [len(piece) - 1 for piece in pieces])
        along = last - first
        aside = np.column_stack([-along[:, 1], along[:, 0]])
        aside *= _ASIDE / np.maximum(np.hypot(*along.T), 1e-12)[:, None]
        middle = (first + last) / 2
        left, right = self.allows(middle + aside), self.allows(middle - aside)
        real = left != right
        return _Pieces(Border(first[real], last[real]), inner[real], left[real])


def crosses_row(ring: Points, y: float) -> Points:
    """Where a line along x at `y` crosses the edges of `ring`, ascending [m]; between the first two it is inside."""
    (ax, ay), (bx, by) = ring.T, np.roll(ring, -1, axis=0).T
    spans = (ay > y) != (by > y)
    if not spans.any():
        return np.empty(0)
    return np.asarray(
        np.sort(ax[spans] + (y - ay[spans]) / (by[spans] - ay[spans]) * (bx[spans] - ax[spans]))
    )


def _inside(ring: Points, points: Points) -> NDArray[np.bool_]:
    """Whether each point lies within `ring`: a line to the right crosses it an odd number of times."""
    x, y = points[:, 0, None], points[:, 1, None]
    (ax, ay), (bx, by) = ring.T, np.roll(ring, -1, axis=0).T
    spans = (ay > y) != (by > y)
    rise = np.where(by == ay, 1.0, by - ay)
    with np.errstate(over="ignore", invalid="ignore"):  # of sides as good as level, which span nothing
        crosses = spans & (x < ax + (y - ay) / rise * (bx - ax))
    return np.asarray(crosses.sum(axis=1) % 2 == 1)


def _cut(start: Points, end: Points, starts: Points, ends: Points) -> Points:
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
    cuts = np.sort(np.concatenate(([0.0, 1.0], here[meets & (here > 0.0) & (here < 1.0)])))
    cuts = cuts[
        np.concatenate(([True], np.diff(cuts) > 0.0))
    ]  # numpy's `unique` would load its masked arrays
    return np.asarray(start + cuts[:, None] * along)
