"""The Otter, a catamaran whose model and figures T. I. Fossen published with a simulator of his own, built of our parts.

Figures: PythonVehicleSimulator 1.0.1, `vehicles/otter.py` (MIT licence). Fossen's frames have y to the right and z down.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.core.shapes import Shape, Vec3
from sim.dynamics.hull import Hull, HullParameters, inertia_of
from sim.dynamics.sixdof import SixDof
from sim.physics.backend_bullet import Bullet
from sim.physics.bodies import Floating
from sim.world.weather import Weather
from tests.sim.rooms import plain

MASS, PAYLOAD, THRUST, ARM = 80.0, 25.0, 0.01108, 0.395
PAYLOAD_AT = (0.05, 0.0, 0.35)
DRAFT = 0.195122

OTTER = HullParameters(
    mass=MASS,
    length=2.0,
    beam=1.08,
    draft=DRAFT,
    depth=4 * DRAFT,
    centre_of_mass=(0.153125, 0.0, 0.246875),
    inertia=(16.678920, 21.516699, 15.102100),
    product=-2.516650,
    added_mass=(5.5, 82.5, 55.0),
    added_inertia=(3.335784, 17.213359, 25.673569),
    waterplane=0.75,
    flotation=-0.2,
    metacentric=(1.232500, 3.111255),
    damping=(77.554432, 162.5, 605.403884),
    rotary_damping=(62.065416, 266.597002, 42.651450),
    yaw_quadratic=426.514502,
    cross_drag=1.004184 * 1026 / 1025,
    friction=0.4,
    windage=(0.1, 0.1),
    wind_drag=1e-9,
)
STATIONS = [(0.1 * number - 1.0, 0.1) for number in range(21)]
"""His sum over the length counts both ends in full."""
WATER = "[water]\ndepth = 20.0\ndensity = 1025.0\n"

TOLD: dict[str, Callable[[float], tuple[float, float]]] = {
    "straight": lambda _: (80.0, 80.0),
    "turn": lambda _: (80.0, 60.0),
    "zig-zag": lambda time: (90.0, 70.0) if int(time / 10) % 2 == 0 else (70.0, 90.0),
}
"""How its propellers are told to turn in each of these [rad/s]."""
_FILE = json.loads((Path(__file__).parent / "otter_published.json").read_text(encoding="utf-8"))
PUBLISHED: dict[str, list[list[float]]] = {name: _FILE[name] for name in TOLD}
"""Where Fossen's own equations take it, second by second: time, ahead, left, yaw, speeds ahead and left, turn rate."""

Row = tuple[float, float, float, float, float, float]
"""Ahead, to the left [m], yaw [rad], speed ahead, to the left [m/s], turn rate [rad/s]."""


def sail(revolutions: Callable[[float], tuple[float, float]], seconds: float) -> list[Row]:
    """Where it is after every step with its propellers, left and right, told to turn by these [rad/s] at a time [s]."""
    backend = Bullet()
    shell = Shape("box", (2.0, 1.08, 0.4), (0.0, 0.0, 0.0))
    spec = Floating(shell, MASS, OTTER.inertia, OTTER.centre_of_mass, 0.4)
    body = SixDof(
        backend,
        backend.add_floating(spec, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)),
        inertia_of(OTTER),
        munk=True,
    )
    hull = Hull(OTTER, Weather(plain(WATER), Noise(0, "gusts", on=False)), STATIONS)
    turning, yaw, rows = (0.0, 0.0), 0.0, []
    for step in range(round(seconds * STEPS_PER_SECOND)):
        body.update((0.0, 0.0, 0.0))
        force, torque = _payload(body, *hull.forces(body))
        left, right = (THRUST * n * abs(n) for n in turning)
        body.apply(
            (force[0] + left + right, force[1], force[2]),
            (torque[0], torque[1], torque[2] + ARM * (right - left)),
        )
        backend.step()
        told = revolutions(step / STEPS_PER_SECOND)
        turning = tuple(
            now + (goal - now) / 0.1 / STEPS_PER_SECOND for now, goal in zip(turning, told, strict=True)
        )
        body.update((0.0, 0.0, 0.0))
        yaw += body.turning[2] / STEPS_PER_SECOND
        rows.append((*body.position[:2], yaw, *body.through[:2], body.turning[2]))
    backend.close()
    return rows


def _payload(body: SixDof, force: Vec3, torque: Vec3) -> tuple[Vec3, Vec3]:
    """Fossen counts the weight of the payload once more, and his buoyancy acts along the mast, not upward."""
    ux, uy, uz = body.axes[6:]
    lift = (force[2] + OTTER.damping[2] * body.through[2]) / uz
    weight = PAYLOAD * GRAVITY
    fx, fy, fz = -weight * ux, -weight * uy, -weight * uz
    px, py, pz = PAYLOAD_AT
    return (
        (force[0] - lift * ux + fx, force[1] - lift * uy + fy, force[2] + fz),
        (torque[0] + py * fz - pz * fy, torque[1] + pz * fx - px * fz, torque[2] + px * fy - py * fx),
    )
