"""Plots of docs/physics.md, `python -m scripts.physics_plots [FOLDER]`: runs the vehicles and draws into docs/pictures.

Ours are lines; dots are what a formula gives, or what others published.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import msgspec

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from scripts.plots import BLUE, GREEN, GREY, ORANGE, PURPLE, RED, Plot, Series, page
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.physics.backend_bullet import State
from sim.simulation.simulation import Simulation
from sim.vehicles.aqua import AQUA
from sim.vehicles.aqua import PARAMETERS as SWIMMER
from sim.vehicles.ardrone import ARDRONE
from sim.vehicles.ardrone import PARAMETERS as QUADROTOR
from sim.vehicles.commander import COMMANDER
from sim.vehicles.commander import PARAMETERS as TRUCK
from sim.vehicles.minnow import MINNOW
from sim.vehicles.minnow import PARAMETERS as BOAT
from sim.vehicles.model import Model
from sim.vehicles.scout import SCOUT
from sim.world.surfaces import GRIP
from tests.sim.dynamics.otter import PUBLISHED, TOLD, sail
from tests.sim.dynamics.single_track import steady
from tests.sim.rooms import plain

FOLDER = Path(__file__).parents[1] / "docs" / "pictures"
WATER = "[water]\ndepth = 15.0\n"
WAVES = "[[water.waves]]\nheight = 0.06\nperiod = 2.5\n[[water.waves]]\nheight = 0.03\nperiod = 1.4\ndirection = 40\n"

Points = list[tuple[float, float]]


@contextmanager
def running(model: Model, extra: str = "", z: float = 0.0) -> Iterator[Simulation]:
    """The robot alone on a plain, without noise."""
    simulation = Simulation(plain(extra, z), model, noise=False)
    try:
        yield simulation
    finally:
        simulation.close()


def follow(
    simulation: Simulation, seconds: float, value: Callable[[State], float], every: float = 0.05
) -> Points:
    """A value of the first vehicle over the time from now on [s]."""
    start, steps = simulation.time, round(every * STEPS_PER_SECOND)
    points = []
    for number in range(round(seconds * STEPS_PER_SECOND)):
        if number % steps == 0:
            points.append((simulation.time - start, value(simulation.vehicle.state())))
        simulation.advance()
        for _ in simulation.vehicle.measure(simulation.time, truth=False):
            pass
    return points


def spin(simulation: Simulation, seconds: float) -> None:
    """Let it run."""
    follow(simulation, seconds, lambda _: 0.0)


def otter() -> list[Plot]:
    """The boat's equations with the figures of the Otter, beside Fossen's."""
    plots = []
    for name in ("turn", "zig-zag"):
        way = sail(TOLD[name], 40.0)[:: STEPS_PER_SECOND // 10]
        theirs = [(row[1], row[2]) for row in PUBLISHED[name]]
        ours = [(row[0], row[1]) for row in way]
        series = [Series("ours", ours), Series("Fossen, each second", theirs, ORANGE, dots=True)]
        plots.append(Plot(f"Otter, {name}: the way in 40 s", "ahead [m]", "left [m]", series, even=True))
    return plots


def boat() -> list[Plot]:
    """Speed, roll, a change of course in waves, the rudder's circle."""
    hull, full = BOAT.hull, BOAT.propeller.thrust
    with running(MINNOW, WATER) as simulation:
        simulation.vehicle.manoeuvre(Manoeuvre(kind="steer", throttle=1.0))
        speed = follow(simulation, 6.0, lambda state: math.hypot(*state.velocity[:2]))
    lag, top = (hull.mass + hull.added_mass[0]) / hull.damping[0], full / hull.damping[0]
    times = [0.25 * number for number in range(25)]
    short = BOAT.propeller.lag
    built = [
        (t, top * (1 - (lag * math.exp(-t / lag) - short * math.exp(-t / short)) / (lag - short)))
        for t in times
    ]
    with running(MINNOW, WATER) as simulation:
        simulation.backend.set_velocity(simulation.vehicle.body, (0.0, 0.0, 0.0), (0.3, 0.0, 0.0))
        roll = follow(simulation, 3.0, lambda state: math.degrees(tilt(state)), 0.0125)
    sliding, height = hull.mass + hull.added_mass[1], hull.centre_of_mass[2]
    about = hull.inertia[0] + hull.added_inertia[0] + hull.mass * height**2
    about -= (hull.mass * height) ** 2 / sliding
    period = math.tau * math.sqrt(about / (hull.mass * GRAVITY * hull.metacentric[0]))
    marks = [(period * number / 2, 0.0) for number in range(1, int(6.0 / period) + 1)]
    with running(MINNOW, WATER + WAVES) as simulation:
        vehicle = simulation.vehicle
        vehicle.manoeuvre(Manoeuvre(kind="course", throttle=0.6, yaw=0.0))
        spin(simulation, 5.0)
        vehicle.manoeuvre(Manoeuvre(kind="course", throttle=0.6, yaw=math.radians(60)))
        course = follow(simulation, 20.0, lambda _: math.degrees(simulation.pose()[2]))
    goal = [(0.0, 60.0), (20.0, 60.0)]
    with running(MINNOW, WATER) as simulation:
        simulation.vehicle.manoeuvre(Manoeuvre(kind="steer", throttle=1.0))
        spin(simulation, 6.0)
        simulation.vehicle.manoeuvre(Manoeuvre(kind="steer", throttle=1.0, steering=math.radians(20)))
        way = [place for _, place in pairs(simulation, 14.0)]
    return [
        Plot(
            "Boat: full throttle",
            "time [s]",
            "speed [m/s]",
            [Series("ours", speed), Series("T/D (1 - e…), no wind", built, ORANGE, dots=True)],
        ),
        Plot(
            "Boat: rolling free",
            "time [s]",
            "roll [deg]",
            [Series("ours", roll), Series("half periods by stiffness and mass", marks, ORANGE, dots=True)],
        ),
        Plot(
            "Boat: 60° to the left in waves",
            "time [s]",
            "yaw [deg]",
            [Series("ours", course), Series("course", goal, ORANGE)],
        ),
        Plot("Boat: rudder 20° at full throttle", "x [m]", "y [m]", [Series("way, 14 s", way)], even=True),
    ]


