"""The path planner: the shortest way on the map, clear of everything by the robot's width."""

from __future__ import annotations

import math
from collections.abc import Generator

import numpy as np
from numpy.typing import NDArray

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Points
from robotside.core.text import place_sentence
from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.wavefront import Cell, Wavefront, WorkSteps, rows_at_once, work_steps
from robotside.navigation.narrow_passage import Gap, squeezed

__all__ = ["CLEARANCE", "MARGIN", "PREFERRED_MARGIN", "STEP", "Planner", "Unreachable"]

CLEARANCE = 0.05
"""Kept between the body and anything in a narrow gap, unless the robot's configuration says otherwise [m]."""

MARGIN = 0.03
"""More than that is kept where a way is found by the map's cells alone [m]: they tell a gap's width only roughly."""

PREFERRED_MARGIN = 0.45
"""Kept where there is room [m]."""

STEP = 0.1
"""Between two points of a path [m]."""

MIN_CELL = 0.1
"""Least width of a cell when searching [m]; finer maps are made coarser, since time grows with their area."""

SOFT_MARGIN = 1.0
"""Beside the body it matters how near something new is up to here [m]."""

MAX_GAPS = 6
"""Gaps that are measured and found too narrow before there is no way."""

POINTS_PER_STEP = 300
"""Points of a line that one step looks at."""

ESCAPE_DISTANCE = 0.6
"""A robot that stands too close to something may cross that zone within this distance of itself [m]."""

TIGHT_PRICE = 300.0
"""So many times as dear at most is a way through a gap that may be too narrow: a detour of some metres is taken for a wider one."""

_BELL = np.exp(-0.5 * (np.arange(-8, 9) / 2.0) ** 2)
_BELL /= _BELL.sum()
"""Weights of a point's neighbours where a path is rounded."""


class Unreachable(Exception):
    """There is no way; the text is one sentence that names the place."""

    def __init__(
        self, said: str, *, blocked: tuple[float, float] | None = None, gap: Gap | None = None
    ) -> None:
        super().__init__(said)
        self.blocked = blocked
        """Where something stands in the way that the map does not show, and that may go again [m]; None when the map has no way."""
        self.gap = gap
        """The gap that is too narrow; None when it is not for one."""


