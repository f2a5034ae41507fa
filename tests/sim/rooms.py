"""Small worlds for tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bridge.msgs import Msg
from sim.robot import SimRobot
from sim.simulation.simulation import Simulation
from sim.vehicles.model import Model
from sim.vehicles.patrol import PATROL
from sim.world.world import World
from sim.world.world_files import parse

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
    length: float = 40.0,
    width: float = 40.0,
    x: float = 0.0,
    y: float = 0.0,
    yaw: float = 0.0,
    extra: str = "",
    *,
    height: float = 0.5,
) -> World:
    """An empty room with walls of `height` [m], the robot at (x, y) [m] facing `yaw` [deg]; `extra` is more TOML."""
    text = ROOM.replace("height = 0.5", f"height = {height}")
    return parse(text.format(length=length, width=width, x=x, y=y, yaw=yaw) + extra, "room.toml")


def plain(extra: str = "", z: float = 0.0) -> World:
    """Level ground without end and without anything on it, the robot at height `z` [m]; `extra` is more TOML."""
    text = ROOM.replace("[wall]\nheight = 0.5\nthickness = 0.2\n", "").replace("[start]", f"[start]\nz = {z}")
    return parse(text.format(length=10.0, width=10.0, x=0.0, y=0.0, yaw=0.0) + extra, "plain.toml")


def alone(model: Model, world: World, *, seed: int = 0, noise: bool = False) -> SimRobot:
    """A robot of `model` without camera, exact unless `noise`; its clock has been started at 0."""
    robot = SimRobot(Simulation(world, model, seed=seed, noise=noise), camera=False)
    robot.read(0.0)
    return robot


def until(robot: SimRobot, seconds: float) -> list[tuple[str, Msg]]:
    """Everything measured in the next `seconds`."""
    return robot.read(robot.simulation.time + seconds)


def robot_in(world: World, *, seed: int = 0, noise: bool = False) -> SimRobot:
    """The patrol robot without camera, exact unless `noise`; its clock has been started at 0."""
    return alone(PATROL, world, seed=seed, noise=noise)


def orange(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which pixels are as orange as a traffic cone."""
    red, green, blue = (picture[:, :, i].astype(int) for i in range(3))
    return (red > 150) & (red - green > 60) & (green - blue > 25)
