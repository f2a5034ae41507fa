"""Going on wheels where nothing leads on."""

from __future__ import annotations

import math

import numpy as np

from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import completed
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.differential_controller import (
    BACKING_SPEED,
    BACKING_STEPS,
    MAX_STANDING_STEPS,
    DifferentialController,
)
from robotside.navigation.planner import Planner
from tests.fakes import FakeRobot

GRID = Grid(np.zeros((100, 100), dtype=np.bool_), 0.1, -5.0, -5.0)
RING = np.linspace(-1.2, 1.2, 40)
AHEAD = 0.45 * np.column_stack([np.cos(RING), np.sin(RING)])


def steered(points: Points, times: int) -> list[float]:
    """How fast it was told to go each time, with something at `points`, wherever it is [m/s]."""
    robot = FakeRobot()
    controller = DifferentialController(robot)
    start, goal = Pose2(0.0, 0.0, 0.0), (4.0, 0.0, math.nan)
    controller.follow(
        completed(controller.search(Planner(GRID, 0.18), start, goal, "The goal", np.empty((0, 2))))
    )
    speeds = []
    for _ in range(times):
        controller.steer(Pose2(0.0, 0.0, 0.0), points, sure=True)
        speeds.append(robot.twist.linear.x)
    return speeds


def test_after_a_while_it_makes_room_behind_it_and_tries_again() -> None:
    speeds = steered(AHEAD, MAX_STANDING_STEPS + BACKING_STEPS + 10)
    assert speeds[:MAX_STANDING_STEPS] == [0.0] * MAX_STANDING_STEPS
    assert speeds[MAX_STANDING_STEPS : MAX_STANDING_STEPS + BACKING_STEPS] == [-BACKING_SPEED] * BACKING_STEPS
    assert speeds[-5:] == [0.0] * 5


def test_it_stands_where_there_is_no_room_behind_it_either() -> None:
    speeds = steered(np.concatenate([AHEAD, -AHEAD]), MAX_STANDING_STEPS + 20)
    assert set(speeds) == {0.0}
