"""Paths on the map."""

from __future__ import annotations

import math
from collections.abc import Generator

import numpy as np
import pytest

from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.planner import PREFERRED_MARGIN, STEP, Planner, Unreachable
from tests.fakes import Box, FakeRobot

RADIUS = 0.18


def planner(*boxes: Box, resolution: float = 0.1) -> Planner:
    return Planner(Grid.from_msg(FakeRobot(boxes=boxes).map(resolution)), RADIUS)


def to_its_end(search: Generator[None, None, Grid]) -> Grid:
    while True:
        try:
            next(search)
        except StopIteration as found:
            value: Grid = found.value
            return value


def length(path: np.ndarray) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def test_in_the_open_the_path_is_straight() -> None:
    path = planner().plan((-5.0, 0.0), (5.0, 2.0), "Point 1")
    assert path[0].tolist() == [-5.0, 0.0]
    assert path[-1].tolist() == [5.0, 2.0]
    assert length(path) == pytest.approx(math.hypot(10.0, 2.0))
    assert np.hypot(*np.diff(path, axis=0).T).max() <= STEP + 1e-9


def test_round_a_box_the_path_keeps_its_distance_and_is_not_much_longer_than_needed() -> None:
    plans = planner(Box(-1.0, -2.0, 1.0, 2.0))
    path = plans.plan((-5.0, 0.0), (5.0, 0.0), "Point 1")
    assert plans.grid.clearance(path).min() > RADIUS + 0.7 * PREFERRED_MARGIN
    corner = 2.0 + RADIUS + PREFERRED_MARGIN
    assert length(path) < 1.1 * (2 * math.hypot(4.0, corner) + 2.0)


def test_a_narrow_gap_is_used_where_there_is_no_other_way() -> None:
    plans = planner(Box(-0.5, -6.0, 0.5, -0.5), Box(-0.5, 0.5, 0.5, 6.0))
    path = plans.plan((-5.0, 3.0), (5.0, 3.0), "Point 1")
    assert plans.grid.clearance(path).min() > RADIUS


@pytest.mark.parametrize("at", [0.0, 0.03, -0.47])
@pytest.mark.parametrize("clearance", [0.02, 0.05, 0.12, 0.3, 0.5])
def test_which_gaps_are_passed_is_a_matter_of_body_and_clearance_to_a_few_centimetres(
    clearance: float, at: float
) -> None:
    """Posts that are not on the map stand across the hall; the way through them is measured against their places."""
    plans = Planner(Grid.from_msg(FakeRobot().map()), RADIUS, clearance)
    for wider in (0.02, -0.03):
        width = 2 * (RADIUS + clearance) + wider
        sides = np.concatenate([np.arange(at + width / 2, 6.0, 0.08), np.arange(at - width / 2, -6.0, -0.08)])
        posts = np.column_stack([np.zeros(len(sides)), sides])
        if wider > 0:
            way = plans.plan((-3.0, 0.5), (3.0, 0.0), "Point 1", posts)
            apart = np.hypot(way[:, None, 0] - posts[:, 0], way[:, None, 1] - posts[:, 1]).min()
            assert apart > RADIUS + clearance - 0.02
        else:
            with pytest.raises(Unreachable, match=f"and the robot needs {2 * (RADIUS + clearance):.2f} m"):
                plans.plan((-3.0, 0.5), (3.0, 0.0), "Point 1", posts)


def test_a_robot_right_before_a_gap_that_is_too_narrow_does_not_take_it_for_its_way_out() -> None:
    sides = np.concatenate([np.arange(0.2, 6.0, 0.08), np.arange(-0.2, -6.0, -0.08)])
    posts = np.column_stack([np.zeros(len(sides)), sides])
    with pytest.raises(Unreachable, match=r"is 0.40 m wide and the robot needs 0.46 m"):
        planner().plan((-0.45, 0.0), (3.0, 0.0), "Point 1", posts)


