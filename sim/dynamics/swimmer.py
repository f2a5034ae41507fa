"""A body under water: its figures, and what the water does to it."""

from __future__ import annotations

from sim.core.constants import GRAVITY
from sim.core.parameters import Limits, Positive, Table
from sim.core.shapes import Vec3
from sim.dynamics.sixdof import Inertia, SixDof
from sim.world.weather import Weather

__all__ = ["BuoyantBox", "SwimmerBody", "SwimmerLimits", "inertia_of"]


class SwimmerBody(Table, frozen=True, kw_only=True):
    """The body, a box round the centre of mass."""

    mass: Positive
    """[kg]"""
    length: Positive
    """[m]"""
    width: Positive
    """[m]"""
    height: Positive
    """[m]"""
    inertia: tuple[Positive, Positive, Positive]
    """[kg m2]"""
    added_mass: tuple[Positive, Positive, Positive]
    """[kg]"""
    added_inertia: tuple[Positive, Positive, Positive]
    """[kg m2]"""
    drag: tuple[Positive, Positive, Positive]
    """Coefficients of the faces ahead, aside and above."""
    buoyancy: Positive
    """Under water, as a part of the weight."""
    lift_arm: float
    """Height of the centre of buoyancy above the centre of mass [m]."""
    friction: Positive
    rated_depth: Positive
    """[m]"""


class SwimmerLimits(Limits, frozen=True, kw_only=True):
    """Limits of the vehicle."""

    climb: Positive
    """Upward and downward [m/s]."""
    tilt: Positive
    """Roll and pitch that it holds [rad]."""


def inertia_of(body: SwimmerBody) -> Inertia:
    """Inertia of the body."""
    return Inertia(body.mass, (0.0, 0.0, 0.0), body.inertia, 0.0, body.added_mass, body.added_inertia)


class BuoyantBox:
    """A box in the water of a world: weight, buoyancy and drag."""

    def __init__(self, body: SwimmerBody, weather: Weather) -> None:
        """A box anywhere."""
        self._body, self._weather = body, weather
        self._weight = body.mass * GRAVITY
        x, y, z = body.length, body.width, body.height
        cx, cy, cz = body.drag
        half = weather.density / 2
        self.drag = (half * cx * y * z, half * cy * x * z, half * cz * x * y)
        """Along x, y and z for a speed of 1 m/s [N]."""
        self._rotary = (
            weather.density * x * (cy * z**4 + cz * y**4) / 64,
            weather.density * y * (cz * x**4 + cx * z**4) / 64,
            weather.density * z * (cy * x**4 + cx * y**4) / 64,
        )
        self.wet = 1.0
        """Part of it that is under water."""

    def forces(self, body: SixDof) -> tuple[Vec3, Vec3]:
        """Force [N] and torque [N m] about the origin along the body's axes, weight and buoyancy included."""
        own = self._body
        x, y, z = body.position
        u, v, w = body.through
        p, q, r = body.turning
        ux, uy, uz = body.axes[6:]
        level = self._weather.surface(x, y) if self._weather.waves else 0.0
        self.wet = wet = min(max((level - z) / own.height + 0.5, 0.0), 1.0)
        lift = self._weight * own.buoyancy * wet
        up = lift - self._weight
        dx, dy, dz = self.drag
        dp, dq, dr = self._rotary
        force = (
            up * ux - wet * dx * abs(u) * u,
            up * uy - wet * dy * abs(v) * v,
            up * uz - wet * dz * abs(w) * w,
        )
        arm = own.lift_arm * lift
        torque = (
            -arm * uy - wet * dp * abs(p) * p,
            arm * ux - wet * dq * abs(q) * q,
            -wet * dr * abs(r) * r,
        )
        return force, torque