class Planner:
    """Plans paths on one map for one robot."""

    def __init__(self, grid: Grid, radius: float, clearance: float = CLEARANCE) -> None:
        """The body's `radius`, and the `clearance` that it keeps where it is narrow [m]."""
        self.map = grid
        """The map as it was given."""
        factor = max(1, math.floor(MIN_CELL / grid.resolution + 1e-6))
        self.grid = grid.coarser(factor) if factor > 1 else grid
        self._tight = radius + clearance
        self._need = self._tight + MARGIN
        self._want = max(radius + PREFERRED_MARGIN, self._need + MARGIN)
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
        beside = np.empty((0, 2)) if obstacles is None else obstacles
        try:
            return (yield from self._among(beside, start, goal, name))
        except Unreachable as problem:
            if not len(beside):
                raise
            # the map's own walls stay where they are: without a way between them there is none to wait for
            way = yield from self._among(beside[:0], start, goal, name)
            raise self.blocked(problem, name, goal, way, beside) from problem

    def blocked(
        self, problem: Unreachable, name: str, goal: tuple[float, float], way: Points, obstacles: Points
    ) -> Unreachable:
        """Why there is no way now along which there would be one by the map, `way`, but for `obstacles`."""
        where, gap = place_sentence(name, *goal), problem.gap
        if gap is not None:
            return Unreachable(f"The way to {where} is blocked: {gap}.", blocked=(gap.x, gap.y), gap=gap)
        apart = np.hypot(obstacles[:, None, 0] - way[:, 0], obstacles[:, None, 1] - way[:, 1])
        near = apart.min(axis=0) < max(self._need, float(apart.min()) + 1e-6)
        x, y = obstacles[int(apart[:, int(near.argmax())].argmin())].tolist()
        return Unreachable(f"The way to {where} is blocked at ({x:.1f}, {y:.1f}).", blocked=(x, y))

    def _among(
        self, obstacles: Points, start: tuple[float, float], goal: tuple[float, float], name: str
    ) -> Generator[None, None, Points]:
        """A way by the cells of the map, and where they are too narrow for that, by what stands beside its gaps."""
        grid = self.grid if not len(obstacles) else (yield from self.seeing(obstacles))
        straight = np.array([start, goal])
        yield from work_steps(round(math.dist(start, goal) / STEP), POINTS_PER_STEP)
        if _room_along(grid, straight) >= self._want:
            return resampled(straight)
        try:
            route = yield from self._route(grid, start, goal, name)
        except Unreachable:
            return (yield from self._squeezed(grid, obstacles, start, goal, name))
        pulled = yield from self._pulled(grid, route)
        return resampled(_rounded(resampled(pulled)))

    def _squeezed(
        self,
        grid: Grid,
        obstacles: Points,
        start: tuple[float, float],
        goal: tuple[float, float],
        name: str,
    ) -> Generator[None, None, Points]:
        """The way through gaps that are narrower than the cells tell for sure, each measured by what stands beside it.

        What is too narrow counts as closed, and another way is looked for.
        """
        widest: Gap | None = None
        closed = np.empty((0, 2))
        for _ in range(MAX_GAPS):
            try:
                route = yield from self._route(grid, start, goal, name, squeezes=True)
            except Unreachable as problem:
                raise _too_narrow(name, goal, widest) if widest else problem from problem
            pulled = yield from self._pulled(grid, route)
            path = resampled(_rounded(resampled(pulled)))
            free = grid.clearance(path) >= self._need
            if self._too_close(grid, start):
                free |= np.hypot(path[:, 0] - start[0], path[:, 1] - start[1]) < ESCAPE_DISTANCE
            way, gap = yield from squeezed(self.map, path, obstacles, self._tight, free)
            if gap is None:
                way[0], way[-1] = path[0], path[-1]
                return resampled(way)
            if widest is None or gap.width > widest.width:
                widest = gap
            closed = np.concatenate([closed, [[gap.x, gap.y]]])
            grid = yield from self.seeing(np.concatenate([obstacles, closed]))
        raise _too_narrow(name, goal, widest)

    def _too_close(self, grid: Grid, start: tuple[float, float]) -> bool:
        """It has to come away from something first."""
        return float(grid.clearance(np.array([start]))[0]) < self._need

    def seeing(self, obstacles: Points) -> Generator[None, None, Grid]:
        """The map with `obstacles` on it, bit by bit; how far they are is right as far as it matters to this robot."""
        return (yield from self.grid.seeing(obstacles, self._reach))

    def _check_on_map(self, start: tuple[float, float], goal: tuple[float, float], name: str) -> None:
        if not self.grid.holds(*start):
            raise Unreachable(f"{place_sentence('The robot', *start)} is off the map.")
        if not self.grid.holds(*goal):
            raise Unreachable(f"{place_sentence(name, *goal)} is off the map.")

    def _route(
        self,
        grid: Grid,
        start: tuple[float, float],
        goal: tuple[float, float],
        name: str,
        *,
        squeezes: bool = False,
    ) -> Generator[None, None, Points]:
        """The cheapest way over the cells; one that `squeezes` goes through whatever is free at all."""
        from_cell, to_cell = grid.cell(*start), grid.cell(*goal)
        wave = Wavefront(grid.occupied.shape, from_cell)
        yield from self._price(grid, from_cell, wave, squeezes=squeezes)
        near = float(grid.clearance(np.array([goal]))[0]) < self._tight - grid.resolution / 2
        if near or not math.isfinite(wave.price[to_cell]):
            raise Unreachable(f"{place_sentence(name, *goal)} is too close to an obstacle.")
        yield from wave.spread(to_cell)
        cells = wave.way(to_cell)
        if not len(cells):
            raise Unreachable(f"There is no way to {place_sentence(name, *goal)}.")
        yield from work_steps(len(cells), POINTS_PER_STEP)
        inner = np.array([grid.x, grid.y]) + (cells[1:-1, ::-1] + 0.5) * grid.resolution
        return np.concatenate([[start], inner, [goal]])

    def _price(self, grid: Grid, start: Cell, wave: Wavefront, *, squeezes: bool) -> WorkSteps:
        price, distance = wave.price, grid.distance
        for rows in rows_at_once(distance.shape):
            room = distance[rows]
            tight = np.clip((self._want - room) / (self._want - self._need), 0.0, 1.0)
            narrow: float | NDArray[np.float64] = np.inf
            if squeezes:
                missing = np.clip(self._need - room, 0.0, self._need) / self._need
                narrow = np.where(room > 0, 1.0 + TIGHT_PRICE * (0.1 + missing**2), np.inf)
            price[rows] = np.where(room < self._need, narrow, 1.0 + 8.0 * tight**2)
            yield
        if distance[start] >= self._need:
            return
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


def _too_narrow(name: str, goal: tuple[float, float], gap: Gap | None) -> Unreachable:
    return Unreachable(f"There is no way to {place_sentence(name, *goal)}: {gap}.", gap=gap)


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