def test_obstacles_that_are_not_on_the_map_are_avoided() -> None:
    seen = np.array([[0.0, y] for y in np.arange(-0.5, 0.6, 0.1)])
    path = planner().plan((-5.0, 0.0), (5.0, 0.0), "Point 1", seen)
    gaps = np.hypot(path[:, None, 0] - seen[None, :, 0], path[:, None, 1] - seen[None, :, 1])
    assert gaps.min() > RADIUS + 0.2


@pytest.mark.parametrize(
    ("x", "y", "said"),
    [
        (0.0, 0.0, "Point 3 at (0.0, 0.0) is in a wall or another obstacle."),
        (0.0, 1.15, "Point 3 at (0.0, 1.1) is 0.15 m from an obstacle; the robot needs 0.26 m."),
        (50.0, 0.0, "Point 3 at (50.0, 0.0) is off the map."),
        (math.inf, 0.0, "Point 3 at (inf, 0.0) is off the map."),
        (1e308, -1e6, "Point 3 at (1e+308, -1e+06) is off the map."),
        (0.0, 3.0, ""),
    ],
)
def test_where_it_cannot_stand_is_said_with_name_and_place(x: float, y: float, said: str) -> None:
    assert planner(Box(-1.0, -1.0, 1.0, 1.0)).fault("Point 3", x, y) == said


@pytest.mark.parametrize("far", [12.0, 1e6, 1e308, math.inf, math.nan])
def test_a_start_or_goal_off_the_map_is_unreachable_however_far_it_is(far: float) -> None:
    with pytest.raises(Unreachable, match=r"The robot at \(.*, 0\.0\) is off the map\."):
        planner().plan((far, 0.0), (5.0, 0.0), "Point 1")
    with pytest.raises(Unreachable, match=r"Point 1 at \(5\.0, .*\) is off the map\."):
        planner().plan((5.0, 0.0), (5.0, far), "Point 1")


def test_a_closed_room_is_unreachable() -> None:
    walls = Box(2.0, -6.0, 2.5, 6.0)
    with pytest.raises(Unreachable, match=r"There is no way to Point 2 at \(5.0, 0.0\)\."):
        planner(walls).plan((-5.0, 0.0), (5.0, 0.0), "Point 2")


def test_a_goal_that_something_new_stands_on_is_unreachable() -> None:
    with pytest.raises(Unreachable, match=r"The way to Point 2 at \(5.0, 0.0\) is blocked at \(5.0, 0.1\)"):
        planner().plan((-5.0, 0.0), (5.0, 0.0), "Point 2", np.array([[5.0, 0.1]]))


def test_a_robot_that_stands_too_close_to_a_wall_finds_its_way_off() -> None:
    plans = planner(Box(-1.0, -1.0, 1.0, 1.0))
    path = plans.plan((0.0, 1.15), (5.0, 0.0), "Point 1")
    assert plans.grid.clearance(path[10:]).min() > RADIUS


def test_a_fine_map_is_searched_in_coarser_cells() -> None:
    assert planner(resolution=0.025).grid.resolution == pytest.approx(0.1)


def test_unknown_cells_are_no_place_to_go() -> None:
    msg = FakeRobot().map()
    data = np.array(msg.data, dtype=np.int8).reshape(msg.info.height, msg.info.width)
    data[:, 100:110] = -1
    grid = Grid(data != 0, 0.1, -11.0, -7.0)
    assert not grid.occupied[60, 99]
    assert Planner(grid, RADIUS).fault("Point 1", -0.5, 0.0)


def test_what_is_new_is_as_near_on_the_marked_map_as_on_one_that_is_looked_at_as_a_whole() -> None:
    grid = Grid.from_msg(FakeRobot(boxes=(Box(-1.0, -1.0, 1.0, 1.0),)).map(0.1))
    seen = np.array([[-3.0, 2.0], [-2.9, 2.0], [4.0, -4.0], [10.95, 6.9], [50.0, 0.0]])
    quick, whole = to_its_end(grid.seeing(seen, 1.2)), grid.marked(seen)
    assert (quick.occupied == whole.occupied).all()
    near = whole.distance < 1.2
    assert np.allclose(quick.distance[near], whole.distance[near])
    assert (quick.distance[~near] >= 1.2).all()
