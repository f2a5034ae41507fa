"""The timing of the loop that drives the robots: how fast robot time passes, and how far it is behind.

Pure: every call is told the time.
"""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

__all__ = ["MIN_TICKS", "WINDOW", "LoopTiming"]

WINDOW = 4.0
"""Real time over which it is measured [s]."""

MIN_TICKS = 4
"""With fewer ticks nothing is known yet."""


class _Tick(NamedTuple):
    began: float
    took: float
    done: float
    lag: float


class LoopTiming:
    """Measures the last seconds, without the longest tick of them: one halt is no lag."""

    def __init__(self) -> None:
        self._ticks: deque[_Tick] = deque(maxlen=1000)
        self.factor = 1.0
        """Robot time done in a second of real time [s/s]; 1 while it is not known."""
        self.lag = 0.0
        """How old the newest data were on average [s, real time]."""

    def on_tick(self, began: float, ended: float, *, done: float, lag: float) -> None:
        """A tick took from `began` to `ended` [s, real time], its wait for the next one included, and did `done` [s] of robot time.

        At its end the robot's clock was `lag` [s, real time] behind.
        """
        self._ticks.append(_Tick(began, max(0.0, ended - began), done, lag))
        while len(self._ticks) > MIN_TICKS and self._ticks[0].began < ended - WINDOW:
            self._ticks.popleft()
        if len(self._ticks) < MIN_TICKS:
            return
        longest = max(self._ticks, key=lambda tick: tick.took)
        ticks = [tick for tick in self._ticks if tick is not longest]
        took = sum(tick.took for tick in ticks)
        if took > 0:
            self.factor = sum(tick.done for tick in ticks) / took
            self.lag = sum(tick.lag * tick.took for tick in ticks) / took
