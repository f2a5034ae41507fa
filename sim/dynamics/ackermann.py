"""The numbers of a vehicle with steered front wheels, and its body and drive; `base_link` is the middle of the rear axle."""

from __future__ import annotations

import math

from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Limits, Positive, Table
from sim.core.shapes import Shape
from sim.dynamics.control import towards, within
from sim.physics.backend_bullet import Bullet, WheeledBody

__all__ = ["AckermannBody", "AckermannDrive", "AckermannLimits", "Axles", "body_of"]


class AckermannBody(Table, frozen=True, kw_only=True):
    """The body without wheels, a box."""

    mass: Positive
    """[kg]"""
    length: Positive
    """[m]"""
    width: Positive
    """[m]"""
    height: Positive
    """Of its top above the ground [m]."""
    clearance: Positive
    """Of its bottom above the ground [m]."""
    ahead: float
    """Of its middle, from the rear axle [m]."""
    centre_of_mass: tuple[float, float, Positive]
    """From the ground under the middle of the rear axle [m]."""
    inertia: tuple[Positive, Positive, Positive]
    """About x, y and z through the centre of mass [kg m2]."""
    friction: Positive


class Axles(Table, frozen=True, kw_only=True):
    """Four wheels, the rear ones driven, the front ones steered."""

    base: Positive
    """From axle to axle [m]."""
    track: Positive
    """Between the middles of the wheels of an axle [m]."""
    radius: Positive
    """[m]"""
    mass: Positive
    """Of one wheel [kg]."""
    friction: Positive
    torque: Positive
    """The most at one driven wheel [N m]."""
    steering_torque: Positive
    """The most at one steered wheel [N m]."""
    rolling: Positive
    """Rolling resistance as a part of the weight."""
    ticks: Positive
    """Of the encoder of a rear wheel in a turn."""


class AckermannLimits(Limits, frozen=True, kw_only=True):
    """Limits of the drive."""

    steering: Positive
    """Angle of a wheel in the middle of the front axle [rad]."""
    steering_rate: Positive
    """[rad/s]"""
    acceleration: Positive
    """[m/s2]"""
    braking: Positive
    """Deceleration when it stops [m/s2]."""


_MIN_STEERING_SPEED = 0.5
"""Below this speed, the steering of a twist is computed as for this speed [m/s]."""


class AckermannDrive:
    """Holds the wanted speed and steering and approaches them no faster than the limits allow."""

    def __init__(self, axles: Axles, limits: AckermannLimits, backend: Bullet, body: int) -> None:
        """The drive of `body`, with the joints of `body_of`, at rest, wheels straight."""
        self._axles, self._limits, self._backend, self._body = axles, limits, backend, body
        self._goal = (0.0, 0.0)
        self._now = (0.0, 0.0)
        self._rate = limits.acceleration
        self._brakes = False
        self._apply()

    @property
    def steering(self) -> float:
        """Commanded angle of a wheel in the middle of the front axle [rad]."""
        return self._now[1]

    def set_target(self, speed: float, steering: float) -> None:
        """Go for `speed` [m/s] and `steering` [rad], both cut to the limits; for rest with the brakes of all four wheels."""
        limits = self._limits
        self._goal = (within(speed, limits.speed), within(steering, limits.steering))
        self._brakes = self._goal[0] == 0.0
        self._rate = limits.braking if self._brakes else limits.acceleration

    def set_turn(self, speed: float, yaw_rate: float) -> None:
        """Go for `speed` [m/s] and the steering that turns by `yaw_rate` [rad/s]; slow, it turns less than that."""
        reckoned = math.copysign(max(abs(speed), _MIN_STEERING_SPEED), speed)
        self.set_target(speed, math.atan(self._axles.base * yaw_rate / reckoned))

    def brake(self) -> None:
        """Go for rest as hard as the brakes of all four wheels allow; the steering stays as it is."""
        self._goal = (0.0, self._now[1])
        self._rate, self._brakes = self._limits.braking, True

    def halt(self) -> None:
        """Stand still at once, wheels straight."""
        self._goal = self._now = (0.0, 0.0)
        self._apply()

    def step(self) -> None:
        """Come one physics step nearer to the target."""
        if self._now == self._goal:
            return
        (speed, steering), (wanted, turned) = self._now, self._goal
        self._now = (
            towards(speed, wanted, self._rate / STEPS_PER_SECOND),
            towards(steering, turned, self._limits.steering_rate / STEPS_PER_SECOND),
        )
        self._apply()

    def _apply(self) -> None:
        speed, steering = self._now
        axles, backend, body = self._axles, self._backend, self._body
        curvature = math.tan(steering) / axles.base
        for wheel, side in ((0, axles.track / 2), (1, -axles.track / 2)):
            share = 1 - curvature * side
            backend.spin(body, wheel, speed * share / axles.radius, axles.torque)
            angle = math.atan(axles.base * curvature / share)
            backend.steer(body, 2 + 2 * wheel, angle, axles.steering_torque)
            rolling = speed * math.hypot(share, axles.base * curvature) / axles.radius
            backend.spin(body, 3 + 2 * wheel, rolling, axles.torque if self._brakes else 0.0)


def body_of(body: AckermannBody, axles: Axles) -> WheeledBody:
    """The rigid body that the physics needs; its joints: the rear wheels, then knuckle and wheel front left and front right."""
    half, radius = axles.track / 2, axles.radius
    height = body.height - body.clearance
    middle = (body.height + body.clearance) / 2
    return WheeledBody(
        shell=Shape("box", (body.length, body.width, height), (body.ahead, 0.0, middle)),
        mass=body.mass,
        inertia=body.inertia,
        centre_of_mass=body.centre_of_mass,
        wheels=((0.0, half, radius), (0.0, -half, radius)),
        wheel_radius=radius,
        wheel_mass=axles.mass,
        wheel_friction=axles.friction,
        steered=((axles.base, half, radius), (axles.base, -half, radius)),
        friction=body.friction,
    )
