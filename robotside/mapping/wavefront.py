"""The cheapest paths over a grid of cells, found step by step by a wavefront that spreads over many cells at a time."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator

import numpy as np
from numpy.typing import NDArray

__all__ = ["CELLS_PER_STEP", "WorkSteps", "Cell", "Wavefront", "work_steps", "rows_at_once"]

Cell = tuple[int, int]
"""Row and column."""

WorkSteps = Generator[None, None, None]
"""Work of which each step takes a fraction of a millisecond."""

CELLS_PER_STEP = 20_000
"""Cells of a map that one step looks at."""

CELLS_PER_SPREAD, COST_OF_ROUND = 1_500, 300
"""Cells from which the wave spreads in one step; to begin with some is as much work as so many more."""

THICKNESS = 2.0
"""Of the wave: cells whose cost differs by no more spread at a time [cells]."""

THICKNESS_GROWTH = 0.002
"""The same for a wave that has come far, as a part of what it has cost."""

DIAGONAL = math.sqrt(2.0)


def work_steps(cells: int, each: int = CELLS_PER_STEP) -> WorkSteps:
    """So many steps as work on that many cells is worth."""
    for _ in range(math.ceil(cells / each)):
        yield


def rows_at_once(shape: tuple[int, ...]) -> Iterator[slice]:
    """Rows of a map of this shape, as many as one step looks at."""
    step = max(1, CELLS_PER_STEP // max(1, shape[1]))
    return (slice(row, min(row + step, shape[0])) for row in range(0, shape[0], step))


class Wavefront:
    """Spreads over one map from one cell; a way costs its length [cells] times what its cells cost, the half of each."""

    def __init__(self, shape: tuple[int, ...], start: Cell) -> None:
        rows, columns = shape[0], shape[1]
        # a rim that costs too much, so that no neighbour is off the map
        self._price = np.full((rows + 2, columns + 2), np.inf, dtype=np.float32)
        self._cost = np.full((rows + 2, columns + 2), np.inf, dtype=np.float32)
        self._start, self._width = start, columns + 2
        w = self._width
        self._steps = np.array([-1, 1, -w, w, -w - 1, -w + 1, w - 1, w + 1])
        self._halves = np.array([0.5] * 4 + [0.5 * DIAGONAL] * 4, dtype=np.float32)

    @property
    def price(self) -> NDArray[np.float32]:
        """What each cell costs, at least 1, infinite where no way leads; to be written before the wave spreads."""
        return self._price[1:-1, 1:-1]

    @property
    def cost(self) -> NDArray[np.float32]:
        """Of the cheapest way to each cell; infinite where the wave has not come."""
        return self._cost[1:-1, 1:-1]

    def spread(self, goal: Cell | None = None) -> WorkSteps:
        """Until the cheapest way to `goal` is known, or to every cell."""
        price, cost = self._price.ravel(), self._cost.ravel()
        waiting = np.array([self._index(self._start)])
        cost[waiting] = 0.0
        costs, keys = cost[waiting], self._ahead(waiting, goal)
        work = 0
        while len(waiting):
            first = float(keys.min())
            if goal is not None and first >= cost[self._index(goal)]:
                return
            now = keys <= first + max(THICKNESS, THICKNESS_GROWTH * first)
            cells, spent, later = waiting[now], costs[now], ~now
            current = cost[cells] == spent  # the others were reached more cheaply meanwhile
            cells, spent = cells[current], spent[current]
            work += COST_OF_ROUND + len(cells)
            yield from work_steps(work // CELLS_PER_SPREAD, 1)
            work %= CELLS_PER_SPREAD
            reached, paid = self._relax(price, cost, cells, spent)
            waiting = np.concatenate((waiting[later], reached))
            costs = np.concatenate((costs[later], paid))
            keys = np.concatenate((keys[later], paid + self._ahead(reached, goal)))

    def _relax(
        self,
        price: NDArray[np.float32],
        cost: NDArray[np.float32],
        cells: NDArray[np.intp],
        spent: NDArray[np.float32],
    ) -> tuple[NDArray[np.intp], NDArray[np.float32]]:
        """Go on from `cells`, which have cost `spent`: the cells that were reached more cheaply than before, and their costs."""
        beside = cells + self._steps[:, None]
        new = spent + (price[cells] + price[beside]) * self._halves[:, None]
        reached, paid = [], []
        for there, costs in zip(beside, new, strict=True):  # in one direction each cell comes once
            better = costs < cost[there]
            reached.append(there[better])
            paid.append(costs[better])
            cost[reached[-1]] = paid[-1]
        return np.concatenate(reached), np.concatenate(paid)

    def way(self, goal: Cell) -> NDArray[np.intp]:
        """Rows and columns of the cheapest way to `goal`, both ends included, shape (n, 2); empty when there is none."""
        price, cost = self._price.ravel(), self._cost.ravel()
        at, start = self._index(goal), self._index(self._start)
        if not math.isfinite(cost[at]):
            return np.empty((0, 2), dtype=np.intp)
        chain = [at]
        while at != start:
            beside = at + self._steps
            total = cost[beside] + (price[at] + price[beside]) * self._halves
            at = int(beside[total.argmin()])
            chain.append(at)
        return np.column_stack(np.divmod(np.array(chain[::-1]), self._width)) - 1

    def _ahead(self, cells: NDArray[np.intp], goal: Cell | None) -> NDArray[np.float32]:
        """What the rest of the way to `goal` costs at least."""
        if goal is None:
            return np.zeros(len(cells), dtype=np.float32)
        rows, columns = np.divmod(cells, self._width)
        up, across = np.abs(rows - goal[0] - 1), np.abs(columns - goal[1] - 1)
        # a little less than it is, since sums of such numbers are not exact
        least = np.maximum(up, across) + (0.999 * (DIAGONAL - 1.0)) * np.minimum(up, across)
        return np.asarray(0.999 * least, dtype=np.float32)

    def _index(self, cell: Cell) -> int:
        return (cell[0] + 1) * self._width + cell[1] + 1
