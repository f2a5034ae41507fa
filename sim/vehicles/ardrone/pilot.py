"""Control of the quadrotor: from an order by position, velocity, attitude and turn rate to thrust and torque."""

from __future__ import annotations

import math
from typing import NamedTuple

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Vec3
from sim.dynamics.control import filled, given, within
from sim.vehicles.ardrone.parameters import ArdroneParameters

__all__ = ["MIN_HEIGHT", "MIN_UPRIGHT", "Motion", "Pilot"]

STEP_PERIOD = 1 / STEPS_PER_SECOND
POSITION_GAIN = 1.2
"""Velocity for an error of the position [1/s]."""
VELOCITY_GAIN, VELOCITY_INTEGRAL_GAIN = 2.5, 0.6
"""Acceleration for an error of the velocity [1/s], and for its integral [1/s2]."""
ATTITUDE_GAIN, YAW_GAIN = 7.0, 3.0
"""Turn rate for an error of the angle [1/s]."""
RATE_GAIN, YAW_RATE_GAIN = 22.0, 8.0
"""Angular acceleration for an error of the turn rate [1/s]."""
TAKE_OFF_HEIGHT = 1.0
"""Above where it stands, unless the order names a height [m]."""
LANDING_SPEED, TOUCHDOWN_SPEED = 0.4, 0.25
"""Downward far from the ground and near it [m/s]."""
MIN_SINK_ORDER, HOLD_SPEED = 0.05, 0.25
"""An order to sink faster than the first onto the ground lands it [m/s]; slower than the second it has stopped and holds its
place [m/s]."""
HOVER_FLOOR = 0.15
"""Below this height above its start it does not hover to rest, but lands [m]."""
MIN_HEIGHT = 0.1
"""Lowest height above its start that an order may name [m]."""
MIN_UPRIGHT = 0.3
"""It cuts its rotors when the cosine of its tilt is less."""
_MAX_INTEGRAL = 3.0


class Motion(NamedTuple):
    """Its motion."""

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
    """Keeps the phase of the flight, and follows the order."""

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
        if order.kind == "take_off" and self.phase == "landed" and now.upright > MIN_UPRIGHT:
            self._take_off(now, given(order.height, now.position[2] + TAKE_OFF_HEIGHT))
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
        """The order, with the heading and the height that it keeps where the order names none; NaN while it brakes to one."""
        order, height = self._order, self._place[2] if self._holds[2] else math.nan
        if self.phase == "landed" or order.kind not in ("course", "hover", "take_off"):
            return order
        return filled(order, self._yaw if order.kind != "take_off" else order.yaw, height)

    def _nearly_down(self, order: Manoeuvre, now: Motion) -> bool:
        """The order is to rest, so low that it does not hover, but lands."""
        return order.kind == "rest" and now.position[2] - self._floor < HOVER_FLOOR

    def touched(self, now: Motion) -> None:
        """It stands on something."""
        sinks = self.phase == "landing" or (self.phase == "flying" and self._wanted(now)[2] < -MIN_SINK_ORDER)
        if sinks and abs(now.velocity[2]) < 0.1:
            self.phase = "landed"

    def fly(self, now: Motion) -> tuple[float, Vec3] | None:
        """Thrust [N] and torque [N m]; None on the ground."""
        if now.upright < MIN_UPRIGHT:
            self.phase = "landed"
        if self.phase == "landed":
            return None  # only the order to take off starts the rotors: people may stand beside them
        if self.phase == "taking_off" and now.position[2] > self._place[2] - 0.08:
            self.phase = "flying"
        yaw_rate = self._turn(now)
        ax, ay, az = self._accelerate(now)
        roll, pitch = self._tilts(now, ax, ay)
        body = self._parameters.body
        thrust = body.mass * max(0.0, GRAVITY + az) / max(now.upright, 0.5)
        wanted = (
            ATTITUDE_GAIN * wrap(roll - now.angles[0]),
            ATTITUDE_GAIN * wrap(pitch - now.angles[1]),
            yaw_rate,
        )
        torque = [
            moment * gain * (rate - turning)
            for moment, gain, rate, turning in zip(
                body.inertia, (RATE_GAIN, RATE_GAIN, YAW_RATE_GAIN), wanted, now.turning, strict=True
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
        return min(max(height, self._floor + MIN_HEIGHT), self._floor + self._limits.height)

    def _turn(self, now: Motion) -> float:
        """Turn rate that is wanted [rad/s]."""
        if self._order.kind in ("twist", "tilt") and self.phase == "flying":
            rate = within(self._order.twist.angular.z, self._limits.yaw_rate)
            if rate:
                self._yaw = now.angles[2]
                return rate
        return within(YAW_GAIN * wrap(self._yaw - now.angles[2]), self._limits.yaw_rate)

    def _wanted(self, now: Motion) -> Vec3:
        """Velocity in the world that the order asks for [m/s]; 0 where it asks for a place to be kept."""
        order, limits = self._order, self._limits
        if self.phase == "landing":
            low = now.position[2] - self._floor < 0.6
            return 0.0, 0.0, -TOUCHDOWN_SPEED if low else -LANDING_SPEED
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
        slow = math.hypot(now.velocity[0], now.velocity[1]) < HOLD_SPEED, abs(now.velocity[2]) < HOLD_SPEED
        result = []
        for axis in range(3):
            if moving[axis]:
                self._holds[axis] = False
            elif not self._holds[axis] and slow[axis // 2]:
                self._holds[axis], self._place[axis] = True, now.position[axis]
            velocity = wanted[axis]
            if self._holds[axis]:
                limit = self._limits.climb if axis == 2 else self._limits.speed / 2
                velocity = within(POSITION_GAIN * (self._place[axis] - now.position[axis]), limit)
            lack = velocity - now.velocity[axis]
            self._sums[axis] = within(
                self._sums[axis] + VELOCITY_INTEGRAL_GAIN * lack * STEP_PERIOD, _MAX_INTEGRAL
            )
            drag = self._parameters.body.drag[axis] / self._parameters.body.mass * velocity
            result.append(VELOCITY_GAIN * lack + self._sums[axis] + drag)
        if now.position[2] > self._floor + self._limits.height and result[2] > 0:
            result[2] = -VELOCITY_GAIN * max(0.0, now.velocity[2])
        return result[0], result[1], result[2]

    def _tilts(self, now: Motion, ax: float, ay: float) -> tuple[float, float]:
        """Roll and pitch that accelerate it so in the world, or that a tilt asks for [rad]."""
        limit = self._limits.tilt
        if self._order.kind == "tilt" and self.phase == "flying":
            self._sums[0] = self._sums[1] = 0.0
            self._holds[0] = self._holds[1] = False
            return within(self._order.roll, limit), within(self._order.pitch, limit)
        cosine, sine = math.cos(now.angles[2]), math.sin(now.angles[2])
        ahead, left = cosine * ax + sine * ay, cosine * ay - sine * ax
        tilt = math.atan(math.hypot(ahead, left) / GRAVITY)
        share = min(1.0, limit / tilt) if tilt > 0 else 1.0
        return -math.atan(left / GRAVITY) * share, math.atan(ahead / GRAVITY) * share
