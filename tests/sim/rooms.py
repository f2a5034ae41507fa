"""Small worlds for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sim.robot import SimRobot
from sim.simulation import Simulation
from sim.vehicles.patrol import PATROL
from sim.world import World, parse

ROOM = """
name = "room"
description = "An empty room"
[datum]
latitude = 45.0
longitude = -73.0
[ground]
length = {length}
width = {width}
[wall]
height = 0.5
thickness = 0.2
[start]
x = {x}
y = {y}
yaw = {yaw}
"""


def room(
    length: float = 40.0, width: float = 40.0, x: float = 0.0, y: float = 0.0, yaw: float = 0.0
) -> World:
    """An empty room with walls, the robot at (x, y) [m] facing `yaw` [deg]."""
    return parse(ROOM.format(length=length, width=width, x=x, y=y, yaw=yaw), "room.toml")


def robot_in(world: World, *, seed: int = 0, noise: bool = False) -> SimRobot:
    """The patrol robot without camera, exact unless `noise`; its clock has been started at 0."""
    robot = SimRobot(Simulation(world, PATROL, seed=seed, noise=noise), camera=False)
    robot.read(0.0)
    return robot


def orange(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which pixels are as orange as a traffic cone."""
    red, green, blue = (picture[:, :, i].astype(int) for i in range(3))
    return (red > 150) & (red - green > 60) & (green - blue > 25)
