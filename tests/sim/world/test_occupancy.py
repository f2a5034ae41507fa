from __future__ import annotations

import numpy as np
import pytest

from sim.world.occupancy import occupancy
from sim.world.world_files import load


@pytest.fixture(scope="module")
def grid():
    return occupancy(load("parking_lot"), 12.5)


def cell(grid, x, y):
    info = grid.info
    column = int((x - info.origin.position.x) / info.resolution)
    row = int((y - info.origin.position.y) / info.resolution)
    return grid.data[row * info.width + column]


def test_the_grid_covers_the_lot_in_the_frame_map_at_a_tenth_of_a_metre(grid):
    assert (grid.header.frame_id, grid.info.resolution) == ("map", 0.1)
    assert (grid.info.width, grid.info.height) == (420, 320)
    assert len(grid.data) == 420 * 320
    assert grid.info.map_load_time.seconds == 12.5


@pytest.mark.parametrize(
    ("what", "x", "y", "value"),
    [
        ("the start", -17.5, -12.0, 0),
        ("an aisle", 0.0, 7.5, 0),
        ("a parked car", -13.75, 12.6, 100),
        ("a lamp's foot", 0.0, 0.0, 100),
        ("the north wall", 3.0, 15.1, 100),
        ("the lawn", 0.0, 15.8, -1),
        ("a cone", 4.2, 7.15, 0),
        ("a bay line", -10.0, -12.0, 0),
    ],
)
def test_a_cell_says_what_stands_there(grid, what, x, y, value):
    assert cell(grid, x, y) == value, what


def test_a_turned_cars_outline_is_as_large_as_the_car(grid):
    world = load("parking_lot")
    car = world.cars[0]
    full = np.array(grid.data).reshape(grid.info.height, grid.info.width) == 100
    columns = np.arange(grid.info.width) * 0.1 + grid.info.origin.position.x + 0.05
    rows = np.arange(grid.info.height) * 0.1 + grid.info.origin.position.y + 0.05
    near = full[np.ix_(np.abs(rows - car.y) < 2.2, np.abs(columns - car.x) < 1.2)]
    assert near.any(axis=1).sum() * 0.1 == pytest.approx(3.9, abs=0.2)
    assert near.any(axis=0).sum() * 0.1 == pytest.approx(1.72, abs=0.2)


def test_cells_that_are_moved_show_the_same_world(grid):
    moved = occupancy(load("parking_lot"), 0.0, (0.04, -0.03))
    origin, known = moved.info.origin.position, grid.info.origin.position
    assert (origin.x - known.x, origin.y - known.y) == (pytest.approx(0.04), pytest.approx(-0.03))
    assert cell(moved, -13.75, 12.6) == 100
    assert cell(moved, 0.0, 7.5) == 0
    assert moved.data != grid.data


def test_both_walls_of_a_corridor_are_drawn_as_far_from_its_middle():
    grid = occupancy(load("office"), 0.0)
    info = grid.info
    full = np.array(grid.data).reshape(info.height, info.width) == 100
    middles = np.arange(info.height) * info.resolution + info.origin.position.y + info.resolution / 2
    column = int((-5.5 - info.origin.position.x) / info.resolution)
    walls = middles[full[:, column]]
    assert walls[walls > 0].min() == pytest.approx(1.15)
    assert walls[walls < 0].max() == pytest.approx(-1.15)


@pytest.mark.parametrize(("height", "value"), [(0.4, 0), (0.92, 0), (0.96, 100), (1.1, 100)])
def test_what_hangs_lower_than_the_robot_is_tall_is_an_obstacle(height, value):
    """An orange on the tree at (-8.0, 4.5) that reaches down to 1.00 m; 0.05 m are kept over the robot."""
    orange = (-8.75, 4.26)
    assert cell(occupancy(load("orchard"), 0.0, height=height), *orange) == value
