"""Flies the quadrotor: from an order by position, velocity, attitude and turn rate to thrust and torque."""

from __future__ import annotations

import math
from typing import NamedTuple

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Vec3
from sim.dynamics.control import filled, given, within
from sim.vehicles.ardrone.parameters import ArdroneParameters

__all__ = ["LOWEST", "TUMBLED", "Motion", "Pilot"]

STEP = 1 / STEPS_PER_SECOND
PLACE = 1.2
"""Velocity for a place that is off [1/s]."""
VELOCITY, VELOCITY_SUM = 2.5, 0.6
"""Acceleration for a velocity that lacks [1/s], and for what it lacked so far [1/s2]."""
ATTITUDE, YAW = 7.0, 3.0
"""Turn rate for an angle that is off [1/s]."""
RATE, YAW_RATE = 22.0, 8.0
"""Angular acceleration for a turn rate that lacks [1/s]."""
TAKE_OFF_TO = 1.0
"""Above where it stands, unless told otherwise [m]."""
LANDING, TOUCHING = 0.4, 0.25
"""Downward far from the ground and near it [m/s]."""
DOWN, STILL = 0.05, 0.25
"""Told to sink faster than this onto the ground it lands [m/s]; slower than the second it has stopped and holds its place
[m/s]."""
LOW = 0.15
"""Lower than this above where it started it does not stay in the air to rest [m]."""
LOWEST = 0.1
"""It can be told to fly so low above where it started, and no lower [m]."""
TUMBLED = 0.3
"""Less upright than this it cuts its rotors."""
_SUM_MOST = 3.0


class Motion(NamedTuple):
    """How it flies."""

    position: Vec3
    velocity: Vec3
    """In the world [m/s]."""
    angles: Vec3
    """Roll, pitch, yaw [rad]."""
    turning: Vec3
    """About the body's axes [rad/s]."""
    upright: float
    """Cosine of the tilt."""


