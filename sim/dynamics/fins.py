"""Six fins that swing: each pushes towards where it points, the harder the farther it swings."""

from __future__ import annotations

import math

from bridge.core.units import wrap
from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Positive, Table
from sim.core.shapes import Vec3
from sim.dynamics.control import towards, within

__all__ = ["LEGS", "FinParameters", "Fins"]

LEGS = ["front_left", "middle_left", "rear_left", "front_right", "middle_right", "rear_right"]


class FinParameters(Table, frozen=True, kw_only=True):
    """The fins, all alike."""

    length: Positive
    """[m]"""
    root: Positive
    """Width at the hip [m]."""
    tip: Positive
    """Width at the end [m]."""
    thrust: Positive
    """Factor K1 of the thrust."""
    amplitude: Positive
    """Farthest swing to each side [rad]."""
    frequency: Positive
    """Of the swing [Hz]."""
    places: tuple[float, float, float]
    """Of the hips along x [m], front to rear."""
    aside: Positive
    """Of the middle of a fin from the middle plane [m]."""
    turn_rate: Positive
    """Of where a fin points, at most [rad/s]."""
    swing_rate: Positive
    """Of the amplitude, at most [rad/s]."""


class Fins:
    """The six fins: direction and swing of each, and the commanded ones."""

    def __init__(self, parameters: FinParameters, density: float) -> None:
        """Still, pointing back, in water of this `density` [kg/m3]."""
        own = self._parameters = parameters
        self._per_swing = own.thrust * (own.root + 2 * own.tip) * own.length**2 / 3 * density * own.frequency
        self.strongest = self._per_swing * own.amplitude
        """Thrust of one fin at full swing [N]."""
        self._hips = [(x, side * own.aside) for side in (1, -1) for x in own.places]
        self._along = 2 * sum(x * x for x in own.places)
        self._across = 6 * own.aside**2
        self.offsets = [0.0] * 6
        """Direction of the thrust of each [rad]: 0 ahead, a right angle up."""
        self.amplitudes = [0.0] * 6
        """[rad]"""
        self._targets = [(0.0, 0.0)] * 6
        self._phase = 0.0

    @property
    def angles(self) -> list[float]:
        """Of the legs as they stand now [rad]; neighbours swing against each other."""
        return [
            offset + amplitude * math.sin(self._phase + (math.pi if number % 2 else 0.0))
            for number, (offset, amplitude) in enumerate(zip(self.offsets, self.amplitudes, strict=True))
        ]

    @property
    def speeds(self) -> list[float]:
        """Greatest of each swing [rad/s]."""
        return [math.tau * self._parameters.frequency * amplitude for amplitude in self.amplitudes]

    @property
    def torques(self) -> list[float]:
        """Mean at each hip [N m]."""
        return [self._per_swing * amplitude * self._parameters.length for amplitude in self.amplitudes]

    def command(self, force: tuple[float, float], torque: Vec3) -> None:
        """Share out a `force` ahead and up [N] and a `torque` [N m] among the fins: the least that does it.

        The share of a fin is cut to its greatest swing.
        """
        ahead, up = force[0] / 6, force[1] / 6
        roll, pitch, yaw = torque[0] / self._across, torque[1] / self._along, torque[2] / self._across
        limit = self._parameters.amplitude
        for number, (x, y) in enumerate(self._hips):
            fx, fz = ahead - yaw * y, up + roll * y - pitch * x
            strength = math.hypot(fx, fz)
            direction = math.atan2(fz, fx) if strength > 1e-6 else self.offsets[number]
            self._targets[number] = (direction, min(strength / self._per_swing, limit))

    def rest(self) -> None:
        """Hold still."""
        self._targets = [(offset, 0.0) for offset in self.offsets]

    def step(self) -> tuple[tuple[float, float], Vec3]:
        """One step later: force ahead and up [N], torque [N m]."""
        own = self._parameters
        turn, swing = own.turn_rate / STEPS_PER_SECOND, own.swing_rate / STEPS_PER_SECOND
        self._phase = (self._phase + math.tau * own.frequency / STEPS_PER_SECOND) % math.tau
        ahead = up = roll = pitch = yaw = 0.0
        for number, (x, y) in enumerate(self._hips):
            direction, amplitude = self._targets[number]
            offset = self.offsets[number]
            offset = wrap(offset + within(wrap(direction - offset), turn))
            amplitude = towards(self.amplitudes[number], amplitude, swing)
            self.offsets[number], self.amplitudes[number] = offset, amplitude
            if amplitude <= 0.0:
                continue
            thrust = self._per_swing * amplitude
            fx, fz = thrust * math.cos(offset), thrust * math.sin(offset)
            ahead, up = ahead + fx, up + fz
            roll, pitch, yaw = roll + y * fz, pitch - x * fz, yaw - y * fx
        return (ahead, up), (roll, pitch, yaw)
