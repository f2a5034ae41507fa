"""Cost of the simulated vehicles: a step of each, of several in one world, and a sweep of the truck's laser.

CPU time of the whole process, without sockets and, but for the cameras' own figure, without cameras: each vehicle drives
by itself with all its sensors, then one of each together over the lake's model of water, then one to twenty patrol robots
in one car park. The shares of a core are at 240 steps a second, in real time. Memory is the resident set as the system counts it, shared pages of libraries included in each, of both processes of a robot side that serves one
patrol robot without a client and was started before, so that its database has its tables (the very first start has what makes
them, 13 MB, in memory as well), and while a client watches its camera, which takes the software GL with its
compiler. Runs are compared by the hash of all that the robots of every kind measured in two
processes.
"""

from __future__ import annotations

import math
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace

import psutil

from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.station import Serving, serving
from bridge.client.remote_robot import RemoteRobot
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.core.shapes import from_yaw
from sim.rendering.jpeg import jpeg
from sim.rendering.renderer import Renderer
from sim.rendering.view import View
from sim.robot import CAMERA_TOPIC, ROBOTS
from sim.sensors.laser import Laser
from sim.simulation.simulation import Simulation
from sim.vehicles.commander import PARAMETERS
from sim.vehicles.model import Vehicle
from sim.world.tables import Start
from sim.world.world import World
from sim.world.world_files import load, parse

KINDS = tuple(ROBOTS)
CROWDS = (1, 5, 20)
FIGURES = (
    *(Figure(name, "µs", f"a step of 1/240 s of one {name} with its sensors") for name in KINDS),
    Figure("together", "%", "of a core in real time: one of each in one world", target=5),
    *(
        Figure(
            f"patrols {count}",
            "×",
            f"faster than real time: {count} patrol robots in one world",
            target,
            "more",
        )
        for count, target in zip(CROWDS, (100, None, 1), strict=True)
    ),
    Figure("added patrol", "µs", "a step more for each patrol robot more, of twenty"),
    Figure(
        "cameras",
        "%",
        "of a core: five cameras of 640 x 480 at 15 Hz in the office, JPEG included",
        target=35,
    ),
    Figure("memory", "MB", "resident: the robot side with one patrol robot, nobody looks", target=120),
    Figure("watched", "MB", "the same while somebody looks through its camera"),
    Figure(
        "differing",
        "",
        "robots of six that went another way in a second process with the same seed",
        target=0,
    ),
    Figure("sweep", "ms", "a sweep of the truck's laser in the car park, 271 beams"),
)
REPEATS = 3
SWEEPS = 60
CAMERAS, CAMERA_RATE, VIEWS = 5, 15, 24
SECONDS = 4.0
"""Simulated of each [s]."""
GOING = Twist(Vector3(0.4, 0.0, 0.0), Vector3(0.0, 0.0, 0.3))

BOTH = """
name = "everything"
description = "Level ground that is a lake, too, for those who float"
[datum]
latitude = 45.0
longitude = -73.0
[ground]
length = 40.0
width = 40.0
[start]
x = 0.0
y = 0.0
[water]
depth = 5.0
[[water.waves]]
height = 0.05
period = 2.5
"""

