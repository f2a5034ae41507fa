"""A boat with a propeller and a rudder: their figures, their forces, and the controller of speed and course."""

from __future__ import annotations

import math

from bridge.core.units import wrap
from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Limits, Part, Positive, Table
from sim.core.shapes import Vec3
from sim.dynamics.control import towards, within

__all__ = ["BoatController", "BoatDrive", "Propeller", "Rudder"]


class Propeller(Table, frozen=True, kw_only=True):
    """The propeller."""

    thrust: Positive
    """The most ahead [N]."""
    astern: Part
    """The most astern, as a part of that."""
    lag: Positive
    """Time constant of the thrust [s]."""
    diameter: Positive
    """[m]"""
    speed: Positive
    """Turning at full thrust [rad/s]."""
    torque: Positive
    """At full thrust [N m]."""


class Rudder(Table, frozen=True, kw_only=True):
    """The rudder, at the stern behind the propeller."""

    area: Positive
    """[m2]"""
    lift: Positive
    """Slope of its lift [1/rad]."""
    wash: Part
    """Part of the propeller's jet that meets it."""
    limit: Positive
    """[rad]"""
    rate: Positive
    """[rad/s]"""
    radius: Positive
    """Of the turn with the rudder hard over [m]."""


class BoatDrive:
    """Propeller and rudder, which follow their commands as fast as they can."""

    def __init__(self, propeller: Propeller, rudder: Rudder, length: float, density: float) -> None:
        """At rest, rudder amidships, on a hull of this `length` [m] in water of this `density` [kg/m3]."""
        self._propeller, self._rudder = propeller, rudder
        self._stern = -length / 2
        self._keep = math.exp(-1 / (self._propeller.lag * STEPS_PER_SECOND))
        self._density = density
        self._disc = density * math.pi * self._propeller.diameter**2 / 4
        self.throttle = 0.0
        """Command to the propeller, -1 to 1; may be set."""
        self.wanted = 0.0
        """Command to the rudder [rad], positive turns to the left; may be set."""
        self.angle = 0.0
        """Of the rudder [rad]."""
        self.thrust = 0.0
        """[N]"""

    @property
    def turning(self) -> tuple[float, float]:
        """Speed [rad/s] and torque [N m] of the propeller."""
        share = self.thrust / self._propeller.thrust
        return math.copysign(
            math.sqrt(abs(share)), share
        ) * self._propeller.speed, share * self._propeller.torque

    def authority(self, speed: float) -> float:
        """Square of the flow past the rudder at a `speed` ahead [m2/s2]."""
        jet = max(self.thrust, 0.0) / self._disc * self._rudder.wash
        return speed * abs(speed) + jet

    def step(self, speed: float) -> tuple[Vec3, float]:
        """One step later: force [N] and yaw moment [N m] on the boat, which goes ahead through the water at `speed`."""
        propeller, rudder = self._propeller, self._rudder
        share = min(max(self.throttle, -1.0), 1.0)
        goal = propeller.thrust * (share if share > 0 else share * propeller.astern)
        self.thrust = goal + self._keep * (self.thrust - goal)
        self.angle = towards(self.angle, within(self.wanted, rudder.limit), rudder.rate / STEPS_PER_SECOND)
        turned = math.sin(self.angle)
        lift = self._density / 2 * rudder.area * rudder.lift * turned * self.authority(speed)
        return (self.thrust - abs(lift * turned), -lift * math.cos(self.angle), 0.0), -lift * self._stern


class BoatController:
    """Keeps a speed and a course, or a turn, by throttle and rudder."""

    SPEED_GAIN = 1.0
    """Throttle for a speed that lacks [s/m]."""
    TURN_GAIN, TURN_SUM = 0.9, 0.6
    """Rudder for a turn rate that lacks [s], and for what it lacked so far [1]."""
    COURSE_GAIN = 0.9
    """Turn rate for a course that is off [1/s]."""
    STEERING_WAY = 0.12
    """Throttle without which the rudder has nothing to work with."""

    def __init__(self, limits: Limits, drag: float, drive: BoatDrive) -> None:
        """At ease; `drag` is the throttle that a speed of 1 m/s takes [s/m]."""
        self._drive = drive
        self._limits = limits
        self._drag = drag
        self._usual = limits.speed**2 / 2
        self._sum = 0.0

    def ease(self) -> None:
        """Forget what was lacking."""
        self._sum = 0.0

    def throttle_for(self, wanted: float, speed: float) -> float:
        """Throttle that holds the `wanted` speed [m/s] at `speed` through the water."""
        return min(max(self._drag * wanted + self.SPEED_GAIN * (wanted - speed), -1.0), 1.0)

    def course(self, yaw: float, wanted: float, turning: float, speed: float) -> None:
        """Turn towards the `wanted` yaw [rad] and stay on it."""
        off = wrap(wanted - yaw)
        self.turn(within(self.COURSE_GAIN * off, self._limits.yaw_rate), turning, speed)
        if abs(off) > 0.05 and abs(self._drive.throttle) < self.STEERING_WAY:
            self._drive.throttle = self.STEERING_WAY

    def turn(self, wanted: float, turning: float, speed: float) -> None:
        """Turn by the `wanted` rate [rad/s] at the rate and `speed` that it has."""
        flow = self._drive.authority(speed)
        gain = min(4.0, self._usual / max(abs(flow), 1e-3)) * (1.0 if flow >= 0 else -1.0)
        off = wanted - turning
        angle = gain * (self.TURN_GAIN * off + self.TURN_GAIN * wanted + self._sum)
        limit = 0.6
        if abs(angle) < limit or (angle > 0) != (off > 0):
            self._sum = within(self._sum + self.TURN_SUM * off / STEPS_PER_SECOND, limit)
        self._drive.wanted = within(angle, limit)
