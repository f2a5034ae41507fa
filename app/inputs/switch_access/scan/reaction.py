"""A test of how fast somebody presses, and the pace of the mark that suits that hand.

test = Reaction(random.Random())
test.start(now); test.update(now); test.press(now)      # until test.phase is "done"
test.interval
"""

from __future__ import annotations

import math
import random
import statistics
from typing import Literal

from app.inputs.switch_access.scan.settings import RANGES

__all__ = ["PRESS_SHARE", "Reaction"]

PRESS_SHARE = 0.65
"""Interval = mean time of a press / 0.65, which is about the mean and two deviations: Simpson, Koester, LoPresti 2007."""
TRIALS, PRACTICE = 6, 2
"""So many presses count, after so many that do not."""
WAIT_RANGE = (1.0, 2.8)
"""Before the sign comes, at random [s]."""
FASTEST, SLOWEST = 0.1, 4.0
"""A press sooner after the sign was meant for no sign; without one for longer it is missed [s]."""
PAUSE_TIME = 0.8
"""Between a press and the next wait [s]."""


class Reaction:
    """One test. Times are our clock's [s]."""

    def __init__(self, rng: random.Random) -> None:
        self._rng = rng
        self.phase: Literal["idle", "wait", "go", "early", "missed", "taken", "done"] = "idle"
        """`wait` for the sign, `go` while it is there; `early`, `missed` and `taken` tell of the last press for a moment."""
        self.times: list[float] = []
        """Of each press that counts, and of those for practice before them [s]."""
        self._due = math.inf
        self._shown = math.nan

    @property
    def done(self) -> int:
        """Presses so far, practice included."""
        return len(self.times)

    @property
    def of(self) -> int:
        """Presses in all."""
        return TRIALS + PRACTICE

    @property
    def mean(self) -> float:
        """Of those that count [s]; NaN before the end."""
        return statistics.fmean(self.times[PRACTICE:]) if len(self.times) >= self.of else math.nan

    @property
    def interval(self) -> float:
        """To propose, in tenths, within what may be set [s]; NaN before the end."""
        low, high = RANGES["interval"]
        return (
            math.nan
            if math.isnan(self.mean)
            else min(high, max(low, math.ceil(self.mean / PRESS_SHARE * 10 - 1e-9) / 10))
        )

    def start(self, now: float) -> None:
        """Begin, or begin anew."""
        self.times = []
        self._wait(now)

    def quit(self) -> None:
        """End it without a result."""
        self.phase, self._due, self.times = "idle", math.inf, []

    def update(self, now: float) -> bool:
        """Bring the sign, or take it away; True where something changed."""
        if now < self._due:
            return False
        if self.phase == "wait":
            self.phase, self._shown, self._due = "go", now, now + SLOWEST
        elif self.phase == "go":
            self.phase, self._due = "missed", now + PAUSE_TIME
        else:
            self._wait(now)
        return True

    def press(self, now: float) -> None:
        """The switch went down at `now`."""
        if self.phase == "wait" or (self.phase == "go" and now - self._shown < FASTEST):
            self.phase, self._due = "early", now + PAUSE_TIME
        elif self.phase == "go":
            self.times.append(now - self._shown)
            over = len(self.times) >= self.of
            self.phase, self._due = ("done", math.inf) if over else ("taken", now + PAUSE_TIME)

    def _wait(self, now: float) -> None:
        self.phase, self._due = "wait", now + self._rng.uniform(*WAIT_RANGE)
