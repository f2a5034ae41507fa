"""Ways that a truck can drive."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.lattice_planner import LatticePlanner
from robotside.navigation.path_controller import Piece

BEND = 0.25
DISCS, RADIUS, MARGIN = (0.0, 1.0, 2.0), 0.95, 0.15
OPEN = Grid(np.zeros((300, 300), dtype=np.bool_), 0.1, -15.0, -15.0)


def lattice(grid: Grid = OPEN) -> LatticePlanner:
    return LatticePlanner(grid, BEND, DISCS, RADIUS, MARGIN)


def walled(*boxes: tuple[float, float, float, float]) -> Grid:
    """West, south, east and north of what stands there."""
    occupied = OPEN.occupied.copy()
    for west, south, east, north in boxes:
        rows = slice(round((south + 15) * 10), round((north + 15) * 10))
        occupied[rows, round((west + 15) * 10) : round((east + 15) * 10)] = True
    return Grid(occupied, 0.1, -15.0, -15.0)


def tightest(piece: Piece) -> float:
    """Of its bends [1/m]."""
    steps = np.diff(piece.points[:: 1 if len(piece.points) < 10 else 5], axis=0)
    yaws = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    lengths = np.hypot(*steps.T)
    return float(np.abs(np.diff(yaws) / (lengths[1:] + lengths[:-1]) * 2).max()) if len(yaws) > 1 else 0.0


@pytest.mark.parametrize("goal", [(10.0, 0.0), (3.0, 9.0), (-8.0, 5.0), (-6.0, -6.0), (0.5, 3.0)])
def test_it_reaches_any_place_with_no_bend_tighter_than_it_drives(goal: tuple[float, float]) -> None:
    pieces = lattice().way(Pose2(0.0, 0.0, 0.0), (*goal, math.nan))
    assert math.dist(pieces[-1].points[-1], goal) < 0.05
    assert max(map(tightest, pieces)) < BEND * 1.15
    for one, other in itertools.pairwise(pieces):
        assert one.ahead is not other.ahead
        assert one.points[-1].tolist() == other.points[0].tolist()


def test_it_comes_in_from_where_it_is_to_look_the_way_that_is_asked_for() -> None:
    pieces = lattice().way(Pose2(0.0, 0.0, 0.0), (6.0, 6.0, math.pi))
    (x, y), (bx, by) = pieces[-1].points[-1], pieces[-1].points[-3]
    sense = 1.0 if pieces[-1].ahead else -1.0
    assert math.cos(math.atan2(sense * (y - by), sense * (x - bx)) - math.pi) > 0.99


def test_it_backs_out_of_a_blind_alley() -> None:
    alley = walled((-6.0, 1.4, 4.5, 2.0), (-6.0, -2.0, 4.5, -1.4), (4.0, -2.0, 4.5, 2.0))
    pieces = lattice(alley).way(Pose2(0.0, 0.0, 0.0), (10.0, 0.0, math.nan))
    assert not pieces[0].ahead
    assert pieces[-1].ahead


def test_the_body_ahead_of_the_axle_keeps_off_what_stands_there() -> None:
    grid = walled((4.0, -1.0, 6.0, 3.0))
    pieces = lattice(grid).way(Pose2(-4.0, 0.0, 0.0), (11.0, 0.0, math.nan))
    for piece in pieces:
        steps = np.gradient(piece.points, axis=0)
        yaw = np.arctan2(steps[:, 1], steps[:, 0]) + (0.0 if piece.ahead else math.pi)
        for disc in DISCS:
            places = piece.points + disc * np.column_stack([np.cos(yaw), np.sin(yaw)])
            assert grid.clearance(places).min() > RADIUS + MARGIN - 0.12


def test_there_may_be_no_way() -> None:
    closed = walled(
        (5.0, -4.0, 11.0, -3.5), (5.0, 3.5, 11.0, 4.0), (5.0, -4.0, 5.5, 4.0), (10.5, -4.0, 11.0, 4.0)
    )
    assert lattice(closed).way(Pose2(-4.0, 0.0, 0.0), (8.0, 0.0, math.nan)) == []
