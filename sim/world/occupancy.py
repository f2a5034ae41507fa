"""The robot's own map: the occupied cells of the ground, drawn from the world without the things that move."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import Point, Pose
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.std_msgs import Header, Time
from sim.core.shapes import Shape, rotate, rotate_back
from sim.world.world import World

__all__ = ["RESOLUTION", "covered", "occupancy"]

Grid = NDArray[np.floating[Any]]

RESOLUTION = 0.1
"""Edge of a cell [m]."""
MARGIN = 1.0
"""Of unknown round the ground [m]."""
TOUCH = 1e-6
"""A cell that an obstacle comes no nearer than this [m] is touched and not full: else rounding would decide it, one way at one end of a wall and
the other way at its other end."""
CLEARANCE = 0.45
"""Things that hang higher than this are no obstacle for a low ground robot [m]."""
HEADROOM = 0.05
"""Over a taller one, so much more than its height has to be free [m]."""


def occupancy(
    world: World, stamp: float, shift: tuple[float, float] = (0.0, 0.0), *, height: float = 0.0
) -> OccupancyGrid:
    """The map of `world` in the frame `map`, loaded at `stamp` [s, robot clock].

    `shift` moves the borders of its cells along x and y [m], and nothing of what they show. What hangs over a robot of that
    `height` [m] is no obstacle. A cell is full when an obstacle covers its middle or comes within half a cell of it; off the ground is unknown.
    """
    length, width = world.ground.length, world.ground.width
    columns, rows = (round((extent + 2 * MARGIN) / RESOLUTION) for extent in (length, width))
    west, south = shift[0] - length / 2 - MARGIN, shift[1] - width / 2 - MARGIN
    x = west + (np.arange(columns) + 0.5) * RESOLUTION
    y = south + (np.arange(rows) + 0.5) * RESOLUTION
    cells = np.full((rows, columns), -1, dtype=np.int8)
    cells[np.ix_(np.abs(y) < width / 2, np.abs(x) < length / 2)] = 0
    low = max(CLEARANCE, height + HEADROOM)
    cells[covered((shape for shape in world.mapped if _bottom(shape) < low), x, y)] = 100
    time = Time.at(stamp)
    info = MapMetaData(time, RESOLUTION, columns, rows, Pose(Point(west, south)))
    return OccupancyGrid(Header(time, "map"), info, Int8Array(cells.tobytes()))


def covered(shapes: Iterable[Shape], x: Grid, y: Grid) -> NDArray[np.bool_]:
    """Which cells upright `shapes` cover, or come within half a cell of: (rows, columns).

    `x` and `y` are the middles of columns and rows [m], rising by `RESOLUTION`.
    """
    full = np.zeros((len(y), len(x)), dtype=np.bool_)
    for shape in shapes:
        # only the cells round it: of all of them at once a large ground has too many
        east, north, _ = map(abs, rotate(shape.rotation, (1.0, 0.0, 0.0)))
        long, wide, _ = shape.size
        columns = _near(x, shape.position[0], (long * east + wide * north) / 2 + RESOLUTION)
        rows = _near(y, shape.position[1], (long * north + wide * east) / 2 + RESOLUTION)
        full[rows, columns] |= _covers(shape, *np.meshgrid(x[columns], y[rows]))
    return full


def _bottom(shape: Shape) -> float:
    return shape.position[2] - shape.size[2] / 2


def _near(middles: Grid, at: float, reach: float) -> slice:
    """Which of the `middles`, which rise, are no farther than `reach` from `at` [m]."""
    return slice(
        int(np.searchsorted(middles, at - reach)), int(np.searchsorted(middles, at + reach, "right"))
    )


def _covers(shape: Shape, x: Grid, y: Grid) -> NDArray[np.bool_]:
    """The cells under an upright `shape`, given the middles of all cells."""
    cosine, minus_sine, _ = rotate_back(shape.rotation, (1.0, 0.0, 0.0))
    dx, dy = x - shape.position[0], y - shape.position[1]
    along, across = cosine * dx - minus_sine * dy, minus_sine * dx + cosine * dy
    reach = RESOLUTION / 2 - TOUCH
    half_x, half_y = shape.size[0] / 2 + reach, shape.size[1] / 2 + reach
    if shape.kind == "box":
        return (np.abs(along) < half_x) & (np.abs(across) < half_y)
    return np.asarray(along**2 + across**2 < half_x**2)
