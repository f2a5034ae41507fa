"""Random errors of sensors. Each sensor owns one generator, so that no sensor's draws depend on another's."""

from __future__ import annotations

import math
import zlib

import numpy as np
from numpy.typing import NDArray

__all__ = ["GaussMarkov", "Noise"]

_DRAWN_AT_ONCE = 64
"""Single draws that are made together, at a fifth of the time; they are the same ones."""


class Noise:
    """The generator of one sensor."""

    def __init__(self, seed: int, sensor: str, *, on: bool = True) -> None:
        """The same `seed` and name of `sensor` give the same draws; with `on` False all draws are 0."""
        self._rng = np.random.default_rng([seed, zlib.crc32(sensor.encode())])
        self._on = on
        self._drawn: list[float] = []
        """Drawn and not yet given, the next one last."""

    def normal(self, deviation: float) -> float:
        """One draw around 0."""
        if not self._on:
            return 0.0
        if not self._drawn:
            self._drawn = self._rng.standard_normal(_DRAWN_AT_ONCE)[::-1].tolist()
        return deviation * self._drawn.pop()

    def normals(self, deviation: float, count: int) -> NDArray[np.float64]:
        """`count` independent draws around 0."""
        if not self._on:
            return np.zeros(count)
        ready = [self._drawn.pop() for _ in range(min(count, len(self._drawn)))]
        return deviation * np.concatenate([ready, self._rng.standard_normal(count - len(ready))])


class GaussMarkov:
    """An error that changes slowly and stays bounded: a first-order Gauss-Markov process."""

    def __init__(self, noise: Noise, deviation: float, time: float, period: float) -> None:
        """`deviation` in the long run, correlated over `time` [s], stepped every `period` [s]."""
        self._noise = noise
        self._keep = math.exp(-period / time)
        self._kick = deviation * math.sqrt(1 - self._keep**2)
        self.value = noise.normal(deviation)
        """The error now, in the unit of `deviation`."""

    def step(self) -> float:
        """Go on by one period and give the new error."""
        self.value = self._keep * self.value + self._noise.normal(self._kick)
        return self.value
