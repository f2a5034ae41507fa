"""The way from here to there on the map, clear of everything by a robot's width."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from skimage.graph import route_through_array

from robotside.grid import Grid
from robotside.pose2 import Points
from robotside.words import number

__all__ = ["MARGIN", "PREFERRED", "STEP", "Planner", "Unreachable", "place_sentence"]

MARGIN = 0.08
"""Kept between the body and anything, where it is narrow [m]."""

PREFERRED = 0.45
"""Kept where there is room [m]."""

STEP = 0.1
"""Between two points of a path [m]."""

CELL = 0.1
"""Least width of a cell when searching [m]; finer maps are made coarser, since time grows with their area."""

ESCAPE = 0.6
"""A robot that stands too close to something may cross that zone within this distance of itself [m]."""

_BELL = np.exp(-0.5 * (np.arange(-8, 9) / 2.0) ** 2)
_BELL /= _BELL.sum()
"""Weights of a point's neighbours where a path is rounded."""


class Unreachable(Exception):
    """There is no way; the text is one sentence that names the place."""


def place_sentence(name: str, x: float, y: float) -> str:
    """A place as people read it: its name and coordinates."""
    return f"{name} at ({number(x)}, {number(y)})"


class Planner:
    """Plans paths on one map for one robot."""

    def __init__(self, grid: Grid, radius: float) -> None:
        factor = max(1, math.floor(CELL / grid.resolution + 1e-6))
        self.grid = grid.coarser(factor) if factor > 1 else grid
        self._need = radius + MARGIN
        self._want = radius + PREFERRED

    def fault(self, name: str, x: float, y: float) -> str:
        """Why the robot cannot stand at this place, as one sentence; empty when it can."""
        where = place_sentence(name, x, y)
        if not self.grid.holds(x, y):
            return f"{where} is off the map."
        room = self.grid.clearance(np.array([[x, y]]))[0]
        if room <= 0:
            return f"{where} is in a wall or another obstacle."
        if room < self._need:
            return f"{where} is {room:.2f} m from an obstacle; the robot needs {self._need:.2f} m."
        return ""

    def off_map(self, name: str, x: float, y: float) -> str:
        """Why this place is none on the map and how far the map reaches, as one sentence; empty when it is one."""
        if self.grid.holds(x, y):
            return ""
        grid, (rows, columns) = self.grid, self.grid.occupied.shape
        right, top = grid.x + columns * grid.resolution, grid.y + rows * grid.resolution
        reach = f"x {grid.x:.1f} to {right:.1f} m, y {grid.y:.1f} to {top:.1f} m"
        return f"{place_sentence(name, x, y)} is off the map, which is {reach}."

    def plan(
        self,
        start: tuple[float, float],
        goal: tuple[float, float],
        name: str,
        obstacles: Points | None = None,
    ) -> Points:
        """Points from `start` to `goal`, shape (n, 2) [m], `STEP` apart, round the map and `obstacles`.

        Raises Unreachable with a sentence that calls the goal `name`.
        """
        self._check_on_map(start, goal, name)
        grid = self.grid if obstacles is None or not len(obstacles) else self.grid.marked(obstacles)
        straight = np.array([start, goal])
        if _room_along(grid, straight) >= self._want:
            return resampled(straight)
        route = self._route(grid, start, goal, name)
        return resampled(_rounded(resampled(self._pulled(grid, route))))

    def _check_on_map(self, start: tuple[float, float], goal: tuple[float, float], name: str) -> None:
        if not self.grid.holds(*start):
            raise Unreachable(f"{place_sentence('The robot', *start)} is off the map.")
        if not self.grid.holds(*goal):
            raise Unreachable(f"{place_sentence(name, *goal)} is off the map.")

    def _route(self, grid: Grid, start: tuple[float, float], goal: tuple[float, float], name: str) -> Points:
        cost = self._costs(grid, start)
        from_cell, to_cell = grid.cell(*start), grid.cell(*goal)
        cost[from_cell] = 1.0
        if not math.isfinite(cost[to_cell]):
            raise Unreachable(f"{place_sentence(name, *goal)} is too close to an obstacle.")
        cells, total = _search(cost, from_cell, to_cell)
        if not math.isfinite(total):
            raise Unreachable(f"There is no way to {place_sentence(name, *goal)}.")
        inner = [grid.centre(row, column) for row, column in cells[1:-1]]
        return np.array([start, *inner, goal])

    def _costs(self, grid: Grid, start: tuple[float, float]) -> NDArray[np.float64]:
        room = grid.distance
        cost = 1.0 + 8.0 * np.clip((self._want - room) / (self._want - self._need), 0.0, 1.0) ** 2
        tight = room < self._need
        rows, columns = np.ogrid[: room.shape[0], : room.shape[1]]
        row, column = grid.cell(*start)
        near = (rows - row) ** 2 + (columns - column) ** 2 <= (ESCAPE / grid.resolution) ** 2
        cost[tight] = np.inf
        cost[tight & near & (room > 0)] = 30.0
        return np.asarray(cost, dtype=np.float64)

    def _pulled(self, grid: Grid, route: Points) -> Points:
        """The route with straight lines in place of detours, wherever the preferred room is left."""
        kept, here = [0], 0
        while here < len(route) - 1:
            there = self._farthest(grid, route, here)
            kept.append(there)
            here = there
        return route[kept]

    def _farthest(self, grid: Grid, route: Points, here: int) -> int:
        low, high = here + 1, len(route) - 1
        if _room_along(grid, route[[here, high]]) >= self._want:
            return high
        while high - low > 1:
            middle = (low + high) // 2
            if _room_along(grid, route[[here, middle]]) >= self._want:
                low = middle
            else:
                high = middle
        return low


def resampled(path: Points) -> Points:
    """The same line with its points `STEP` apart; both ends stay."""
    lengths = np.hypot(*np.diff(path, axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(lengths)))
    count = max(2, math.ceil(along[-1] / STEP) + 1)
    wanted = np.linspace(0.0, along[-1], count)
    return np.column_stack([np.interp(wanted, along, path[:, axis]) for axis in (0, 1)])


def _rounded(path: Points) -> Points:
    """The same line with its corners rounded over about half a metre; both ends stay."""
    if len(path) < 5:
        return path
    reach = len(_BELL) // 2
    longer = np.pad(path, ((reach, reach), (0, 0)), mode="edge")
    smooth = np.column_stack([np.convolve(longer[:, axis], _BELL, mode="valid") for axis in (0, 1)])
    smooth[0], smooth[-1] = path[0], path[-1]
    return smooth


def _search(
    cost: NDArray[np.float64], start: tuple[int, int], goal: tuple[int, int]
) -> tuple[list[tuple[int, int]], float]:
    """The cheapest cells from `start` to `goal`, and what they cost; infinite when there is no way."""
    try:
        cells, total = route_through_array(cost, start, goal, fully_connected=True, geometric=True)  # type: ignore[no-untyped-call]
    except ValueError:
        return [], math.inf
    return cells, float(total)


def _room_along(grid: Grid, line: Points) -> float:
    return float(grid.clearance(resampled(line)).min())