def tilt(state: State) -> float:
    """Roll [rad]."""
    x, y, z, w = state.rotation
    return math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))


def pairs(simulation: Simulation, seconds: float) -> Iterator[tuple[float, tuple[float, float]]]:
    """Times and places in the plane."""
    xs = []

    def note(state: State) -> float:
        xs.append(state.position[:2])
        return 0.0

    times = follow(simulation, seconds, note)
    return iter([(time, place) for (time, _), place in zip(times, xs, strict=True)])


def bends(surface: str) -> tuple[Plot, Plot]:
    """Turn rate and speed of the truck over steering and ordered speed, against the balance of forces."""
    world = plain()
    world = msgspec.structs.replace(world, ground=msgspec.structs.replace(world.ground, surface=surface))
    grip = world.ground.grip
    rates: list[Series] = []
    aside: list[Series] = []
    expected: Points = []
    angles = (0.05, 0.1, 0.2, 0.3, 0.4, 0.46, 0.52)
    for speed, colour in zip((1.0, 2.0, 3.0, 4.0, 5.0), (GREY, GREEN, BLUE, PURPLE, RED), strict=True):
        simulation = Simulation(world, COMMANDER, noise=False)
        found: Points = []
        accelerated: Points = []
        for angle in angles:
            simulation.vehicle.manoeuvre(Manoeuvre(kind="steer", speed=speed, steering=angle))
            spin(simulation, 10.0)
            state, yaw = simulation.vehicle.state(), simulation.pose()[2]
            along = math.cos(yaw) * state.velocity[0] + math.sin(yaw) * state.velocity[1]
            rate = state.turning[2]
            found.append((angle, rate))
            accelerated.append((angle, along * rate))
            expected.append((angle, steady(TRUCK, along, angle, grip).rate))
        simulation.close()
        rates.append(Series(f"{speed:g}", found, colour))
        aside.append(Series(f"{speed:g}", accelerated, colour))
    balance = Series("balance of forces", expected, ORANGE, dots=True)
    limit = Series("friction limit", [(0.0, grip * GRAVITY), (0.52, grip * GRAVITY)], ORANGE)
    name = surface.replace("_", " ")
    return (
        Plot(
            f"Truck on {name}, told 1 to 5 m/s: turn rate",
            "steering [rad]",
            "turn rate [rad/s]",
            [*rates, balance],
        ),
        Plot(
            f"Truck on {name}, told 1 to 5 m/s: aside",
            "steering [rad]",
            "acceleration [m/s²]",
            [*aside, limit],
        ),
    )