SETTLING_TIME = 4.0
"""A robot side has all that it needs after this [s]."""
RUN = """
import hashlib
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.robot import ROBOTS, make

for name, model in ROBOTS.items():
    robot = make(name, "lake" if model.element == "water" else "parking_lot", seed=7, camera=False)
    robot.want("/sim/ground_truth", True)
    if "take_off" in robot.info.manoeuvres:
        robot.manoeuvre(Manoeuvre(kind="take_off"))
    digest = hashlib.sha256()
    for tick in range(60):
        if tick == 30:
            robot.drive(Twist(Vector3(0.5, 0.0, 0.0), Vector3(0.0, 0.0, 0.4)))
        for topic, message in robot.read(tick * 0.1):
            digest.update(topic.encode() + repr(message).encode())
    robot.close()
    print(digest.hexdigest())
"""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept from one sample to the next."""
    yield Sides(ours)


def ours() -> dict[str, float]:
    """One sample of every figure."""
    values = {name: alone(name) * 1e6 for name in KINDS}
    values["together"] = together() * STEPS_PER_SECOND * 100
    crowds = [crowd(count) for count in CROWDS]
    for count, step in zip(CROWDS, crowds, strict=True):
        values[f"patrols {count}"] = 1 / (step * STEPS_PER_SECOND)
    values["added patrol"] = (crowds[-1] - crowds[0]) / (CROWDS[-1] - CROWDS[0]) * 1e6
    values["cameras"] = picture() * CAMERAS * CAMERA_RATE * 100
    values["memory"], values["watched"] = memory()
    values["differing"] = float(sum(a != b for a, b in zip(*(hashes() for _ in range(2)), strict=True)))
    values["sweep"] = sweep() * 1e3
    return values


def home(name: str) -> World:
    """A world in which this robot can be."""
    return load("lake" if ROBOTS[name].element == "water" else "parking_lot")


def alone(name: str) -> float:
    """CPU time of a step of one robot [s]."""
    return driving(Simulation(home(name), ROBOTS[name]))


def together() -> float:
    """CPU time of a step of one of each [s]; here those that need dry land drive on the bottom of the water."""
    models = [replace(ROBOTS[name], element="air") for name in KINDS]
    others = [(model, Start(3.0 * number, 5.0)) for number, model in enumerate(models[1:], 1)]
    return driving(Simulation(parse(BOTH, "everything"), models[0], *others))


def crowd(count: int) -> float:
    """CPU time of a step of so many patrol robots in the car park [s]."""
    others = [(ROBOTS["patrol"], Start(-17.0 + 1.5 * number, -6.5)) for number in range(count - 1)]
    return driving(Simulation(load("parking_lot"), ROBOTS["patrol"], *others))


def driving(simulation: Simulation) -> float:
    """CPU time of a step of everything in it [s]; frees it."""
    for vehicle in simulation.vehicles:
        set_going(vehicle)
    measure(simulation, 1.0)
    spent = measure(simulation, SECONDS)
    simulation.close()
    return spent / (SECONDS * STEPS_PER_SECOND)


def set_going(vehicle: Vehicle) -> None:
    """Off the ground, if it flies, and round in a circle."""
    if "take_off" in vehicle.MANOEUVRES:
        vehicle.manoeuvre(Manoeuvre(kind="take_off"))
    else:
        vehicle.drive(GOING)


def measure(simulation: Simulation, seconds: float) -> float:
    """CPU time of so many simulated seconds with every sensor [s]."""
    started = time.process_time()
    for _ in range(round(seconds * STEPS_PER_SECOND)):
        simulation.advance()
        for vehicle in simulation.vehicles:
            for _message in vehicle.measure(simulation.time, truth=False):
                pass
    return time.process_time() - started


def picture() -> float:
    """CPU time of one picture in the office with its JPEG [s], all round in its corridor."""
    with closing(Renderer(load("office"))) as renderer:
        views = [
            View((0.0, 0.0, 0.4), from_yaw(math.tau * number / VIEWS), (640, 480), 1.2)
            for number in range(VIEWS)
        ]
        jpeg(renderer.draw(views[0]))
        started = time.process_time()
        for view in views:
            jpeg(renderer.draw(view))
        return (time.process_time() - started) / VIEWS


def memory() -> tuple[float, float]:
    """Resident set of a robot side with one patrol robot before and while a client gets its pictures [MB]."""
    with tempfile.TemporaryDirectory() as state:
        with serving(state=state):
            pass  # the first start makes the tables
        with serving(state=state) as side:
            return resident(side)


def resident(side: Serving) -> tuple[float, float]:
    """Of this robot side, before and while a client gets its pictures [MB]."""
    time.sleep(SETTLING_TIME)
    alone = _resident(side)
    with RemoteRobot(side.url) as robot:
        robot.wait()
        stop = robot.on(CAMERA_TOPIC, lambda _: None)
        time.sleep(SETTLING_TIME)
        watched = _resident(side)
        stop()
    return alone / 1e6, watched / 1e6


def _resident(side: Serving) -> int:
    """Of its process and of the one that draws [B]."""
    process = psutil.Process(side.child.process.pid)
    return sum(each.memory_info().rss for each in (process, *process.children(recursive=True)))


def hashes() -> list[str]:
    """What the robots of all kinds measured in a process of its own, as hashes."""
    done = subprocess.run(
        [sys.executable, "-c", RUN], capture_output=True, text=True, check=True, timeout=120
    )
    return done.stdout.split()


def sweep() -> float:
    """CPU time of one sweep of the truck's laser in the car park, while it drives [s]."""
    simulation = Simulation(load("parking_lot"), ROBOTS["commander"])
    laser = Laser(PARAMETERS.laser, simulation.backend, simulation.vehicle.body, Noise(0, "bench"))
    laser.measure(0.0)
    simulation.vehicle.drive(GOING)
    spent = 0.0
    for _ in range(SWEEPS):
        simulation.advance()  # what was measured while nothing moves costs nothing
        started = time.process_time()
        laser.measure(0.0)
        spent += time.process_time() - started
    simulation.close()
    return spent / SWEEPS
