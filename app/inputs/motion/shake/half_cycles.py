"""Half cycles to and fro along one direction, counted with hysteresis."""

from __future__ import annotations

import math

__all__ = ["HalfCycles"]

MAX_RUN_AGE = 0.3
"""A run that is no older belongs to the burst that begins [s]."""


class HalfCycles:
    """A run of them: each goes over the threshold on the other side of zero, and soon enough after the one before."""

    __slots__ = ("_side", "cap", "count", "evidence", "gap", "last", "peak", "since", "sum", "threshold")

    def __init__(self, threshold: float, gap: float, cap: float) -> None:
        """One counts from `threshold` on [m/s²], at most `gap` after the one before [s]; one gives at most `cap` of evidence."""
        self.threshold, self.gap, self.cap = threshold, gap, cap
        self.since = self.last = 0.0
        self.forget()

    def forget(self) -> None:
        """There is no run."""
        self._side = 0
        self.count = 0
        self.evidence = self.sum = self.peak = 0.0

    def begin(self, t: float) -> None:
        """A burst begins at `t` [s]: of what ran on before, only the last one counts."""
        if self.count and self.since < t - MAX_RUN_AGE:
            self.count = 1
            self.evidence, self.sum = min(self.peak / self.threshold, self.cap), self.peak
            self.since = t

    @property
    def mean(self) -> float:
        """Of the peaks of this run [m/s²]; 0 where there is none."""
        return self.sum / self.count if self.count else 0.0

    @property
    def period(self) -> float:
        """Mean time between two of them [s]; infinite where there is but one."""
        return (self.last - self.since) / (self.count - 1) if self.count > 1 else math.inf

    def feed(self, t: float, value: float) -> None:
        """What was measured along the direction at `t` [s, m/s²]."""
        side, threshold = self._side, self.threshold
        if (value > threshold and side <= 0) or (value < -threshold and side >= 0):
            if side == 0 or t - self.last > self.gap:
                self.forget()
                self.since = t
            self._side = 1 if value > 0 else -1
            self.peak = abs(value)
            self.count += 1
            self.last = t
            self.evidence += min(self.peak / threshold, self.cap)
            self.sum += self.peak
        elif side:
            if value * side > self.peak:
                height = value * side
                self.evidence += min(height / threshold, self.cap) - min(self.peak / threshold, self.cap)
                self.sum += height - self.peak
                self.peak = height
            elif t - self.last > self.gap:
                self.forget()
