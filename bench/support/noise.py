"""Noise of the machine: the same piece of work, timed again and again between the measurements."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass, field

__all__ = ["Noise"]

ROUNDS_AT_FIRST = 20_000
WANTED = 0.03
"""Time that the piece of work is made to take [s]: longer than a slice of the scheduler."""


def _work(rounds: int) -> int:
    total = 0
    for number in range(rounds):
        total += number * number & 7
    return total


@dataclass(slots=True)
class Noise:
    """Times a busy loop of fixed length; the first call finds the length that takes about `WANTED`."""

    now: Callable[[], float] = time.perf_counter
    cpu: Callable[[], float] = time.thread_time
    work: Callable[[int], object] = _work
    slowness: list[float] = field(default_factory=list)
    """Time of each run over the fastest one's; 1 is a quiet machine. Rescaled when a faster one comes."""
    waiting: list[float] = field(default_factory=list)
    """Share of each run in which others had the core, 0..1."""
    load: list[float] = field(default_factory=list)
    """The machine's load average of the last minute at each run."""
    _times: list[float] = field(default_factory=list)
    _rounds: int = 0

    def sample(self) -> None:
        """Run the loop once."""
        if not self._rounds:
            self._rounds = self._calibrated()
        wall, cpu = self._timed(self._rounds)
        self._times.append(wall)
        self.slowness = [time / min(self._times) for time in self._times]
        self.waiting.append(max(0.0, 1 - cpu / wall))
        self.load.append(os.getloadavg()[0])

    def _calibrated(self) -> int:
        best = min(self._timed(ROUNDS_AT_FIRST)[0] for _ in range(3))
        return max(ROUNDS_AT_FIRST, round(ROUNDS_AT_FIRST * WANTED / best))

    def _timed(self, rounds: int) -> tuple[float, float]:
        wall, cpu = self.now(), self.cpu()
        self.work(rounds)
        return self.now() - wall, self.cpu() - cpu
