"""A quadrotor: its figures, its rotors, and the forces on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Self

from msgspec.structs import replace

from sim.core.load import Load, about, mass_of
from sim.core.parameters import CameraParameters, Limits, Parameters, Positive, Table
from sim.core.shapes import Vec3
from sim.physics.backend_bullet import GRAVITY, STEPS_PER_SECOND
from sim.sensors.height import HeightParameters
from sim.sensors.reckoning import ReckoningParameters

__all__ = ["ROTORS", "QuadrotorBody", "QuadrotorLimits", "QuadrotorParameters", "RotorParameters", "Rotors"]

ROTORS = ["front_left", "front_right", "rear_right", "rear_left"]
MOST_LOADED = 0.8
"""It carries a weight of so much of its greatest thrust: it steers and climbs by the rest."""
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
    """What it does at most."""

    climb: Positive
    """Upward and downward [m/s]."""
    tilt: Positive
    """Roll and pitch [rad]."""
    height: Positive
    """Above where it started [m]."""


class QuadrotorParameters(Parameters, frozen=True, kw_only=True):
    """The whole file of a quadrotor."""

    body: QuadrotorBody
    rotors: RotorParameters
    limits: QuadrotorLimits
    reckoning: ReckoningParameters
    range: HeightParameters
    front: CameraParameters
    down: CameraParameters

    @property
    def radius(self) -> float:
        """Of the circle that the body fits in [m]."""
        return self.body.width / math.sqrt(2)

    @property
    def deck(self) -> tuple[float, float, float]:
        """Where payloads are mounted, in `base_link` [m]."""
        return (0.0, 0.0, self.body.height / 2)

    def laden(self, loads: Sequence[Load]) -> Self:
        """Heavier: its rotors turn faster to carry it, and it turns more slowly; what it carries hangs in balance."""
        body, rotors = self.body, self.rotors
        mass = body.mass + mass_of(loads)
        most = MOST_LOADED * 4 * rotors.lift * rotors.speed**2 / GRAVITY
        if mass > most:
            name, spare = self.info.name, most - body.mass
            raise ValueError(
                f"{name} carries {spare:.2f} kg at most; what is to be mounted weighs {mass_of(loads):.2f} kg."
            )
        inertia = about((0.0, 0.0, 0.0), body.inertia, loads)
        return replace(self, body=replace(body, mass=mass, inertia=inertia))

    @property
    def cameras(self) -> tuple[CameraParameters, ...]:
        """Ahead and down."""
        return (self.front, self.down)

    @property
    def max_climb(self) -> float:
        """Greatest speed up and down [m/s]."""
        return self.limits.climb

    @property
    def max_tilt(self) -> float:
        """Greatest roll and pitch that it holds by order [rad]."""
        return self.limits.tilt

    @property
    def hover(self) -> float:
        """Speed of the rotors that carries its weight [rad/s]."""
        return math.sqrt(self.body.mass * GRAVITY / 4 / self.rotors.lift)


class Rotors:
    """The four rotors, which follow what they are told a little late."""

    def __init__(self, parameters: RotorParameters) -> None:
        """At rest."""
        self._parameters = parameters
        self._reach = parameters.arm / math.sqrt(2)
        self._keep = math.exp(-1 / (parameters.lag * STEPS_PER_SECOND))
        self._yaw = parameters.torque / parameters.lift
        self.speeds = [0.0] * 4
        """[rad/s]"""
        self.told = [0.0] * 4
        """[rad/s]"""

    @property
    def torques(self) -> list[float]:
        """Drag of each [N m]."""
        return [self._parameters.torque * speed * speed for speed in self.speeds]

    def tell(self, thrust: float, torque: Vec3) -> None:
        """Give `thrust` upward [N] and `torque` [N m] as far as the rotors can; the thrust goes before the yaw."""
        roll, pitch, yaw = torque[0] / 4 / self._reach, torque[1] / 4 / self._reach, torque[2] / 4 / self._yaw
        most = self._parameters.lift * self._parameters.speed**2
        tilting = [thrust / 4 + y * roll - x * pitch for x, y, _ in _PLACES]
        spare = max(0.0, min(*tilting, most - max(tilting)))
        yaw = min(max(yaw, -spare), spare)
        for number, (lift, (_, _, turns)) in enumerate(zip(tilting, _PLACES, strict=True)):
            wanted = min(max(lift + turns * yaw, 0.0), most)
            self.told[number] = math.sqrt(wanted / self._parameters.lift)

    def stop(self) -> None:
        """Turn no more."""
        self.told = [0.0] * 4

    def step(self) -> tuple[float, Vec3]:
        """One step later: thrust upward [N] and torque [N m] on the body."""
        keep, lift = self._keep, self._parameters.lift
        thrust = roll = pitch = yaw = 0.0
        for number, (x, y, turns) in enumerate(_PLACES):
            told = self.told[number]
            speed = told + keep * (self.speeds[number] - told)
            self.speeds[number] = speed
            force = lift * speed * speed
            thrust += force
            roll += y * force
            pitch -= x * force
            yaw += turns * force
        return thrust, (roll * self._reach, pitch * self._reach, yaw * self._yaw)
