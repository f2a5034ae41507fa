"""The map to plan on that a fence leaves."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from robotside.core.config import Ring
from robotside.limits.fence import Fence
from robotside.mapping.occupancy_grid import Grid


def box(west: float, south: float, east: float, north: float) -> Ring:
    return ((west, south), (east, south), (east, north), (west, north))


HALL = box(0.0, 0.0, 10.0, 6.0)
HOLE = box(4.0, 2.0, 6.0, 4.0)


def open_map(resolution: float = 0.1) -> Grid:
    size = round(16 / resolution)
    return Grid(np.zeros((size, size), dtype=np.bool_), resolution, -3.0, -3.0)


def test_a_map_is_marked_wherever_one_may_not_be_so_that_plans_lead_round_it() -> None:
    marked = Fence([HALL], [HOLE]).marked(open_map())
    assert not marked.occupied[marked.cell(3.05, 3.0)]
    assert marked.occupied[marked.cell(5.0, 3.0)]
    assert marked.occupied[marked.cell(-0.6, 3.0)]
    assert not marked.occupied[marked.cell(0.25, 3.0)]
    wider = Fence([HALL], [HOLE]).marked(open_map(), 0.3)
    assert wider.occupied[wider.cell(0.25, 3.0)]
    assert not wider.occupied[wider.cell(0.55, 3.0)]


def test_a_wall_thinner_than_a_cell_is_marked_as_well() -> None:
    marked = Fence([HALL], [box(5.02, 1.0, 5.03, 5.0)]).marked(open_map())
    assert all(marked.occupied[marked.cell(5.025, y)] for y in np.arange(1.0, 5.0, 0.1))


def test_without_areas_a_map_stays_what_it_is() -> None:
    grid = open_map()
    assert Fence().marked(grid) is grid


def test_what_is_occupied_on_the_map_stays_so() -> None:
    grid = open_map().marked(np.array([[2.05, 2.05]]))
    assert Fence([HALL]).marked(grid).occupied[grid.cell(2.05, 2.05)]


PLACES = st.floats(-3.0, 13.0)


@given(PLACES, PLACES, st.lists(st.floats(0.3, 6.0), min_size=3, max_size=9))
def test_a_whole_map_is_marked_as_each_of_its_cells_would_be(x: float, y: float, reach: list[float]) -> None:
    turns = [math.tau * number / len(reach) for number in range(len(reach))]
    star = tuple((x + r * math.cos(a), y + r * math.sin(a)) for r, a in zip(reach, turns, strict=True))
    fence, grid = Fence([HALL], [star]), open_map(0.5)
    marked = fence.marked(grid)
    centres = np.array([grid.centre(row, column) for row in range(32) for column in range(32)])
    clear = np.abs(fence.clearance(centres)) > grid.resolution
    assert (marked.occupied.ravel()[clear] == ~fence.allows(centres)[clear]).all()
