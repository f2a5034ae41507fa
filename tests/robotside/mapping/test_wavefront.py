"""The cheapest ways over a grid, found bit by bit."""

from __future__ import annotations

import heapq
import math

import numpy as np
import pytest
from numpy.typing import NDArray

from robotside.mapping.wavefront import Cell, Wavefront

ROWS, COLUMNS = 24, 31


def prices(seed: int) -> NDArray[np.float64]:
    """Of a map with walls and dear places."""
    rng = np.random.default_rng(seed)
    price = rng.choice([1.0, 1.0, 2.5, 9.0, math.inf], (ROWS, COLUMNS))
    price[0, 0] = price[-1, -1] = 1.0
    return price


def plainly(price: NDArray[np.float64], start: Cell) -> NDArray[np.float64]:
    """The cost of every cell, one after the other."""
    cost = np.full(price.shape, math.inf)
    cost[start] = 0.0
    queue = [(0.0, start)]
    while queue:
        spent, (row, column) = heapq.heappop(queue)
        for i in range(max(0, row - 1), min(ROWS, row + 2)):
            for j in range(max(0, column - 1), min(COLUMNS, column + 2)):
                paid = spent + (price[row, column] + price[i, j]) / 2 * math.hypot(i - row, j - column)
                if paid < cost[i, j]:
                    cost[i, j] = paid
                    heapq.heappush(queue, (paid, (i, j)))
    return cost


def wave(price: NDArray[np.float64], start: Cell = (0, 0)) -> Wavefront:
    found = Wavefront(price.shape, start)
    found.price[:] = price
    return found


@pytest.mark.parametrize("seed", range(4))
def test_it_costs_as_much_to_each_cell_as_looking_at_one_after_the_other_finds(seed: int) -> None:
    spread = wave(prices(seed))
    list(spread.spread())
    assert np.allclose(spread.cost, plainly(prices(seed), (0, 0)), rtol=1e-5)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("goal", [(ROWS - 1, COLUMNS - 1), (0, COLUMNS - 1), (12, 3)])
def test_towards_a_goal_it_finds_the_cheapest_way_too(seed: int, goal: Cell) -> None:
    price = prices(seed)
    price[goal] = 1.0
    towards = wave(price)
    list(towards.spread(goal))
    way = towards.way(goal)
    wanted = plainly(price, (0, 0))[goal]
    if math.isinf(wanted):
        assert len(way) == 0
        return
    along = price[way[:, 0], way[:, 1]]
    lengths = np.hypot(*np.diff(way, axis=0).T)
    assert lengths.max() < 1.5
    assert (way[0].tolist(), way[-1].tolist()) == ([0, 0], list(goal))
    assert ((along[1:] + along[:-1]) / 2 * lengths).sum() == pytest.approx(wanted, rel=1e-4)


def test_it_does_not_look_at_all_the_map_for_a_goal_that_is_near() -> None:
    near = wave(np.ones((ROWS, COLUMNS)), (12, 10))
    list(near.spread((12, 16)))
    assert np.isfinite(near.cost).sum() < 100


def test_no_way_leads_over_the_edge() -> None:
    price = np.ones((ROWS, COLUMNS))
    price[:, 15] = math.inf
    walled = wave(price)
    list(walled.spread((12, 20)))
    assert len(walled.way((12, 20))) == 0
    assert np.isfinite(walled.cost).sum() == ROWS * 15


def test_a_large_map_takes_more_steps_and_no_larger_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    most = []
    relax = Wavefront._relax

    def counted(self: Wavefront, *words: NDArray[np.float32]) -> object:
        most.append(words[2].size)
        return relax(self, *words)  # type: ignore[arg-type]

    monkeypatch.setattr(Wavefront, "_relax", counted)
    steps = {side: sum(1 for _ in wave(np.ones((side, side))).spread()) for side in (100, 400)}
    assert steps[400] > 5 * steps[100]
    assert sum(most) / sum(steps.values()) < 1_500
