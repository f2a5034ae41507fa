"""The path planner: the shortest way on the map, clear of everything by the robot's width."""

from __future__ import annotations

import math
from collections.abc import Generator

import numpy as np

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Points
from robotside.core.text import place_sentence
from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.wavefront import Cell, Wavefront, WorkSteps, rows_at_once, work_steps

__all__ = ["MARGIN", "PREFERRED_MARGIN", "STEP", "Planner", "Unreachable"]

MARGIN = 0.08
"""Kept between the body and anything, where it is narrow [m]."""

PREFERRED_MARGIN = 0.45
"""Kept where there is room [m]."""

STEP = 0.1
"""Between two points of a path [m]."""

MIN_CELL = 0.1
"""Least width of a cell when searching [m]; finer maps are made coarser, since time grows with their area."""

SOFT_MARGIN = 1.0
"""Beside the body it matters how near something new is up to here [m]."""

POINTS_PER_STEP = 300
"""Points of a line that one step looks at."""

ESCAPE_DISTANCE = 0.6
"""A robot that stands too close to something may cross that zone within this distance of itself [m]."""

_BELL = np.exp(-0.5 * (np.arange(-8, 9) / 2.0) ** 2)
_BELL /= _BELL.sum()
"""Weights of a point's neighbours where a path is rounded."""


class Unreachable(Exception):
    """There is no way; the text is one sentence that names the place."""


class Planner:
    """Plans paths on one map for one robot."""

    def __init__(self, grid: Grid, radius: float) -> None:
        self.map = grid
        """The map as it was given."""
        factor = max(1, math.floor(MIN_CELL / grid.resolution + 1e-6))
        self.grid = grid.coarser(factor) if factor > 1 else grid
        self._need = radius + MARGIN
        self._want = radius + PREFERRED_MARGIN
        self._reach = radius + SOFT_MARGIN
        for each in (grid, self.grid):
            _ = each.distance  # now, and not while the robot's loop or a search waits for it

    def fault(self, name: str, x: float, y: float) -> Problem:
        """Why the robot cannot stand at this place, as one sentence; empty when it can."""
        where = place_sentence(name, x, y)
        if not self.grid.holds(x, y):
            return Notice(Code.PLACE_OFF_MAP, f"{where} is off the map.", place=name, x=x, y=y)
        room = self.grid.clearance(np.array([[x, y]]))[0]
        if room <= 0:
            said = f"{where} is in a wall or another obstacle."
            return Notice(Code.PLACE_IN_OBSTACLE, said, place=name, x=x, y=y)
        if room < self._need:
            said = f"{where} is {room:.2f} m from an obstacle; the robot needs {self._need:.2f} m."
            return Notice(Code.PLACE_NEAR_OBSTACLE, said, place=name, x=x, y=y)
        return ""

    def off_map(self, name: str, x: float, y: float) -> Problem:
        """Why this place is none on the map and how far the map reaches, as one sentence; empty when it is one."""
        if self.grid.holds(x, y):
            return ""
        grid, (rows, columns) = self.grid, self.grid.occupied.shape
        right, top = grid.x + columns * grid.resolution, grid.y + rows * grid.resolution
        reach = f"x {grid.x:.1f} to {right:.1f} m, y {grid.y:.1f} to {top:.1f} m"
        said = f"{place_sentence(name, x, y)} is off the map, which is {reach}."
        return Notice(Code.PLACE_OFF_MAP, said, place=name, x=x, y=y)

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
        return completed(self.search(start, goal, name, obstacles))

    def search(
        self,
        start: tuple[float, float],
        goal: tuple[float, float],
        name: str,
        obstacles: Points | None = None,
    ) -> Generator[None, None, Points]:
        """The same, bit by bit: each step takes a fraction of a millisecond, however large the map is."""
        self._check_on_map(start, goal, name)
        grid = self.grid if obstacles is None else (yield from self.seeing(obstacles))
        straight = np.array([start, goal])
        yield from work_steps(round(math.dist(start, goal) / STEP), POINTS_PER_STEP)
        if _room_along(grid, straight) >= self._want:
            return resampled(straight)
        route = yield from self._route(grid, start, goal, name)
        pulled = yield from self._pulled(grid, route)
        return resampled(_rounded(resampled(pulled)))

    def seeing(self, obstacles: Points) -> Generator[None, None, Grid]:
        """The map with `obstacles` on it, bit by bit; how far they are is right as far as it matters to this robot."""
        return (yield from self.grid.seeing(obstacles, self._reach))

    def _check_on_map(self, start: tuple[float, float], goal: tuple[float, float], name: str) -> None:
        if not self.grid.holds(*start):
            raise Unreachable(f"{place_sentence('The robot', *start)} is off the map.")
        if not self.grid.holds(*goal):
            raise Unreachable(f"{place_sentence(name, *goal)} is off the map.")

    def _route(
        self, grid: Grid, start: tuple[float, float], goal: tuple[float, float], name: str
    ) -> Generator[None, None, Points]:
        from_cell, to_cell = grid.cell(*start), grid.cell(*goal)
        wave = Wavefront(grid.occupied.shape, from_cell)
        yield from self._price(grid, from_cell, wave)
        if not math.isfinite(wave.price[to_cell]):
            raise Unreachable(f"{place_sentence(name, *goal)} is too close to an obstacle.")
        yield from wave.spread(to_cell)
        cells = wave.way(to_cell)
        if not len(cells):
            raise Unreachable(f"There is no way to {place_sentence(name, *goal)}.")
        yield from work_steps(len(cells), POINTS_PER_STEP)
        inner = np.array([grid.x, grid.y]) + (cells[1:-1, ::-1] + 0.5) * grid.resolution
        return np.concatenate([[start], inner, [goal]])

    def _price(self, grid: Grid, start: Cell, wave: Wavefront) -> WorkSteps:
        price, distance = wave.price, grid.distance
        for rows in rows_at_once(distance.shape):
            room = distance[rows]
            tight = np.clip((self._want - room) / (self._want - self._need), 0.0, 1.0)
            price[rows] = np.where(room < self._need, np.inf, 1.0 + 8.0 * tight**2)
            yield
        far = math.ceil(ESCAPE_DISTANCE / grid.resolution)
        near = tuple(slice(max(0, at - far), at + far + 1) for at in start)
        rows_near, columns_near = np.ogrid[: distance.shape[0], : distance.shape[1]]
        gaps = (rows_near[near[0]] - start[0]) ** 2 + (columns_near[:, near[1]] - start[1]) ** 2
        room = distance[near]
        escapes = (room < self._need) & (room > 0) & (gaps <= (ESCAPE_DISTANCE / grid.resolution) ** 2)
        price[near][escapes] = 30.0
        price[start] = 1.0

    def _pulled(self, grid: Grid, route: Points) -> Generator[None, None, Points]:
        """The route with straight lines in place of detours, wherever the preferred room is left."""
        kept, here = [0], 0
        narrow = (grid.clearance(route) < self._want).tolist()
        while here < len(route) - 1:
            if narrow[here]:
                here += 1  # no line from here has the room
            else:
                left = math.dist(route[here].tolist(), route[-1].tolist())
                yield from work_steps(round(left / STEP) + POINTS_PER_STEP, POINTS_PER_STEP)
                here = self._farthest(grid, route, here)
            kept.append(here)
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


def _room_along(grid: Grid, line: Points) -> float:
    return float(grid.clearance(resampled(line)).min())
