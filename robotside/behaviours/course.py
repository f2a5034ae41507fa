"""The points of a task: which is next, how many are done, how far it is."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence

from robotside.guide import Goal

__all__ = ["Course"]

PACE = 0.8
"""Of the cruising speed that is made good on the whole, turns and slow arrivals included."""


class Course:
    """The order in which points are visited, and the count of it."""

    def __init__(
        self,
        goals: Sequence[Goal],
        *,
        motion: str = "loop",
        laps: int = 1,
        dwell: float = 0.0,
        rng: random.Random | None = None,
    ) -> None:
        self.goals = tuple(goals)
        self.motion, self.laps, self.dwell = motion, laps, dwell
        self._rng = rng
        self.index = -1
        """Of the point it heads for, from 0; -1 before the first."""
        self.visited = 0
        """Points reached."""
        self.passed = 0
        """Points reached or given up."""
        self.skipped_in_a_row = 0
        self._longest = 0.0

    @property
    def total(self) -> int:
        """Visits to make; 0 goes on until stopped. A single point is visited once where laps are not counted."""
        laps = self.laps or (1 if len(self.goals) == 1 else 0)
        return laps * len(self.goals)

    @property
    def lap(self) -> int:
        """From 1."""
        last = max(self.total - 1, 0) if self.total else self.passed
        return min(self.passed, last) // len(self.goals) + 1

    @property
    def goal(self) -> Goal:
        """The point it heads for."""
        return self.goals[max(self.index, 0)]

    def advance(self) -> Goal:
        """Choose the next point: the one after this, or in random motion any but this."""
        count, self._longest = len(self.goals), 0.0
        if self.motion == "random" and self._rng is not None and count > 1:
            others = [number for number in range(count) if number != self.index]
            self.index = self._rng.choice(others)
        else:
            self.index = (self.index + 1) % count
        return self.goal

    def reached(self) -> None:
        """The robot stands at the point."""
        self.visited += 1
        self.passed += 1
        self.skipped_in_a_row = 0

    def skip(self) -> bool:
        """Give this point up; True when there is another that may still be reached."""
        self.passed += 1
        self.skipped_in_a_row += 1
        return self.skipped_in_a_row < len(self.goals)

    def progress(self, remaining: float) -> float:
        """Done of this lap, or of the whole where laps are counted, 0 to 1; `remaining` [m] of this leg."""
        visits = self.total or len(self.goals)
        done = self.passed if self.total else self.passed % len(self.goals)
        self._longest = max(self._longest, remaining)
        part = 0.0 if math.isnan(remaining) else 1.0 - remaining / max(self._longest, 0.1)
        return min(1.0, (done + part * (done < visits)) / visits)

    def time_left(self, remaining: float, cruise: float) -> float:
        """To the end of this lap, or of the whole where laps are counted [s], at `cruise` [m/s]; NaN when unknown."""
        if math.isnan(remaining):
            return math.nan
        visits = self.total or len(self.goals)
        done = self.passed if self.total else self.passed % len(self.goals)
        coming = range(self.index, self.index + visits - done - 1)
        metres = remaining + sum(self._leg(number, number + 1) for number in coming)
        return metres / (PACE * cruise) + self.dwell * (visits - done)

    def _leg(self, start: int, end: int) -> float:
        a, b = self.goals[start % len(self.goals)], self.goals[end % len(self.goals)]
        return math.hypot(b.x - a.x, b.y - a.y)
