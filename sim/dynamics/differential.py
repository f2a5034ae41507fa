"""The numbers of a robot with two driven wheels, and its body and drive."""

from __future__ import annotations

from bridge.msgs.geometry_msgs import Twist
from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Limits, Positive, Table
from sim.core.shapes import Shape
from sim.dynamics.control import towards
from sim.physics.backend_bullet import Bullet, WheeledBody

__all__ = ["DifferentialDrive", "DifferentialLimits", "Wheels", "body_of"]


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
    """As a part of the grip that the ground gives to rubber."""
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
    """Losses in tyres and gears."""

    resistance: Positive
    """As a part of the weight."""


class DifferentialLimits(Limits, frozen=True, kw_only=True):
    """Limits of the drive."""

    acceleration: Positive
    """[m/s2]"""
    yaw_acceleration: Positive
    """[rad/s2]"""
    braking: Positive
    """Deceleration when it stops [m/s2]."""
    yaw_braking: Positive
    """The same for turning [rad/s2]."""


class DifferentialDrive:
    """Holds the last wanted twist and approaches it no faster than the limits allow."""

    def __init__(self, wheels: Wheels, limits: DifferentialLimits, backend: Bullet, body: int) -> None:
        """The drive of `body`, whose joints 0 and 1 are the left and the right wheel; at rest."""
        self._wheels, self._limits, self._backend, self._body = wheels, limits, backend, body
        self._goal = (0.0, 0.0)
        self._now = (0.0, 0.0)
        self._rates = (limits.acceleration, limits.yaw_acceleration)
        self._apply()

    def set_target(self, twist: Twist) -> None:
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
        """Come one physics step nearer to the target."""
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


def body_of(body: Body, wheels: Wheels, casters: Casters) -> WheeledBody:
    """The rigid body that the physics needs."""
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
