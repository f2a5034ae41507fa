"""The numbers of a vehicle with steered front wheels, and its body and drive; `base_link` is the middle of the rear axle."""

from __future__ import annotations

import math

from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Limits, Positive, Table
from sim.core.shapes import Shape
from sim.dynamics.control import towards, within
from sim.dynamics.tyres import Footing, Ground, TyreParameters, Wheel
from sim.physics.backend_bullet import Bullet, Joint, WheeledBody

__all__ = ["AckermannBody", "AckermannDrive", "AckermannLimits", "Axles", "body_of", "footing_of"]


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
    torque: Positive
    """The most at one wheel, of a motor or a brake [N m]."""
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


_RIM_SHARE = 0.5
"""Of a wheel's mass that resists its turning, at its tread: that of an even disc."""
_HOLDING = 1.0
"""A truck that stands is held by its tyres; a force smaller than this is none [N]."""


class AckermannDrive:
    """Holds the wanted speed and steering, approaches them no faster than the limits allow, and lets the tyres act on the body.

    The motors of the rear wheels pull alike, as with a differential, and a traction control leaves their tyres what these need
    aside: [A] a perfect one, which knows the grip. The brakes have nothing of the kind and lock. The front wheels roll freely.
    """

    def __init__(
        self,
        axles: Axles,
        limits: AckermannLimits,
        footing: Footing,
        ground: Ground,
        backend: Bullet,
        body: int,
    ) -> None:
        """The drive of `body`, which stands by its `footing` on `ground`; at rest, wheels straight."""
        self._axles, self._limits, self._ground = axles, limits, ground
        self._backend, self._body = backend, body
        self.footing = footing
        """Its wheels."""
        self._goal = (0.0, 0.0)
        self._now = (0.0, 0.0)
        self._rate = limits.acceleration
        self._brakes = False
        self._angles = (0.0, 0.0)
        self._torque = 0.0

    @property
    def steering(self) -> float:
        """Commanded angle of a wheel in the middle of the front axle [rad]."""
        return self._now[1]

    @property
    def joints(self) -> list[Joint]:
        """The rear wheels, then knuckle and wheel front left and front right."""
        rear, front = self.footing.axles
        found = [self._joint(wheel, self._torque) for wheel in rear]
        for wheel, angle in zip(front, self._angles, strict=True):
            found += [Joint(angle, 0.0, 0.0), self._joint(wheel, 0.0)]
        return found

    def _joint(self, wheel: Wheel, torque: float) -> Joint:
        radius = self._axles.radius
        return Joint(wheel.turned / radius, wheel.rim / radius, torque)

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
        self._angles = (0.0, 0.0)
        self.footing.rest()

    def step(self) -> None:
        """Come one physics step nearer to the target, and let the ground act on the body for it."""
        backend, body = self._backend, self._body
        if self._now != self._goal:
            self._approach()
        elif backend.asleep:
            return
        speed, steering = self._now
        motion = backend.motion(body)
        footing, ground, most = self.footing, self._ground, self._axles.torque / self._axles.radius
        footing.carry(motion, ground)
        rear = footing.axles[0]
        pull = most if self._brakes else min(most, *(wheel.spare(ground.grip) for wheel in rear))
        self._torque = footing.turn(0, speed, pull) * self._axles.radius
        footing.turn(1, speed / math.cos(steering), most if self._brakes else 0.0)
        force, moment = footing.roll(motion, self._angles, ground.grip)
        if speed or abs(force[0]) + abs(force[1]) + abs(moment[2]) > _HOLDING:
            x, y, _ = motion[0]
            backend.apply(body, (x, y, ground.height), force, moment)

    def _approach(self) -> None:
        (speed, steering), (wanted, turned) = self._now, self._goal
        self._now = (
            towards(speed, wanted, self._rate / STEPS_PER_SECOND),
            towards(steering, turned, self._limits.steering_rate / STEPS_PER_SECOND),
        )
        axles = self._axles
        curvature = math.tan(self._now[1]) / axles.base
        left, right = (
            math.atan(axles.base * curvature / (1 - curvature * side))
            for side in (axles.track / 2, -axles.track / 2)
        )
        self._angles = (left, right)


def footing_of(body: AckermannBody, axles: Axles, tyres: TyreParameters) -> Footing:
    """The wheels of a truck, at rest."""
    at, half = body.centre_of_mass, axles.track / 2
    rear, front = (
        (
            Wheel(x - at[0], half, stiffness, tyres.relaxation),
            Wheel(x - at[0], -half, stiffness, tyres.relaxation),
        )
        for x, stiffness in ((0.0, tyres.rear), (axles.base, tyres.front))
    )
    mass = body.mass + 4 * axles.mass
    balance = (body.mass * at[0] + 2 * axles.mass * axles.base) / mass
    height = (body.mass * at[2] + 4 * axles.mass * axles.radius) / mass
    rim = _RIM_SHARE * axles.mass
    return Footing((rear, front), mass=mass, balance=(balance, height), below=at[2], rim=rim)


def body_of(body: AckermannBody, axles: Axles) -> WheeledBody:
    """The rigid body that the physics needs, on four supports without friction: the tyres are the drive's."""
    half, radius = axles.track / 2, axles.radius
    height = body.height - body.clearance
    middle = (body.height + body.clearance) / 2
    return WheeledBody(
        shell=Shape("box", (body.length, body.width, height), (body.ahead, 0.0, middle)),
        mass=body.mass,
        inertia=body.inertia,
        centre_of_mass=body.centre_of_mass,
        casters=tuple((x, side, radius) for x in (0.0, axles.base) for side in (half, -half)),
        caster_radius=radius,
        caster_mass=axles.mass,
        friction=body.friction,
    )
