"""A quadrotor: its figures, its rotors, and the forces on it."""

from __future__ import annotations

import math

from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Limits, Positive, Table
from sim.core.shapes import Vec3

__all__ = ["ROTORS", "QuadrotorBody", "QuadrotorLimits", "RotorParameters", "Rotors"]

ROTORS = ["front_left", "front_right", "rear_right", "rear_left"]
_PLACES = ((1, 1, -1), (1, -1, 1), (-1, -1, -1), (-1, 1, 1))
"""Of each rotor: ahead or behind, left or right, and which way its drag turns the body."""


class QuadrotorBody(Table, frozen=True, kw_only=True):
    """The body, a flat square box."""

    mass: Positive
    """[kg]"""
    inertia: tuple[Positive, Positive, Positive]
    """[kg m2]"""
    width: Positive
    """[m]"""
    height: Positive
    """[m]"""
    drag: tuple[Positive, Positive, Positive]
    """Linear, along x, y and z [N s/m]."""
    friction: Positive


class RotorParameters(Table, frozen=True, kw_only=True):
    """The rotors, all alike."""

    arm: Positive
    """From the middle of the body to an axis [m]."""
    lift: Positive
    """[N/(rad/s)2]"""
    torque: Positive
    """[N m/(rad/s)2]"""
    lag: Positive
    """Time constant of their speed [s]."""
    speed: Positive
    """The most [rad/s]."""
    gear: Positive
    """Turns of a motor for one of its rotor."""


class QuadrotorLimits(Limits, frozen=True, kw_only=True):
    """Limits of the vehicle."""

    climb: Positive
    """Upward and downward [m/s]."""
    tilt: Positive
    """Roll and pitch [rad]."""
    height: Positive
    """Above where it started [m]."""


class Rotors:
    """The four rotors, which follow their commands with a lag."""

    def __init__(self, parameters: RotorParameters) -> None:
        """At rest."""
        self._parameters = parameters
        self._reach = parameters.arm / math.sqrt(2)
        self._keep = math.exp(-1 / (parameters.lag * STEPS_PER_SECOND))
        self._yaw = parameters.torque / parameters.lift
        self.speeds = [0.0] * 4
        """[rad/s]"""
        self.targets = [0.0] * 4
        """[rad/s]"""

    @property
    def torques(self) -> list[float]:
        """Drag of each [N m]."""
        return [self._parameters.torque * speed * speed for speed in self.speeds]

    def command(self, thrust: float, torque: Vec3) -> None:
        """Give `thrust` upward [N] and `torque` [N m] as far as the rotors can; the thrust goes before the yaw."""
        roll, pitch, yaw = torque[0] / 4 / self._reach, torque[1] / 4 / self._reach, torque[2] / 4 / self._yaw
        limit = self._parameters.lift * self._parameters.speed**2
        tilting = [thrust / 4 + y * roll - x * pitch for x, y, _ in _PLACES]
        spare = max(0.0, min(*tilting, limit - max(tilting)))
        yaw = min(max(yaw, -spare), spare)
        for number, (lift, (_, _, turns)) in enumerate(zip(tilting, _PLACES, strict=True)):
            wanted = min(max(lift + turns * yaw, 0.0), limit)
            self.targets[number] = math.sqrt(wanted / self._parameters.lift)

    def stop(self) -> None:
        """Turn no more."""
        self.targets = [0.0] * 4

    def step(self) -> tuple[float, Vec3]:
        """One step later: thrust upward [N] and torque [N m] on the body."""
        keep, lift = self._keep, self._parameters.lift
        thrust = roll = pitch = yaw = 0.0
        for number, (x, y, turns) in enumerate(_PLACES):
            target = self.targets[number]
            speed = target + keep * (self.speeds[number] - target)
            self.speeds[number] = speed
            force = lift * speed * speed
            thrust += force
            roll += y * force
            pitch -= x * force
            yaw += turns * force
        return thrust, (roll * self._reach, pitch * self._reach, yaw * self._yaw)