class Pilot:
    """Knows whether it is in the air, and keeps what the order wants."""

    def __init__(self, parameters: ArdroneParameters, start: Vec3) -> None:
        """On the ground at `start` [m]."""
        self._parameters, self._limits = parameters, parameters.limits
        self._floor = start[2]
        self._order = Manoeuvre(kind="rest")
        self.phase = "landed"
        """landed, taking_off, flying or landing."""
        self._place, self._yaw = [start[0], start[1], start[2]], 0.0
        self._holds = [True, True, True]
        self._sums = [0.0, 0.0, 0.0]

    def begin(self, order: Manoeuvre, now: Motion) -> None:
        """Follow `order` from how it flies `now`."""
        fresh = order.kind != self._order.kind
        self._order = order
        if order.kind == "take_off" and self.phase == "landed" and now.upright > TUMBLED:
            self._take_off(now, given(order.height, now.position[2] + TAKE_OFF_TO))
        elif self.phase != "landed" and (order.kind == "land" or self._nearly_down(order, now)):
            self.phase = "landing"
        elif (self.phase == "landing" and order.kind != "land") or (
            self.phase == "taking_off" and order.kind == "rest"
        ):
            self.phase = "flying"
        if fresh and self.phase not in ("landed", "taking_off"):
            self._place, self._yaw = list(now.position), now.angles[2]
            self._holds = [False, False, False]
        if order.kind in ("hover", "course"):
            self._yaw = given(order.yaw, self._yaw)
            if not math.isnan(order.height):
                self._place[2], self._holds[2] = self._allowed(order.height), True

    @property
    def held(self) -> Manoeuvre:
        """The order, with what it took for the heading and the height that are not named in it; NaN while it brakes to one."""
        order, height = self._order, self._place[2] if self._holds[2] else math.nan
        if self.phase == "landed" or order.kind not in ("course", "hover", "take_off"):
            return order
        return filled(order, self._yaw if order.kind != "take_off" else order.yaw, height)

    def _nearly_down(self, order: Manoeuvre, now: Motion) -> bool:
        """Told to come to rest so low it does not hover, but sets down."""
        return order.kind == "rest" and now.position[2] - self._floor < LOW

    def touched(self, now: Motion) -> None:
        """It stands on something."""
        sinks = self.phase == "landing" or (self.phase == "flying" and self._wanted(now)[2] < -DOWN)
        if sinks and abs(now.velocity[2]) < 0.1:
            self.phase = "landed"

    def fly(self, now: Motion) -> tuple[float, Vec3] | None:
        """Thrust [N] and torque [N m]; None on the ground."""
        if now.upright < TUMBLED:
            self.phase = "landed"
        if self.phase == "landed":
            return None  # only the order to take off starts the rotors: somebody may stand beside them
        if self.phase == "taking_off" and now.position[2] > self._place[2] - 0.08:
            self.phase = "flying"
        yaw_rate = self._turn(now)
        ax, ay, az = self._accelerate(now)
        roll, pitch = self._tilts(now, ax, ay)
        body = self._parameters.body
        thrust = body.mass * max(0.0, GRAVITY + az) / max(now.upright, 0.5)
        wanted = (ATTITUDE * wrap(roll - now.angles[0]), ATTITUDE * wrap(pitch - now.angles[1]), yaw_rate)
        torque = [
            moment * gain * (rate - turning)
            for moment, gain, rate, turning in zip(
                body.inertia, (RATE, RATE, YAW_RATE), wanted, now.turning, strict=True
            )
        ]
        return thrust, (torque[0], torque[1], torque[2])

    def _take_off(self, now: Motion, height: float) -> None:
        self.phase = "taking_off"
        self._place = [now.position[0], now.position[1], self._allowed(height)]
        self._yaw = now.angles[2]
        self._holds = [True, True, True]
        self._sums = [0.0, 0.0, 0.0]

    def _allowed(self, height: float) -> float:
        return min(max(height, self._floor + LOWEST), self._floor + self._limits.height)

    def _turn(self, now: Motion) -> float:
        """Turn rate that is wanted [rad/s]."""
        if self._order.kind in ("twist", "tilt") and self.phase == "flying":
            rate = within(self._order.twist.angular.z, self._limits.yaw_rate)
            if rate:
                self._yaw = now.angles[2]
                return rate
        return within(YAW * wrap(self._yaw - now.angles[2]), self._limits.yaw_rate)

    def _wanted(self, now: Motion) -> Vec3:
        """Velocity in the world that the order asks for [m/s]; 0 where it asks for a place to be kept."""
        order, limits = self._order, self._limits
        if self.phase == "landing":
            low = now.position[2] - self._floor < 0.6
            return 0.0, 0.0, -TOUCHING if low else -LANDING
        if self.phase == "taking_off":
            return 0.0, 0.0, 0.0
        ahead = left = up = 0.0
        if order.kind in ("twist", "tilt"):
            up = within(order.twist.linear.z, limits.climb)
        if order.kind == "twist":
            ahead, left = order.twist.linear.x, order.twist.linear.y
        elif order.kind == "course":
            ahead = given(order.speed, given(order.throttle, 0.0) * limits.speed)
        scale = min(1.0, limits.speed / max(math.hypot(ahead, left), 1e-9))
        cosine, sine = math.cos(now.angles[2]) * scale, math.sin(now.angles[2]) * scale
        return cosine * ahead - sine * left, sine * ahead + cosine * left, up

    def _accelerate(self, now: Motion) -> Vec3:
        """Acceleration that is wanted in the world [m/s2]."""
        wanted = self._wanted(now)
        moving = (math.hypot(wanted[0], wanted[1]) > 0.0,) * 2 + (wanted[2] != 0.0,)
        slow = math.hypot(now.velocity[0], now.velocity[1]) < STILL, abs(now.velocity[2]) < STILL
        result = []
        for axis in range(3):
            if moving[axis]:
                self._holds[axis] = False
            elif not self._holds[axis] and slow[axis // 2]:
                self._holds[axis], self._place[axis] = True, now.position[axis]
            velocity = wanted[axis]
            if self._holds[axis]:
                most = self._limits.climb if axis == 2 else self._limits.speed / 2
                velocity = within(PLACE * (self._place[axis] - now.position[axis]), most)
            lack = velocity - now.velocity[axis]
            self._sums[axis] = within(self._sums[axis] + VELOCITY_SUM * lack * STEP, _SUM_MOST)
            drag = self._parameters.body.drag[axis] / self._parameters.body.mass * velocity
            result.append(VELOCITY * lack + self._sums[axis] + drag)
        if now.position[2] > self._floor + self._limits.height and result[2] > 0:
            result[2] = -VELOCITY * max(0.0, now.velocity[2])
        return result[0], result[1], result[2]

    def _tilts(self, now: Motion, ax: float, ay: float) -> tuple[float, float]:
        """Roll and pitch that accelerate it so in the world, or that a tilt asks for [rad]."""
        most = self._limits.tilt
        if self._order.kind == "tilt" and self.phase == "flying":
            self._sums[0] = self._sums[1] = 0.0
            self._holds[0] = self._holds[1] = False
            return within(self._order.roll, most), within(self._order.pitch, most)
        cosine, sine = math.cos(now.angles[2]), math.sin(now.angles[2])
        ahead, left = cosine * ax + sine * ay, cosine * ay - sine * ax
        tilt = math.atan(math.hypot(ahead, left) / GRAVITY)
        share = min(1.0, most / tilt) if tilt > 0 else 1.0
        return -math.atan(left / GRAVITY) * share, math.atan(ahead / GRAVITY) * share
