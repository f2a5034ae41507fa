"""What is seen that is not on the map."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.mapping.obstacle_memory import (
    LIFETIME,
    MAX_ASIDE,
    MIN_CLEARANCE,
    SONAR_CLEARANCE_LIFETIME,
    ObstacleMemory,
)
from robotside.mapping.occupancy_grid import Grid
from robotside.mapping.sight import BeamSight

GRID = Grid(np.pad(np.zeros((80, 80), dtype=np.bool_), 2, constant_values=True), 0.1, -4.2, -4.2)
MIDDLE = np.array([[0.0, 0.0]])


def test_it_is_remembered_for_a_while_and_for_a_shorter_one_where_it_was_seen_vaguely() -> None:
    sharp, vague = ObstacleMemory(GRID), ObstacleMemory(GRID)
    sharp.update(MIDDLE, 0.0)
    vague.update(MIDDLE, 0.0, vague=True)
    assert len(sharp.points(SONAR_CLEARANCE_LIFETIME[1] + 0.1)) == 1
    assert len(vague.points(SONAR_CLEARANCE_LIFETIME[1] - 0.1)) == 1
    assert len(vague.points(SONAR_CLEARANCE_LIFETIME[1] + 0.1)) == 0
    assert len(sharp.points(LIFETIME + 0.1)) == 0


def test_a_vague_look_does_not_shorten_what_was_seen_well() -> None:
    obstacles = ObstacleMemory(GRID)
    obstacles.update(MIDDLE, 0.0)
    obstacles.update(MIDDLE, 1.0, vague=True)
    assert len(obstacles.points(LIFETIME - 0.1)) == 1


def test_what_may_be_a_wall_of_the_map_is_nothing_new() -> None:
    aside = np.array([[4.0 - (MIN_CLEARANCE + SONAR_CLEARANCE_LIFETIME[0]) / 2, 0.0]])
    assert ObstacleMemory(GRID).fresh(aside).tolist() == [True]
    assert ObstacleMemory(GRID).fresh(aside, vague=True).tolist() == [False]


def beams(free: float | np.ndarray) -> BeamSight:
    return BeamSight(
        Pose2(-3.0, 0.0, 0.0), -math.pi, math.tau / 360, np.broadcast_to(free, (360,)).astype(float)
    )


def test_what_was_taken_away_is_forgotten_as_soon_as_two_sweeps_see_through_it() -> None:
    obstacles, none = ObstacleMemory(GRID), np.empty((0, 2))
    obstacles.update(MIDDLE, 0.0, sight=beams(3.0))
    obstacles.update(none, 0.1, sight=beams(6.0))
    assert len(obstacles.points(0.1)) == 1
    obstacles.update(none, 0.2, sight=beams(6.0))
    assert len(obstacles.points(0.2)) == 0


def test_what_is_seen_again_between_two_sweeps_that_missed_it_stays() -> None:
    obstacles, none = ObstacleMemory(GRID), np.empty((0, 2))
    obstacles.update(MIDDLE, 0.0)
    for sweep in range(10):
        missed = sweep % 2 == 0
        obstacles.update(none if missed else MIDDLE, 0.1 * sweep, sight=beams(6.0 if missed else 3.0))
    assert len(obstacles.points(1.0)) == 1


BEYOND, SHORT_OF, JUST_BEHIND = 6.0, 2.0, 3.1
"""A sweep that sees through what is 3 m away, one that another thing hides it from, and one that meets something 0.1 m behind."""


def sees(sweeps: list[float]) -> list[bool]:
    """Whether what stands 3 m away is remembered after each of these sweeps that see nothing new."""
    obstacles, none = ObstacleMemory(GRID), np.empty((0, 2))
    obstacles.update(MIDDLE, 0.0)
    known = []
    for number, free in enumerate(sweeps):
        obstacles.update(none, 0.1 * number, sight=beams(free))
        known.append(len(obstacles.points(0.1 * number)) == 1)
    return known


def test_two_sweeps_that_see_through_it_count_only_in_a_row() -> None:
    assert sees([BEYOND, SHORT_OF] * 5) == [True] * 10
    assert sees([BEYOND, SHORT_OF, BEYOND, BEYOND]) == [True, True, True, False]


def test_what_is_met_only_close_by_is_forgotten_after_some_sweeps() -> None:
    assert sees([JUST_BEHIND] * (MAX_ASIDE + 1)) == [True] * MAX_ASIDE + [False]


def test_what_is_met_right_there_once_is_not_forgotten_for_what_was_met_close_by_before() -> None:
    obstacles, none = ObstacleMemory(GRID), np.empty((0, 2))
    for sweep in range(4 * MAX_ASIDE):
        met = sweep % MAX_ASIDE == 0
        obstacles.update(MIDDLE if met else none, 0.1 * sweep, sight=beams(3.0 if met else JUST_BEHIND))
    assert len(obstacles.points(3.0)) == 1
    obstacles.update(MIDDLE, 3.0)
    obstacles.update(none, 3.1, sight=beams(BEYOND))
    obstacles.update(MIDDLE, 3.2)  # met where no sight is told
    obstacles.update(none, 3.3, sight=beams(BEYOND))
    assert len(obstacles.points(3.3)) == 1


def test_what_another_thing_hides_stays() -> None:
    obstacles, none = ObstacleMemory(GRID), np.empty((0, 2))
    obstacles.update(np.array([[0.0, 0.0], [0.0, 2.0]]), 0.0)
    free = np.full(360, 8.0)
    free[170:190] = 1.0  # something stands before the first one
    for sweep in range(5):
        obstacles.update(none, 0.1 * sweep, sight=beams(free))
    assert obstacles.points(0.5).tolist() == [[0.0, 0.0]]


def test_a_place_follows_what_is_seen_of_it() -> None:
    obstacles = ObstacleMemory(GRID)
    obstacles.update(np.array([[0.03, 0.0]]), 0.0)
    obstacles.update(np.array([[0.04, 0.01], [1.0, 1.0]]), 0.1)
    assert obstacles.points(0.2) == pytest.approx(np.array([[0.034, 0.004], [1.0, 1.0]]))


def test_near_a_way_are_those_within_reach_of_its_points() -> None:
    obstacles = ObstacleMemory(GRID)
    obstacles.update(np.array([[0.0, 0.0], [1.0, 0.3], [3.0, 0.0], [-3.0, -3.0]]), 0.0)
    path = np.column_stack([np.arange(-1.0, 2.0, 0.1), np.zeros(30)])
    assert obstacles.near(path, 0.4, 1.0).tolist() == [[0.0, 0.0], [1.0, 0.3]]
    assert not len(obstacles.near(path[:0], 0.4, 1.0))
