"""The numbers of a robot with two driven wheels, and its body and drive."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Self

from msgspec.structs import replace

from bridge.msgs.geometry_msgs import Twist
from sim.core.load import Load, loaded
from sim.core.parameters import CameraParameters, Limits, Parameters, Positive, Table
from sim.core.shapes import Shape
from sim.dynamics.control import towards
from sim.physics.backend_bullet import STEPS_PER_SECOND, Bullet, WheeledBody
from sim.sensors.odometry import OdometryParameters

__all__ = ["DifferentialDrive", "DifferentialLimits", "DifferentialParameters", "Wheels", "body_of"]


class Body(Table, frozen=True, kw_only=True):
    """The body without wheels, an upright cylinder."""

    mass: Positive
    """[kg]"""
    radius: Positive
    """[m]"""
    height: Positive
    """Of its top above the ground [m]."""
    clearance: Positive
    """Of its bottom above the ground [m]."""
    centre_of_mass: Positive
    """Above the ground [m]."""
    ahead: float = 0.0
    """Of its centre of mass, from the axle [m]."""
    inertia: tuple[Positive, Positive, Positive]
    """About x, y and z through the centre of mass [kg m2]."""
    friction: Positive


class Wheels(Table, frozen=True, kw_only=True):
    """The two driven wheels."""

    base: Positive
    """Between their middles [m]."""
    radius: Positive
    """[m]"""
    mass: Positive
    """Of one [kg]."""
    friction: Positive
    torque: Positive
    """The most at one wheel [N m]."""
    ticks: Positive
    """Of the encoder in a turn."""


class Casters(Table, frozen=True, kw_only=True):
    """The two sliding supports."""

    radius: Positive
    """[m]"""
    offset: Positive
    """From the axle [m]."""
    mass: Positive
    """Of one [kg]."""


class Rolling(Table, frozen=True, kw_only=True):
    """What tyres and gears take."""

    resistance: Positive
    """As a part of the weight."""


class DifferentialLimits(Limits, frozen=True, kw_only=True):
    """What the drive does at most."""

    acceleration: Positive
    """[m/s2]"""
    yaw_acceleration: Positive
    """[rad/s2]"""
    braking: Positive
    """How fast it loses speed when it is told to stop [m/s2]."""
    yaw_braking: Positive
    """The same for turning [rad/s2]."""


class DifferentialParameters(Parameters, frozen=True, kw_only=True):
    """What all robots with two driven wheels have."""

    body: Body
    wheels: Wheels
    casters: Casters
    limits: DifferentialLimits
    rolling: Rolling
    odometry: OdometryParameters
    camera: CameraParameters

    @property
    def radius(self) -> float:
        """Of the circle round `base_link` that the body fits in [m]."""
        return self.body.radius

    @property
    def deck(self) -> tuple[float, float, float]:
        """Where payloads are mounted, in `base_link` [m]."""
        return (0.0, 0.0, self.body.height)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier, and higher or farther ahead in its balance."""
        body = self.body
        mass, (x, _, z), inertia = loaded(
            body.mass, (body.ahead, 0.0, body.centre_of_mass), body.inertia, loads
        )
        heavier = replace(body, mass=mass, ahead=x, centre_of_mass=z, inertia=inertia)
        return replace(self, body=heavier)

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """It has one."""
        return (self.camera,)


class DifferentialDrive:
    """Holds the last wanted twist and approaches it no faster than the limits allow."""

    def __init__(self, wheels: Wheels, limits: DifferentialLimits, backend: Bullet, body: int) -> None:
        """The drive of `body`, whose joints 0 and 1 are the left and the right wheel; at rest."""
        self._wheels, self._limits, self._backend, self._body = wheels, limits, backend, body
        self._goal = (0.0, 0.0)
        self._now = (0.0, 0.0)
        self._rates = (limits.acceleration, limits.yaw_acceleration)
        self._apply()

    def want(self, twist: Twist) -> None:
        """Go for `twist`, cut to the limits; only its forward and yaw parts matter."""
        limits = self._limits
        self._rates = (limits.acceleration, limits.yaw_acceleration)
        self._goal = (
            towards(0.0, twist.linear.x, limits.speed),
            towards(0.0, twist.angular.z, limits.yaw_rate),
        )

    def brake(self) -> None:
        """Go for rest as hard as the brakes allow."""
        self._goal = (0.0, 0.0)
        self._rates = (self._limits.braking, self._limits.yaw_braking)

    def halt(self) -> None:
        """Stand still at once."""
        self._goal = self._now = (0.0, 0.0)
        self._apply()

    def step(self) -> None:
        """Come one physics step nearer to what is wanted."""
        if self._now == self._goal:
            return
        speed, turn = (
            towards(now, goal, rate / STEPS_PER_SECOND)
            for now, goal, rate in zip(self._now, self._goal, self._rates, strict=True)
        )
        self._now = speed, turn
        self._apply()

    def _apply(self) -> None:
        speed, turn = self._now
        wheels = self._wheels
        lag = turn * wheels.base / 2
        self._backend.spin(self._body, 0, (speed - lag) / wheels.radius, wheels.torque)
        self._backend.spin(self._body, 1, (speed + lag) / wheels.radius, wheels.torque)


def body_of(parameters: DifferentialParameters) -> WheeledBody:
    """The rigid body that the physics needs."""
    body, wheels, casters = parameters.body, parameters.wheels, parameters.casters
    height = body.height - body.clearance
    middle = (body.height + body.clearance) / 2
    return WheeledBody(
        shell=Shape("cylinder", (2 * body.radius, 2 * body.radius, height), (0.0, 0.0, middle)),
        mass=body.mass,
        inertia=body.inertia,
        centre_of_mass=(body.ahead, 0.0, body.centre_of_mass),
        wheels=((0.0, wheels.base / 2, wheels.radius), (0.0, -wheels.base / 2, wheels.radius)),
        wheel_radius=wheels.radius,
        wheel_mass=wheels.mass,
        wheel_friction=wheels.friction,
        casters=((casters.offset, 0.0, casters.radius), (-casters.offset, 0.0, casters.radius)),
        caster_radius=casters.radius,
        caster_mass=casters.mass,
        friction=body.friction,
    )
