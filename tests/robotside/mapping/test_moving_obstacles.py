"""What moves by itself among what is seen."""

from __future__ import annotations

import numpy as np

from robotside.mapping.moving_obstacles import ROOM_SHARE, MovingObstacles

WALL = np.column_stack([np.linspace(-3.0, 3.0, 60), np.full(60, 2.0)])


def test_who_comes_nearer_moves_and_the_wall_does_not() -> None:
    movers, moving = MovingObstacles(), np.zeros(0, dtype=np.bool_)
    for step in range(8):
        person = np.array([[2.0 - 0.08 * step, 0.0]])
        moving = movers.moving(np.concatenate([WALL, person]), 0.1 * step)
    assert moving.tolist() == [False] * 60 + [True]


def test_what_was_not_looked_at_for_long_is_not_said_to_move() -> None:
    movers = MovingObstacles()
    assert not movers.moving(WALL, 0.0).any()
    assert not movers.moving(WALL + 1.0, 5.0).any()
    assert not movers.moving(np.empty((0, 2)), 5.3).any()


def test_the_other_gets_the_rest_of_the_room() -> None:
    assert MovingObstacles.nearer(np.array([[2.0, 0.4], [9.0, 0.0]])).tolist() == [
        [2.0 * ROOM_SHARE, 0.4 * ROOM_SHARE]
    ]


def test_of_what_is_asked_for_the_same_is_said_to_move_as_of_everything() -> None:
    whole, some = MovingObstacles(), MovingObstacles()
    rng = np.random.default_rng(1)
    for step in range(12):
        placed = np.concatenate([WALL, rng.uniform(-3.0, 3.0, (40, 2))])
        asked = rng.random(len(placed)) < 0.3
        moved = whole.moving(placed, 0.1 * step)
        assert np.array_equal(some.moving(placed, 0.1 * step, asked), moved & asked)
    assert moved.any()


def test_when_nothing_is_asked_for_nothing_moves() -> None:
    movers = MovingObstacles()
    for step in range(8):
        assert not movers.moving(WALL + step, 0.1 * step, np.zeros(len(WALL), dtype=np.bool_)).any()