def truck() -> list[Plot]:
    """Bends over all speeds and steering angles, and braking."""
    plots = [*bends("asphalt"), *bends("wet_grass")]
    ways: list[Series] = []
    grips = {"asphalt": BLUE, "wet_grass": GREEN}
    for surface, colour in grips.items():
        world = plain()
        world = msgspec.structs.replace(world, ground=msgspec.structs.replace(world.ground, surface=surface))
        simulation = Simulation(world, COMMANDER, noise=False)
        simulation.vehicle.manoeuvre(Manoeuvre(kind="steer", speed=5.0))
        spin(simulation, 8.0)
        simulation.vehicle.stop()
        start = simulation.pose()[:2]
        braking = follow(
            simulation, 3.2, lambda state, start=start: math.dist(start, state.position[:2]), 0.02
        )
        base = braking[0][1]
        ways.append(Series(surface.replace("_", " "), [(t, way - base) for t, way in braking], colour))
        simulation.close()
    stop = [(t, 5 * t - 1.5 * t * t) for t in (0.0, 0.4, 0.8, 1.2, 5 / 3)]
    most = GRIP["wet_grass"] * GRAVITY
    slide = [(t, 5 * t - most * t * t / 2) for t in (0.5, 1.0, 1.5, 2.0, 5 / most)]
    plots.append(
        Plot(
            "Truck: braking from 5 m/s",
            "time [s]",
            "way [m]",
            [*ways, Series("v t - a t²/2, a of brakes, of friction", [*stop, *slide], ORANGE, dots=True)],
        )
    )
    return plots


def swimmer() -> list[Plot]:
    """Surge over the fins' frequency, and a step of depth and heading."""
    body, fins = SWIMMER.body, SWIMMER.fins
    drag = 1000.0 / 2 * body.drag[0] * body.width * body.height
    area = (fins.root + 2 * fins.tip) * fins.length**2 / 3
    ours: Points = []
    for frequency in (1.5, 2.5, 4.0, 6.0):
        figures = msgspec.structs.replace(
            SWIMMER,
            body=msgspec.structs.replace(body, buoyancy=1.0),
            fins=msgspec.structs.replace(fins, frequency=frequency),
            limits=msgspec.structs.replace(SWIMMER.limits, speed=5.0),
        )
        with running(replace(AQUA, parameters=figures), WATER, -4.0) as simulation:
            simulation.vehicle.manoeuvre(Manoeuvre(kind="course", throttle=1.0))
            spin(simulation, 12.0)
            ours.append((frequency, math.hypot(*simulation.vehicle.state().velocity)))
    theory = [
        (f, math.sqrt(6 * fins.thrust * area * 1000.0 * fins.amplitude * f / drag))
        for f in (1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0)
    ]
    with running(AQUA, WATER, -4.0) as simulation:
        simulation.vehicle.manoeuvre(Manoeuvre(kind="hover", yaw=math.pi / 2, height=-5.0))
        turns: Points = []

        def note(state: State) -> float:
            turns.append((simulation.time, simulation.pose()[2]))
            return -state.position[2]

        depth = follow(simulation, 25.0, note)
    return [
        Plot(
            "Swimmer: all fins at full swing",
            "frequency [Hz]",
            "speed [m/s]",
            [Series("ours", ours), Series("thrust = drag", theory, ORANGE, dots=True)],
        ),
        Plot(
            "Swimmer: a metre deeper, 90° round",
            "time [s]",
            "depth [m], yaw [rad]",
            [Series("depth", depth), Series("yaw", turns, GREEN)],
        ),
    ]


