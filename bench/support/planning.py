"""Longest update of the navigator while it plans a way, during which the robot's computer processes no message."""

from __future__ import annotations

import gc
import math
import time

import numpy as np

from robotside.core.pose2 import Pose2
from robotside.core.robot import Robot
from robotside.mapping.obstacle_memory import LIFETIME
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Goal, LegState, Navigator
from sim.world.occupancy import occupancy
from sim.world.world_files import load

__all__ = ["DEEP", "LAKE", "SHALLOW", "lake", "longest", "trap"]

PERIOD = 0.05
MAX_TIME = 60.0
"""A way is looked for no longer than this [s]."""

LAKE = ((-30.0, -20.0), (30.0, 20.0))
"""From the one corner of the lake to the other [m]."""


DEEP, SHALLOW = ((95.0, 40.0), (140.0, 40.0)), ((30.0, 40.0), (140.0, 40.0))
"""From far within the bend, and from near its opening, to behind the wall [m]; a truck finds no way from far within."""


def lake() -> Grid:
    """The map of the lake."""
    return Grid.from_msg(occupancy(load("lake"), 0.0))


def trap() -> Grid:
    """A hall of 150 x 80 m with a long wall whose ends are bent back by 80 m: who is within them must first go back."""
    cell = 0.05
    full = np.zeros((round(80 / cell), round(150 / cell)), dtype=np.bool_)
    for edge in (full[:8], full[-8:], full[:, :8], full[:, -8:]):
        edge[...] = True
    right, low, high, thick = round(100 / cell), round(6 / cell), round(74 / cell), round(0.4 / cell)
    full[low:high, right : right + thick] = True
    for row in (low, high - thick):
        full[row : row + thick, round(20 / cell) : right] = True
    return Grid(full, cell, 0.0, 0.0)


def longest(robot: Robot, grid: Grid, way: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """CPU time of the longest update until there is a way, with something on it that the map does not know [s]."""
    (x, y), (to_x, to_y) = way
    navigator = Navigator(robot, grid, lambda _: None)
    pose = Pose2(x, y, math.atan2(to_y - y, to_x - x))
    ahead = np.column_stack([np.full(20, 2.0), np.linspace(-1.0, 1.0, 20)])
    navigator.obstacles.update(pose.apply(ahead), LIFETIME)
    navigator.head_for(Goal("The goal", to_x, to_y))
    gc.collect()
    gc.freeze()  # what else the bench holds is nothing that the robot's collector looks through
    try:
        return _longest(navigator, pose)
    finally:
        gc.unfreeze()


def _longest(navigator: Navigator, pose: Pose2) -> float:
    spent, now, nothing = 0.0, 0.0, np.empty((0, 2))
    while not navigator.controller.under_way:
        now += PERIOD
        began = time.process_time()
        leg = navigator.update(pose, nothing, now)
        spent = max(spent, time.process_time() - began)
        if leg is LegState.BLOCKED or now > MAX_TIME:
            raise RuntimeError(navigator.reason or f"No way was found in {MAX_TIME:.0f} s.")
    return spent
