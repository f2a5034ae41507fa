"""Control of the swimmer's attitude, depth and speed: from an order to a force and a torque."""

from __future__ import annotations

import math

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.shapes import Vec3
from sim.dynamics.control import filled, given, within
from sim.dynamics.sixdof import SixDof
from sim.vehicles.aqua.parameters import AquaParameters

__all__ = ["Pilot"]

STEP_PERIOD = 1 / STEPS_PER_SECOND
ROLL_GAINS, PITCH_GAINS, YAW_GAINS = (1.6, 0.8), (3.0, 2.6), (2.0, 2.2)
"""Torque for an error of the angle [N m/rad] and for a turn rate [N m s]."""
SURGE_GAIN = 16.0
"""Force for an error of the speed [N s/m]."""
HEAVE_GAIN, HEAVE_RATE_GAIN, HEAVE_INTEGRAL_GAIN, MAX_HEAVE = 55.0, 90.0, 8.0, 6.0
"""Force for an error of the height [N/m], for its rate [N s/m], for its integral [N/(m s)], and at most [N]."""
BRAKING_TIME = 2.5
"""Its fins brake for at most this time and are still then, because people may be near them [s]."""
STILL_SPEED = 0.04
"""It lies still when it moves ahead and turns slower than this [m/s, rad/s]."""
_INTEGRAL_RANGE = 0.1
"""The error of the height is integrated only within this range [m]."""
HEIGHT_LEAD, HEIGHT_LEAD_TIME, MAX_HEIGHT_LEAD = 0.05, 2.0, 1.0
"""The held height may be this far ahead of the body [m], and farther for a climb [s]: no farther than the fins need, so that
the body does not overshoot when the climb ends; and this far when the body is pushed away from it [m]."""
DIVING_PITCH = 0.1
"""Smallest pitch at which it goes up and down by swimming, not by holding its height [rad]."""


