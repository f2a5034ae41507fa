"""Paint on a world's ground, point by point, for sensors that look down.

paint = Paint(world)
paint.share(np.array([[1.0, 0.5]]), 0.005)  # how much of a spot of 5 mm round (1.0, 0.5) is paint
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from sim.world.ground_picture import arrow_corners
from sim.world.world import World

__all__ = ["Paint"]

BAY_LINE = 0.12
"""Breadth of the lines between parking bays [m]; the renderers paint them as broad."""

Points = NDArray[np.float64]
"""Shape (n, 2): x, y in `map` [m]."""

_CROSS = np.array([(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)]) * 0.7
"""Points of a spot of radius 1 at which polygons are tested."""

_REACH = 1.5
"""No part of an arrow is farther from the middle of its corners [m]."""


class Paint:
    """The lines of bays, the other lines and the arrows."""

    def __init__(self, world: World) -> None:
        """Of `world`; shadows are no paint."""
        strips = np.array([*_bay_lines(world), *_lines(world)]).reshape(-1, 5)
        self._starts, ends = strips[:, 0:2], strips[:, 2:4]
        self._lengths = np.maximum(np.hypot(*(ends - self._starts).T), 1e-9)
        self._ahead = (ends - self._starts) / self._lengths[:, None]
        self._halves = strips[:, 4] / 2
        self._arrows = [np.array(arrow_corners(arrow)) for arrow in world.arrows]
        self._middles = [corners.mean(axis=0).tolist() for corners in self._arrows]
        self._clear: tuple[tuple[float, float], float] = ((0.0, 0.0), -math.inf)
        """A place, and a distance from there within which there is no paint [m]."""

    def share(self, points: Points, radius: float) -> NDArray[np.float64]:
        """Part, 0 to 1, of a spot of `radius` [m] round each of `points` that is painted, to a tenth of it."""
        painted = np.zeros(len(points))
        if not len(self._starts) and not self._arrows:
            return painted
        reach = radius + 2 * float(np.abs(points - points[0]).max())
        here: tuple[float, float] = tuple(points[0].tolist())
        place, clear = self._clear
        if math.dist(here, place) + reach < clear:
            return painted
        near = self._near(here, reach)
        if len(near):
            starts, ahead = self._starts[near], self._ahead[near]
            x, y = (points[:, axis, None] - starts[:, axis] for axis in (0, 1))
            along = x * ahead[:, 0] + y * ahead[:, 1]
            across = y * ahead[:, 0] - x * ahead[:, 1]
            halves = self._halves[near]
            beside = _covered(across, radius, -halves, halves)
            painted = (beside * _covered(along, radius, 0.0, self._lengths[near])).max(axis=1)
        for corners, middle in zip(self._arrows, self._middles, strict=True):
            if math.dist(middle, here) < _REACH + reach:
                spots = (points[:, None, :] + _CROSS * radius).reshape(-1, 2)
                hit = _inside(spots, corners).reshape(len(points), -1).mean(axis=1)
                painted = np.maximum(painted, hit)
        return painted

    def _near(self, point: tuple[float, float], reach: float) -> NDArray[np.intp]:
        """Which strips come nearer to a point than `reach` [m]; mostly there is none. Keeps how far it is clear round it."""
        x, y = (np.array(point) - self._starts).T
        ahead_x, ahead_y = self._ahead.T
        along, across = x * ahead_x + y * ahead_y, y * ahead_x - x * ahead_y
        gaps = np.maximum(np.abs(across) - self._halves, np.maximum(-along, along - self._lengths))
        arrows = (math.dist(middle, point) - _REACH for middle in self._middles)
        self._clear = point, min(float(gaps.min(initial=math.inf)), min(arrows, default=math.inf))
        return np.flatnonzero(gaps < reach)


def _bay_lines(world: World) -> Iterator[tuple[float, float, float, float, float]]:
    for row in world.bays:
        for number in range(row.count + 1):
            x = row.x + number * row.width
            yield x, row.y, x, row.y + row.depth, BAY_LINE


def _lines(world: World) -> Iterator[tuple[float, float, float, float, float]]:
    for line in world.lines:
        yield *line.start, *line.end, line.width


def _covered(
    at: NDArray[np.float64],
    radius: float,
    low: NDArray[np.float64] | float,
    high: NDArray[np.float64] | float,
) -> NDArray[np.float64]:
    """Part of `at` ± `radius` that lies between `low` and `high`."""
    both = np.minimum(at + radius, high) - np.maximum(at - radius, low)
    return np.minimum(np.maximum(both / (2 * radius), 0.0), 1.0)


def _inside(points: Points, corners: Points) -> NDArray[np.bool_]:
    """Which points lie in a polygon, by the parity of the edges to their east."""
    odd = np.zeros(len(points), dtype=bool)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if math.isclose(ay, by):
            continue
        between = (points[:, 1] >= min(ay, by)) & (points[:, 1] < max(ay, by))
        odd ^= between & (points[:, 0] < ax + (points[:, 1] - ay) * (bx - ax) / (by - ay))
    return odd
