"""The patrol robot driving a circle in the parking lot: physics with every sensor, one laser sweep, one picture.

CPU time of the whole process, the threads of the drawing included, without sockets. The camera rows draw the same 24
views round the robot, 640 x 480, without JPEG; the other way is pybullet's own software renderer without shadows, with
the same solids to see.
The laser's other way asks the physics for one beam at a time. The robot moves between two sweeps.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, contextmanager
from typing import Any

from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bridge.msgs.geometry_msgs import Twist, Vector3
from sim.core.constants import STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.core.shapes import from_yaw, rotate
from sim.physics.backend_bullet import Bullet
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.robot import SimRobot, make
from sim.sensors.laser import Laser
from sim.vehicles.patrol import PARAMETERS

FIGURES = (
    Figure("step", "µs", "a step of 1/240 s with every sensor but the camera"),
    Figure(
        "speed",
        "×",
        "simulated seconds a second of CPU, no camera; its limit is in `vehicles`",
        better="more",
    ),
    Figure("sweep", "ms", "a laser sweep of 360 beams", against="one call a beam"),
    Figure("picture", "ms", "a camera picture of 640 x 480", against="pybullet's TinyRenderer"),
)
REPEATS = 3

CIRCLE = Twist(linear=Vector3(x=0.5), angular=Vector3(z=0.5))
SECONDS = 10.0
"""Simulated in a repeat [s]."""
SWEEPS = 100
SIZE = (640, 480)
DIRECTIONS = 24
"""Views round the robot."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Two worlds: one to drive in, one with looks for pybullet's own renderer."""
    with closing(make("patrol", "parking_lot", camera=False)) as robot, closing(Bullet()) as drawn:
        world = robot.simulation.world
        for shape in world.visuals:
            drawn.add_looks(shape)
        robot.read(0.0)
        robot.drive(CIRCLE)
        with closing(Renderer(world)) as renderer:
            yield Sides(lambda: ours(robot, renderer), lambda: peer(robot, drawn))


def ours(robot: SimRobot, renderer: Renderer) -> dict[str, float]:
    """One sample of every figure."""
    step = driving(robot)
    laser = Laser(
        PARAMETERS.laser, robot.simulation.backend, robot.simulation.vehicle.body, Noise(0, "bench")
    )
    picture = mean(renderer.render, views(robot))
    return {
        "step": step * 1e6,
        "speed": 1 / (step * STEPS_PER_SECOND),
        "sweep": moving(robot, laser.measure, SWEEPS) * 1e3,
        "picture": picture * 1e3,
    }


def peer(robot: SimRobot, drawn: Bullet) -> dict[str, float]:
    """The sweep beam by beam, and the picture by pybullet."""
    backend, body = robot.simulation.backend, robot.simulation.vehicle.body
    reach, height = PARAMETERS.laser.range_max, PARAMETERS.laser.height
    angles = [math.tau * beam / PARAMETERS.laser.beams for beam in range(PARAMETERS.laser.beams)]
    start = backend.ray_points(body, [(0.0, 0.0, height)])
    ends = [backend.ray_points(body, [(reach * math.cos(a), reach * math.sin(a), height)]) for a in angles]

    def sweep(_: float) -> None:
        for end in ends:
            backend.rays(body, start, end)

    def picture(view: View) -> None:
        ahead = rotate(view.rotation, (1.0, 0.0, 0.0))
        target = tuple(a + b for a, b in zip(view.eye, ahead, strict=True))
        vertical = 2 * math.atan(view.half_extent[1])
        drawn.picture(view.eye, target, (0.0, 0.0, 1.0), vertical, view.size)

    return {"sweep": moving(robot, sweep, 10) * 1e3, "picture": mean(picture, views(robot)) * 1e3}


def driving(robot: SimRobot) -> float:
    """CPU time of a step [s]."""
    first = robot.simulation.steps
    started = time.process_time()
    robot.read(robot.simulation.time + SECONDS)
    return (time.process_time() - started) / (robot.simulation.steps - first)


def moving(robot: SimRobot, sweep: Callable[[float], object], count: int) -> float:
    """CPU time of one sweep of `count`, each after a step [s]: what was measured while nothing moves costs nothing."""
    sweep(0.0)
    spent = 0.0
    for _ in range(count):
        robot.simulation.advance()
        started = time.process_time()
        sweep(0.0)
        spent += time.process_time() - started
    return spent / count


def views(robot: SimRobot) -> list[View]:
    """What the camera would see, turned all round where the robot stands."""
    x, y, _ = robot.simulation.pose()
    turns = [from_yaw(math.tau * number / DIRECTIONS) for number in range(DIRECTIONS)]
    return [View((x, y, 0.3), turn, SIZE, PARAMETERS.camera.field_of_view) for turn in turns]


def mean(work: Callable[[Any], object], over: Sequence[Any]) -> float:
    """CPU time of the process for one call [s]."""
    work(over[0])
    started = time.process_time()
    for item in over:
        work(item)
    return (time.process_time() - started) / len(over)
