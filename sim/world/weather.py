"""Wind, waves and current of a world as they are at each moment."""

from __future__ import annotations

import math

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.core.shapes import Vec3
from sim.world.tables import Wave
from sim.world.world import World

__all__ = ["Weather"]

_BLOCK = 240
"""Draws of a gust's generator at a time: one by one they cost more than a vehicle's model."""


class _Gusts:
    """A slow random wind on top of the steady one: along x, y and z a first-order Gauss-Markov process."""

    def __init__(self, deviation: float, time: float, noise: Noise) -> None:
        self._keep = math.exp(-1 / (time * STEPS_PER_SECOND))
        self._kick = deviation * math.sqrt(1 - self._keep**2)
        self._noise = noise
        self._draws: list[float] = []
        self.now: Vec3 = (noise.normal(deviation), noise.normal(deviation), noise.normal(deviation / 2))

    def step(self) -> None:
        if not self._draws:
            self._draws = self._noise.normals(self._kick, 3 * _BLOCK).tolist()
        keep, draws, (x, y, z) = self._keep, self._draws, self.now
        self.now = (keep * x + draws.pop(), keep * y + draws.pop(), keep * z + draws.pop() / 2)


class _Airy:
    """One train of waves in deep water: the surface rises by a cos(k.x - w t + phase)."""

    def __init__(self, wave: Wave) -> None:
        self.amplitude = wave.height / 2
        self.speed = math.tau / wave.period
        number = self.speed**2 / GRAVITY
        direction = math.radians(wave.direction)
        self.kx, self.ky = number * math.cos(direction), number * math.sin(direction)
        self.phase = math.radians(wave.phase)


class Weather:
    """The air and the water of one world; the same for all that is in it."""

    def __init__(self, world: World, noise: Noise) -> None:
        """At the first moment; `noise` decides the gusts."""
        water, wind = world.water, world.wind
        self.wet = water is not None
        """There is water."""
        self.density = water.density if water else 0.0
        """Of the water [kg/m3]."""
        self.current: Vec3 = (*water.current, 0.0) if water else (0.0, 0.0, 0.0)
        """Of the water, everywhere [m/s]."""
        self.waves = [_Airy(wave) for wave in water.waves] if water else []
        self.wind: Vec3 = (0.0, 0.0, 0.0)
        """Velocity of the air, now and everywhere [m/s]."""
        self.time = 0.0
        """Since the start [s]."""
        self._steps = 0
        self._steady: Vec3 = (0.0, 0.0, 0.0)
        self._gusts: _Gusts | None = None
        if wind:
            direction = math.radians(wind.direction)
            self._steady = (wind.speed * math.cos(direction), wind.speed * math.sin(direction), 0.0)
            self._gusts = _Gusts(wind.gusts, wind.gust_time, noise) if wind.gusts else None
        self.wind = self._steady

    def step(self) -> None:
        """One physics step later."""
        self._steps += 1
        self.time = self._steps / STEPS_PER_SECOND
        if self._gusts:
            self._gusts.step()
            (x, y, z), (gx, gy, gz) = self._steady, self._gusts.now
            self.wind = (x + gx, y + gy, z + gz)

    def surface(self, x: float, y: float) -> float:
        """Height of the water's surface at (x, y) [m], now."""
        height, time = 0.0, self.time
        for wave in self.waves:
            height += wave.amplitude * math.cos(wave.kx * x + wave.ky * y - wave.speed * time + wave.phase)
        return height
