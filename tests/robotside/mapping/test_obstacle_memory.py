"""What is seen that is not on the map."""

from __future__ import annotations

import numpy as np

from robotside.mapping.obstacle_memory import (
    LIFETIME,
    MIN_CLEARANCE,
    SONAR_CLEARANCE_LIFETIME,
    ObstacleMemory,
)
from robotside.mapping.occupancy_grid import Grid

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
