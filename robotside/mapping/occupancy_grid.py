"""The occupancy grid: occupied cells, and the distance from every cell to the nearest of them."""

from __future__ import annotations

import math
from collections.abc import Generator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.nav_msgs import OccupancyGrid
from robotside.core.pose2 import Points
from robotside.core.text import number
from robotside.mapping.distances import distance_from
from robotside.mapping.wavefront import CELLS_PER_STEP, work_steps

__all__ = ["OCCUPIED_FROM", "Grid"]

OCCUPIED_FROM = 50
"""Cells of at least this value count as occupied, of 0 to 100."""


RESOLUTION_RANGE = (0.001, 10.0)
"""Least and greatest width of a cell of any use [m]: a finer map of a place is one of nothing."""

STAMPS_PER_STEP = 20
"""Points that one step marks."""

MAX_ORIGIN = 1e8
"""How far a map's corner may be from its frame's origin [m]."""


@dataclass(frozen=True)
class Grid:
    """A grid of square cells aligned with the map frame; row i, column j is `cells[i, j]`."""

    occupied: NDArray[np.bool_]
    """Shape (rows along y, columns along x)."""
    resolution: float
    """Edge of a cell [m]."""
    x: float
    """Of the outer corner of cell (0, 0) [m]."""
    y: float

    @classmethod
    def unknown(cls) -> Grid:
        """No map at all: a few cells at the origin that are all occupied."""
        return cls(np.ones((2, 2), dtype=np.bool_), 0.1, 0.0, 0.0)

    @classmethod
    def from_msg(cls, msg: OccupancyGrid) -> Grid:
        """The grid of a map message; unknown cells count as occupied."""
        info = msg.info
        data = np.asarray(msg.data, dtype=np.int8).reshape(info.height, info.width)
        corner = info.origin.position
        occupied: NDArray[np.bool_] = np.logical_or(data >= OCCUPIED_FROM, data < 0)
        return cls(occupied, info.resolution, corner.x, corner.y)

    @staticmethod
    def fault(msg: OccupancyGrid) -> str:
        """Why the map message is of no use, as one sentence; empty when it is."""
        info, turned, corner = msg.info, msg.info.origin.orientation, msg.info.origin.position
        if not RESOLUTION_RANGE[0] <= info.resolution <= RESOLUTION_RANGE[1]:
            allowed = f"{RESOLUTION_RANGE[0]} to {RESOLUTION_RANGE[1]:g} m are allowed"
            return f"The map cannot be used: its cells are {info.resolution:.4g} m wide; {allowed}."
        if not all(abs(place) <= MAX_ORIGIN for place in (corner.x, corner.y)):
            where = f"({number(corner.x)}, {number(corner.y)})"
            return f"The map cannot be used: it begins at {where}, which is over {MAX_ORIGIN:.0e} m away."
        if not 4 <= info.width * info.height == len(msg.data) or min(info.width, info.height) < 2:
            return (
                f"The map cannot be used: it says {info.width} x {info.height} cells and has {len(msg.data)}."
            )
        if not abs(turned.yaw) <= 1e-3:  # NaN too
            return f"The map cannot be used: it is turned by {turned.yaw:.3f} rad against its own frame."
        return ""

    @cached_property
    def distance(self) -> NDArray[np.float64]:
        """Of each cell's centre to the nearest surface [m]: positive in the open, negative inside obstacles."""
        if not self.occupied.any():
            return np.full(self.occupied.shape, 1e3)
        outside = distance_from(self.occupied)
        inside = distance_from(~self.occupied)
        signed = np.where(self.occupied, 0.5 - inside, outside - 0.5)
        return np.asarray(signed * self.resolution, dtype=np.float64)

    def coarser(self, factor: int) -> Grid:
        """The same map in cells `factor` times as wide; a cell is occupied when any part of it is."""
        rows, columns = self.occupied.shape
        padded = np.pad(self.occupied, ((0, -rows % factor), (0, -columns % factor)))
        blocks = padded.reshape(padded.shape[0] // factor, factor, padded.shape[1] // factor, factor)
        occupied = np.asarray(np.any(blocks, axis=(1, 3)), dtype=np.bool_)
        return Grid(occupied, self.resolution * factor, self.x, self.y)

    def marked(self, points: Points) -> Grid:
        """The same map with the cells of `points` occupied as well; points off the map are left out."""
        occupied = self.occupied.copy()
        rows, columns, inside = self._cells(points)
        occupied[rows[inside], columns[inside]] = True
        return replace(self, occupied=occupied)

    def seeing(self, points: Points, reach: float) -> Generator[None, None, Grid]:
        """The result of `marked`, step by step and without looking at the whole map again.

        `distance` is right up to `reach` [m] from `points`; farther from them it may be that of the map without them.
        """
        if not len(points):
            return self
        rows, columns, inside = self._cells(points)
        rows, columns = rows[inside], columns[inside]
        occupied, distance = self.occupied.copy(), self.distance.copy()
        occupied[rows, columns] = True
        yield from work_steps(occupied.size, 10 * CELLS_PER_STEP)
        most = math.ceil(reach / self.resolution) + 1
        side = np.arange(-most, most + 1)
        stamp = (np.hypot(side[:, None], side[None, :]) - 0.5) * self.resolution
        for done, (row, column) in enumerate(sorted(set(zip(rows.tolist(), columns.tolist(), strict=True)))):
            if done % STAMPS_PER_STEP == 0:
                yield
            top, left = max(0, row - most), max(0, column - most)
            here = distance[top : row + most + 1, left : column + most + 1]
            down, right = top - row + most, left - column + most
            np.minimum(here, stamp[down : down + here.shape[0], right : right + here.shape[1]], out=here)
        marked = replace(self, occupied=occupied)
        marked.__dict__["distance"] = distance
        return marked

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """Row and column of a place; off the map when outside `occupied.shape`."""
        return math.floor((y - self.y) / self.resolution), math.floor((x - self.x) / self.resolution)

    def centre(self, row: int, column: int) -> tuple[float, float]:
        """x and y [m] of a cell's centre."""
        return self.x + (column + 0.5) * self.resolution, self.y + (row + 0.5) * self.resolution

    def holds(self, x: float, y: float) -> bool:
        """The place is on the map; NaN and infinity are not."""
        rows, columns = self.occupied.shape
        up, along = (y - self.y) / self.resolution, (x - self.x) / self.resolution
        return bool(0 <= up < rows and 0 <= along < columns)

    def clearance(self, points: Points) -> NDArray[np.float64]:
        """How far each of `points` is from the nearest obstacle [m]; negative inside one and off the map."""
        rows, columns, inside = self._cells(points)
        shape = self.occupied.shape
        found = self.distance[rows.clip(0, shape[0] - 1), columns.clip(0, shape[1] - 1)]
        return np.where(inside, found, -1.0)

    def _cells(self, points: Points) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.bool_]]:
        columns = np.floor((points[:, 0] - self.x) / self.resolution).astype(np.intp)
        rows = np.floor((points[:, 1] - self.y) / self.resolution).astype(np.intp)
        shape = self.occupied.shape
        inside = (rows >= 0) & (rows < shape[0]) & (columns >= 0) & (columns < shape[1])
        return rows, columns, inside
