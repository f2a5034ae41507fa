"""Keeps the swimmer's attitude, depth and speed: from an order to a force and a torque."""

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

STEP = 1 / STEPS_PER_SECOND
ROLL, PITCH, YAW = (1.6, 0.8), (3.0, 2.6), (2.0, 2.2)
"""Torque for an angle that is off [N m] and for a turn rate [N m s]."""
SURGE = 16.0
"""Force for a speed that lacks [N s/m]."""
HEAVE, HEAVE_RATE, HEAVE_SUM, HEAVE_MOST = 55.0, 90.0, 8.0, 6.0
"""Force for a height that is off [N/m], for its rate [N s/m], for what was off so far [N/(m s)], and at most [N]."""
BRAKING = 2.5
"""Its fins take its way off it for so long, and are still then: somebody may be near them [s]."""
STILL = 0.04
"""Slower ahead, and turning slower than this, it lies still [m/s, rad/s]."""
_NEAR = 0.1
"""Only nearer than this does what was off add up [m]."""
LEAD, LEAD_RATE, FARTHEST = 0.05, 2.0, 1.0
"""How far the height that is held may be ahead of the body [m], and how much farther for a climb [s]: no farther than the
fins need it, so that it goes no farther when told to climb no more; and how far when it is pushed away from it [m]."""
DIVING = 0.1
"""From this pitch on it goes up and down by swimming, not by holding its height [rad]."""


class Pilot:
    """Holds roll, pitch, yaw and height; a twist moves what is held, at its rates."""

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
            self._braking = BRAKING
        if order.kind in ("course", "hover", "surface"):
            self._roll = self._pitch = 0.0
            self._yaw = given(order.yaw, self._yaw) if order.kind != "surface" else self._yaw
            self._height = given(order.height, self._height) if order.kind != "surface" else self._afloat
        elif order.kind == "tilt":
            self._roll, self._pitch = within(order.roll, limit), within(order.pitch, limit)
        self._order = order

    @property
    def held(self) -> Manoeuvre:
        """The order, with what it took for the heading and the height that are not named in it."""
        order = self._order
        return filled(order, self._yaw, self._height) if order.kind in ("course", "hover") else order

    def wants(self, body: SixDof, wet: float) -> tuple[tuple[float, float], Vec3]:
        """Force ahead and up [N] and torque [N m] that the fins should give."""
        self._move(body)
        ux, _, uz = body.axes[6:]
        u, v, w = body.through
        speed = self._speed()
        surge = self._drag * abs(speed) * speed + SURGE * (speed - u)
        if self._diving(speed):
            self._height, self._sum, heave = body.position[2], 0.0, -self._spare * wet
        else:
            up = ux * u + body.axes[7] * v + uz * w
            heave = self._heave(self._height - body.position[2], up, wet)
        roll, pitch, yaw = angles(body)
        p, q, r = body.turning
        torque = (
            ROLL[0] * wrap(self._roll - roll) - ROLL[1] * p + self._upright * body.axes[7],
            PITCH[0] * wrap(self._pitch - pitch) - PITCH[1] * q - self._upright * ux,
            YAW[0] * wrap(self._yaw - yaw) - YAW[1] * r,
        )
        return (surge + heave * ux, heave * uz), torque

    def brakes(self, body: SixDof) -> tuple[tuple[float, float], Vec3] | None:
        """What takes its way off it; None when it hardly makes any, or did not lose it in time: it glides as it rises."""
        self._braking -= STEP
        u = body.through[0]
        p, q, r = body.turning
        if self._braking < 0 or (abs(u) < STILL and abs(r) < STILL):
            return None
        return (-2 * SURGE * u, 0.0), (-ROLL[1] * p, -PITCH[1] * q, -YAW[1] * r)

    def _move(self, body: SixDof) -> None:
        """Move what is held by the rates of a twist or a tilt."""
        order, limits = self._order, self._limits
        if order.kind not in ("twist", "tilt"):
            return
        turn = order.twist.angular
        if order.kind == "twist":
            self._roll = within(self._roll + STEP * turn.x, limits.tilt)
            self._pitch = within(self._pitch + STEP * turn.y, limits.tilt)
        self._yaw = wrap(self._yaw + STEP * within(turn.z, limits.yaw_rate))
        climb = within(order.twist.linear.z, limits.climb)
        lead = LEAD + LEAD_RATE * abs(climb) if climb or self._climbs else FARTHEST
        self._climbs = climb != 0.0
        ahead_of = within(self._height + STEP * climb - body.position[2], lead)
        self._height = min(self._afloat, body.position[2] + ahead_of)

    def _speed(self) -> float:
        order, most = self._order, self._limits.speed
        if order.kind == "twist":
            return within(order.twist.linear.x, most)
        if order.kind in ("course", "tilt"):
            return within(given(order.speed, given(order.throttle, 0.0) * most), most)
        return 0.0

    def _diving(self, speed: float) -> bool:
        return abs(self._pitch) > DIVING and speed != 0.0 and self._order.kind in ("twist", "tilt")

    def _heave(self, off: float, rising: float, wet: float) -> float:
        if abs(off) < _NEAR and wet >= 1.0:
            self._sum = within(self._sum + HEAVE_SUM * off * STEP, 2.0)
        wanted = within(HEAVE * off, HEAVE_RATE * self._limits.climb)
        return within(wanted - HEAVE_RATE * rising + self._sum - self._spare * wet, HEAVE_MOST)


def angles(body: SixDof) -> Vec3:
    """Roll, pitch and yaw of a body [rad]."""
    a, _, _, d, _, _, ux, uy, uz = body.axes
    return math.atan2(uy, uz), -math.asin(within(ux, 1.0)), math.atan2(d, a)
