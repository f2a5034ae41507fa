"""A map as a field of distances: how far each place is from the nearest surface, and in which direction."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points, Pose2
from robotside.mapping.distances import distance_from
from robotside.mapping.occupancy_grid import Grid

__all__ = ["Closeness", "Field"]

FIELD_RANGE = (-1.0, 2.0)
"""Distances of the field end at these [m]: within a wall, and in the open."""


class Field:
    """A map's distance field, readable between the cells and with slopes."""

    def __init__(self, grid: Grid) -> None:
        """It takes its time on a large map, and may be made in another thread."""
        most = math.ceil(FIELD_RANGE[1] / grid.resolution) + 2
        outside = distance_from(grid.occupied, most)
        inside = distance_from(~grid.occupied, most)
        signed = np.where(grid.occupied, 1.0 - inside, outside) * grid.resolution
        values = np.clip(signed, *FIELD_RANGE)
        slope_y, slope_x = np.gradient(values, grid.resolution)
        self._layers = np.stack([values, slope_x, slope_y], axis=-1).astype(np.float32)
        self._grid = grid

    def read(self, points: Points) -> NDArray[np.float64]:
        """Distance to the nearest surface [m] and its slope along x and y, shape (n, 3); constant off the map."""
        rows, columns = self._layers.shape[:2]
        u = ((points[:, 0] - self._grid.x) / self._grid.resolution - 0.5).clip(0, columns - 1.001)
        v = ((points[:, 1] - self._grid.y) / self._grid.resolution - 0.5).clip(0, rows - 1.001)
        j, i = u.astype(np.intp), v.astype(np.intp)
        fu, fv = (u - j)[:, None], (v - i)[:, None]
        layers = self._layers
        low = layers[i, j] * (1 - fu) + layers[i, j + 1] * fu
        high = layers[i + 1, j] * (1 - fu) + layers[i + 1, j + 1] * fu
        return np.asarray(low * (1 - fv) + high * fv)

    @property
    def grid(self) -> Grid:
        """The map."""
        return self._grid

    @property
    def reach(self) -> float:
        """The longer side of the map [m]."""
        return float(max(self._grid.occupied.shape)) * self._grid.resolution

    @property
    def distances(self) -> NDArray[np.float32]:
        """Of each cell to the nearest surface [m], negative within a wall, cut at both ends."""
        return self._layers[:, :, 0]

    def full(self, points: Points) -> NDArray[np.bool_]:
        """Which of `points` lie in full cells of the map; none does off the map."""
        grid = self._grid
        columns = np.floor((points[:, 0] - grid.x) / grid.resolution).astype(np.intp)
        rows = np.floor((points[:, 1] - grid.y) / grid.resolution).astype(np.intp)
        height, width = grid.occupied.shape
        inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
        found = grid.occupied[rows.clip(0, height - 1), columns.clip(0, width - 1)]
        return np.asarray(found & inside)

    def closeness(self, centre: Pose2, reach: float, width: float) -> Closeness:
        """How near to a surface each cell within `reach` [m] of `centre` is, `width` [m] being near."""
        return Closeness(self._layers[:, :, 0], self._grid, centre, reach, width)


class Closeness:
    """A part of a map by how near to a surface each cell is: 1 on it, less the farther from it."""

    def __init__(
        self, distances: NDArray[np.float32], grid: Grid, centre: Pose2, reach: float, width: float
    ) -> None:
        """`distances` are the map's [m]; what lies beyond `reach` [m] of `centre` must not be asked for."""
        self._grid = grid
        self._rows, self._columns = (count - 1 for count in distances.shape)
        ends = np.array([-reach, reach])
        self._left, right = self._column(centre.x + ends).tolist()
        self._bottom, top = self._row(centre.y + ends).tolist()
        part = distances[self._bottom : top + 1, self._left : right + 1]
        self._near = np.exp(-((part / width) ** 2)).ravel()
        self._width = right - self._left + 1

    def of(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float32]:
        """Of points at each row of `x` [m] with each row of `y` [m], shape (rows of y, rows of x, points).

        A column goes by x alone and a row by y alone: no cell is computed for a pair of them, only looked up.
        """
        columns, rows = self._column(x) - self._left, (self._row(y) - self._bottom) * self._width
        near: NDArray[np.float32] = self._near[rows[:, None, :] + columns[None, :, :]]
        return near

    def _column(self, x: NDArray[np.float64]) -> NDArray[np.intp]:
        return ((x - self._grid.x) / self._grid.resolution).clip(0, self._columns).astype(np.intp)

    def _row(self, y: NDArray[np.float64]) -> NDArray[np.intp]:
        return ((y - self._grid.y) / self._grid.resolution).clip(0, self._rows).astype(np.intp)
