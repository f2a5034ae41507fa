"""The fence of one robot on its map."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from bridge.core.fence import FenceGeometry, crosses_row
from robotside.mapping.distances import distance_from
from robotside.mapping.occupancy_grid import Grid

__all__ = ["Fence"]


class Fence(FenceGeometry):
    """Areas in `map`, and the map to plan on that they leave."""

    def marked(self, grid: Grid, margin: float = 0.0) -> Grid:
        """The same map with every cell occupied that is forbidden, on the border or within `margin` [m] of either."""
        if not self:
            return grid
        barred = replace(grid, occupied=~self._raster(grid)).marked(self.border.sampled(grid.resolution / 2))
        most = math.ceil(margin / grid.resolution) + 1
        near = (distance_from(barred.occupied, most) - 0.5) * grid.resolution < margin
        return replace(grid, occupied=grid.occupied | barred.occupied | near)

    def _raster(self, grid: Grid) -> NDArray[np.bool_]:
        """Whether the robot may be at the centre of each cell, row by row: far quicker than cell by cell."""
        rows, columns = grid.occupied.shape
        x = np.asarray(grid.x + (np.arange(columns) + 0.5) * grid.resolution, dtype=np.float64)
        allowed = np.full((rows, columns), not self.keep_in)
        for row in range(rows):
            y = grid.y + (row + 0.5) * grid.resolution
            for ring in self.keep_in:
                allowed[row] |= np.searchsorted(crosses_row(ring, y), x) % 2 == 1
            for ring in self.keep_out:
                allowed[row] &= np.searchsorted(crosses_row(ring, y), x) % 2 == 0
        return allowed