def quadrotor() -> list[Plot]:
    """A step up, and speed over tilt."""
    with running(ARDRONE) as simulation:
        vehicle = simulation.vehicle
        vehicle.manoeuvre(Manoeuvre(kind="take_off", height=2.0))
        up = follow(simulation, 8.0, lambda state: state.position[2])
        ours: Points = []
        for degrees in (3, 6, 10, 15, 20):
            vehicle.manoeuvre(Manoeuvre(kind="tilt", pitch=math.radians(degrees)))
            spin(simulation, 12.0)
            ours.append((degrees, vehicle.state().velocity[0]))
    weight, drag = QUADROTOR.body.mass * GRAVITY, QUADROTOR.body.drag[0]
    theory = [(d, weight * math.tan(math.radians(d)) / drag) for d in (3, 6, 10, 15, 20)]
    return [
        Plot(
            "Quadrotor: take-off to 2 m",
            "time [s]",
            "height [m]",
            [Series("ours", up), Series("wanted", [(0.0, 2.0), (8.0, 2.0)], ORANGE)],
        ),
        Plot(
            "Quadrotor: speed over tilt",
            "pitch [deg]",
            "speed [m/s]",
            [Series("ours", ours), Series("m g tan(pitch) / d", theory, ORANGE, dots=True)],
        ),
    ]


def scout() -> list[Plot]:
    """The circle of speed over turn rate, and stopping."""
    with running(SCOUT) as simulation:
        simulation.vehicle.drive(Twist.planar(0.7, 1.0))
        spin(simulation, 2.0)
        way = [place for _, place in pairs(simulation, math.tau)]
        middle = tuple((min(axis) + max(axis)) / 2 for axis in zip(*way, strict=True))
        simulation.vehicle.drive(Twist.planar(1.0, 0.0))
        spin(simulation, 3.0)
        simulation.vehicle.stop()
        slowing = follow(simulation, 0.6, lambda state: math.hypot(*state.velocity[:2]), 1 / 60)
    circle = [
        (middle[0] + 0.7 * math.cos(turn), middle[1] + 0.7 * math.sin(turn))
        for turn in (math.tau * number / 24 for number in range(24))
    ]
    line = [
        (t, max(0.0, 1.0 - SCOUT.parameters.limits.braking * t)) for t in (0.0, 0.1, 0.2, 1 / 3.5, 0.4, 0.5)
    ]  # type: ignore[attr-defined]  # its own figures
    return [
        Plot(
            "Scout: 0.7 m/s and 1 rad/s",
            "x [m]",
            "y [m]",
            [Series("ours", way), Series("radius v / turn rate", circle, ORANGE, dots=True)],
            even=True,
        ),
        Plot(
            "Scout: stopping from 1 m/s",
            "time [s]",
            "speed [m/s]",
            [Series("ours", slowing, BLUE), Series("v - a t", line, ORANGE, dots=True)],
        ),
    ]


PAGES = {
    "otter": otter,
    "boat": boat,
    "truck": truck,
    "swimmer": swimmer,
    "quadrotor": quadrotor,
    "scout": scout,
}


def main(arguments: Sequence[str]) -> int:
    """Draw every page."""
    folder = Path(arguments[0]) if arguments else FOLDER
    for name, make in PAGES.items():
        path = folder / f"physics-{name}.png"
        page(make(), path)
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