class Pilot:
    """Holds roll, pitch, yaw and height; a twist moves the held values at its rates."""

    def __init__(self, parameters: AquaParameters, drag: float) -> None:
        """`drag` ahead at 1 m/s [N]."""
        self._limits, self._drag = parameters.limits, drag
        self._afloat = parameters.body.height / 2 - parameters.body.height / parameters.body.buoyancy
        self._upright = parameters.body.mass * GRAVITY * parameters.body.buoyancy * parameters.body.lift_arm
        self._spare = parameters.body.mass * GRAVITY * (parameters.body.buoyancy - 1)
        self._order = Manoeuvre(kind="rest")
        self._roll = self._pitch = self._yaw = self._height = 0.0
        self._sum = 0.0
        self._climbs = False
        self._braking = 0.0

    def begin(self, order: Manoeuvre, body: SixDof, *, fresh: bool) -> None:
        """Follow `order`; a `fresh` kind begins with what the body does now."""
        roll, pitch, yaw = angles(body)
        limit = self._limits.tilt
        if fresh:
            self._roll, self._pitch = within(roll, limit), within(pitch, limit)
            self._yaw, self._height = yaw, body.position[2]
            self._sum = 0.0
            self._braking = BRAKING_TIME
        if order.kind in ("course", "hover", "surface"):
            self._roll = self._pitch = 0.0
            self._yaw = given(order.yaw, self._yaw) if order.kind != "surface" else self._yaw
            self._height = given(order.height, self._height) if order.kind != "surface" else self._afloat
        elif order.kind == "tilt":
            self._roll, self._pitch = within(order.roll, limit), within(order.pitch, limit)
        self._order = order

    @property
    def held(self) -> Manoeuvre:
        """The order, with the heading and the height that it keeps where the order names none."""
        order = self._order
        return filled(order, self._yaw, self._height) if order.kind in ("course", "hover") else order

    def wrench(self, body: SixDof, wet: float) -> tuple[tuple[float, float], Vec3]:
        """Force ahead and up [N] and torque [N m] that the fins should give."""
        self._move(body)
        ux, _, uz = body.axes[6:]
        u, v, w = body.through
        speed = self._speed()
        surge = self._drag * abs(speed) * speed + SURGE_GAIN * (speed - u)
        if self._diving(speed):
            self._height, self._sum, heave = body.position[2], 0.0, -self._spare * wet
        else:
            up = ux * u + body.axes[7] * v + uz * w
            heave = self._heave(self._height - body.position[2], up, wet)
        roll, pitch, yaw = angles(body)
        p, q, r = body.turning
        torque = (
            ROLL_GAINS[0] * wrap(self._roll - roll) - ROLL_GAINS[1] * p + self._upright * body.axes[7],
            PITCH_GAINS[0] * wrap(self._pitch - pitch) - PITCH_GAINS[1] * q - self._upright * ux,
            YAW_GAINS[0] * wrap(self._yaw - yaw) - YAW_GAINS[1] * r,
        )
        return (surge + heave * ux, heave * uz), torque

    def braking(self, body: SixDof) -> tuple[tuple[float, float], Vec3] | None:
        """Force [N] and torque [N m] that brake it; None when it hardly moves, or has not stopped in time: it glides as it rises."""
        self._braking -= STEP_PERIOD
        u = body.through[0]
        p, q, r = body.turning
        if self._braking < 0 or (abs(u) < STILL_SPEED and abs(r) < STILL_SPEED):
            return None
        return (-2 * SURGE_GAIN * u, 0.0), (-ROLL_GAINS[1] * p, -PITCH_GAINS[1] * q, -YAW_GAINS[1] * r)

    def _move(self, body: SixDof) -> None:
        """Move the held attitude and height by the rates of a twist or a tilt."""
        order, limits = self._order, self._limits
        if order.kind not in ("twist", "tilt"):
            return
        turn = order.twist.angular
        if order.kind == "twist":
            self._roll = within(self._roll + STEP_PERIOD * turn.x, limits.tilt)
            self._pitch = within(self._pitch + STEP_PERIOD * turn.y, limits.tilt)
        self._yaw = wrap(self._yaw + STEP_PERIOD * within(turn.z, limits.yaw_rate))
        climb = within(order.twist.linear.z, limits.climb)
        lead = HEIGHT_LEAD + HEIGHT_LEAD_TIME * abs(climb) if climb or self._climbs else MAX_HEIGHT_LEAD
        self._climbs = climb != 0.0
        ahead_of = within(self._height + STEP_PERIOD * climb - body.position[2], lead)
        self._height = min(self._afloat, body.position[2] + ahead_of)

    def _speed(self) -> float:
        order, limit = self._order, self._limits.speed
        if order.kind == "twist":
            return within(order.twist.linear.x, limit)
        if order.kind in ("course", "tilt"):
            return within(given(order.speed, given(order.throttle, 0.0) * limit), limit)
        return 0.0

    def _diving(self, speed: float) -> bool:
        return abs(self._pitch) > DIVING_PITCH and speed != 0.0 and self._order.kind in ("twist", "tilt")

    def _heave(self, off: float, rising: float, wet: float) -> float:
        if abs(off) < _INTEGRAL_RANGE and wet >= 1.0:
            self._sum = within(self._sum + HEAVE_INTEGRAL_GAIN * off * STEP_PERIOD, 2.0)
        wanted = within(HEAVE_GAIN * off, HEAVE_RATE_GAIN * self._limits.climb)
        return within(wanted - HEAVE_RATE_GAIN * rising + self._sum - self._spare * wet, MAX_HEAVE)


def angles(body: SixDof) -> Vec3:
    """Roll, pitch and yaw of a body [rad]."""
    a, _, _, d, _, _, ux, uy, uz = body.axes
    return math.atan2(uy, uz), -math.asin(within(ux, 1.0)), math.atan2(d, a)
