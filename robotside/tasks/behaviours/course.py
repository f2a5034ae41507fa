"""The points of a task: which is next, how many are done, how far it is; and the progress of a task without points."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol

import msgspec

from robotside.navigation.navigator import Goal

__all__ = ["Course", "Noted", "Outline", "Route", "Span"]

PACE_SHARE = 0.8
"""Of the cruising speed that is made good on the whole, turns and slow arrivals included."""

SAME_DISTANCE = 0.05
"""Points nearer than this to each other are the same one [m]."""


class Noted(msgspec.Struct, frozen=True):
    """The progress of a task, as it is kept for a restart."""

    index: int = -1
    visited: int = 0
    passed: int = 0
    laps: int = 0
    """Rounds done before the points were last changed."""
    standing: bool = False
    spent: float = 0.0
    """Of a task that takes a time [s]."""


class Outline(Protocol):
    """The progress of any task. Of one without points, `count` is 0."""

    motion: str
    laps: int
    visited: int

    @property
    def count(self) -> int:
        """Points."""

    @property
    def places(self) -> list[str]:
        """Names of those points that have one."""

    @property
    def number(self) -> int:
        """Of the point it heads for, from 1; 0 for none."""

    @property
    def lap(self) -> int:
        """From 1."""

    def progress(self, remaining: float) -> float:
        """Done, 0 to 1; `remaining` [m] of this leg."""

    def time_left(self, remaining: float, cruise: float) -> float:
        """To the end [s] at `cruise` [m/s], without what the present phase takes; NaN when unknown."""

    def noted(self) -> Noted:
        """How far it is."""

    def take_up(self, noted: Noted) -> None:
        """Go on from there."""


class Route(NamedTuple):
    """The points of a patrol and how they are visited."""

    goals: tuple[Goal, ...]
    motion: str
    laps: int
    dwell: float


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
        """Points reached or given up, since the points were last changed."""
        self.skipped_in_a_row = 0
        self._before = 0
        """Rounds done before that."""
        self._longest = self._part = 0.0
        self._standing = False
        """The point was reached or given up, and the next one is not chosen yet."""
        self._again = False
        self._coming: Route | None = None

    @property
    def total(self) -> int:
        """Visits to make with these points; 0 goes on until stopped. A single one is visited once where laps are not counted."""
        if not self.laps:
            return 1 if len(self.goals) == 1 else 0
        return max(self.laps - self._before, 0) * len(self.goals)

    @property
    def finished(self) -> bool:
        """There is nothing left to visit."""
        bounded = self.laps > 0 or len(self.goals) == 1
        return bounded and self.passed >= self.total

    @property
    def lap(self) -> int:
        """From 1."""
        last = max(self.total - 1, 0) if self.total else self.passed
        return self._before + min(self.passed, last) // len(self.goals) + 1

    @property
    def goal(self) -> Goal:
        """The point it heads for."""
        return self.goals[max(self.index, 0)]

    @property
    def count(self) -> int:
        """Points."""
        return len(self.goals)

    @property
    def places(self) -> list[str]:
        """Names of those points that are places with a name."""
        return [goal.place for goal in self.goals if goal.place]

    @property
    def number(self) -> int:
        """Of the point it heads for, from 1; 0 before the first."""
        return self.index + 1

    def edit(self, route: Route) -> None:
        """Have other points, which count from the next choice on."""
        self._coming = route

    def take_over(self) -> bool:
        """Go on with the points of the last `edit`; True when there were any.

        After a point that is among the new ones as well comes the one behind it, else the one in its place.
        """
        coming, self._coming = self._coming, None
        if coming is None:
            return False
        if self.index < 0:
            self.goals, self.motion, self.laps, self.dwell = coming
            return True
        here = self.goal
        same = [n for n, goal in enumerate(coming.goals) if _apart(goal, here) < SAME_DISTANCE]
        index = same[0] if same else min(self.index, len(coming.goals)) - 1
        self._before = self.lap - 1 if not self.finished else self.lap
        whole = self.passed > 0 and self.passed % len(self.goals) == 0
        self.goals, self.motion, self.laps, self.dwell = coming
        self.index, self._again = index, False
        self.passed = 0 if whole else min(index + 1, len(self.goals) - 1)
        return True

    def advance(self) -> Goal:
        """Choose the next point: the one after this, or in random motion any but this."""
        count, self._longest, self._part, self._standing = len(self.goals), 0.0, 0.0, False
        if self._again:
            self._again = False
        elif self.motion == "random" and self._rng is not None and count > 1:
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
        self._standing = True

    def skip(self) -> bool:
        """Give this point up; True when there is another that may still be reached."""
        self.passed += 1
        self.skipped_in_a_row += 1
        self._standing = True
        return self.skipped_in_a_row < len(self.goals)

    def progress(self, remaining: float) -> float:
        """Done of this lap, or of the whole where laps are counted, 0 to 1; `remaining` [m] of this leg."""
        visits, done = self._visits()
        self._longest = max(self._longest, remaining)
        if not math.isnan(remaining):  # else it has come as far as it was known last
            self._part = 1.0 - remaining / max(self._longest, 0.1)
        part = self._part * (not self._standing and done < visits)
        earlier = self._before * len(self.goals) if self.total else 0
        return min(1.0, (earlier + done + part) / (earlier + visits))

    def time_left(self, remaining: float, cruise: float) -> float:
        """To the end of this lap, or of the whole where laps are counted [s], at `cruise` [m/s]; NaN when unknown."""
        remaining = 0.0 if self._standing else remaining
        if math.isnan(remaining):
            return math.nan
        visits, done = self._visits()
        first = max(self.index, 0)
        coming = range(first, first + max(visits - done - (not self._standing), 0))
        metres = remaining + sum(self._leg(number, number + 1) for number in coming)
        return metres / (PACE_SHARE * cruise) + self.dwell * max(visits - done, 0)

    def noted(self) -> Noted:
        """How far it is."""
        return Noted(self.index, self.visited, self.passed, self._before, self._standing)

    def take_up(self, noted: Noted) -> None:
        """Go on from there; from the start when that fits no point."""
        if not 0 <= noted.index < len(self.goals) or min(noted.visited, noted.passed, noted.laps) < 0:
            return
        self.index, self.visited, self.passed = noted.index, noted.visited, noted.passed
        self._before, self._again = noted.laps, not noted.standing

    def _visits(self) -> tuple[int, int]:
        """To make of this lap or of the whole, and how many of them are done."""
        visits = self.total or len(self.goals)
        return visits, min(self.passed, visits) if self.total else self.passed % len(self.goals)

    def _leg(self, start: int, end: int) -> float:
        a, b = self.goals[start % len(self.goals)], self.goals[end % len(self.goals)]
        return math.hypot(b.x - a.x, b.y - a.y)


class Span:
    """A task that takes a time, or lasts until it is stopped, and visits nothing."""

    motion = ""
    laps = 1
    lap = 1
    count = 0
    number = 0
    visited = 0

    def __init__(self, duration: float, clock: Callable[[], float]) -> None:
        """`duration` [s], NaN until stopped; `clock` stands still while the task is paused [s]."""
        self.duration = duration
        self._clock = clock
        self._began: float | None = None
        self._before = 0.0

    def begin(self) -> None:
        """The time runs from now on."""
        if self._began is None:
            self._began = self._clock()

    @property
    def places(self) -> list[str]:
        """None."""
        return []

    @property
    def spent(self) -> float:
        """Of the time [s]."""
        return self._before + (self._clock() - self._began if self._began is not None else 0.0)

    @property
    def over(self) -> bool:
        """The time is over; never when it lasts until stopped."""
        return self.spent >= self.duration - 1e-6

    def progress(self, remaining: float) -> float:
        """Part of the time that is over; NaN when it lasts until stopped."""
        return math.nan if math.isnan(self.duration) else min(1.0, self.spent / max(self.duration, 1e-3))

    def time_left(self, remaining: float, cruise: float) -> float:
        """[s]; NaN when it lasts until stopped."""
        return max(0.0, self.duration - self.spent) if not math.isnan(self.duration) else math.nan

    def noted(self) -> Noted:
        """How far it is."""
        return Noted(spent=self.spent)

    def take_up(self, noted: Noted) -> None:
        """Go on from there."""
        self._before = max(0.0, noted.spent)


def _apart(a: Goal, b: Goal) -> float:
    up = 0.0 if math.isnan(a.height + b.height) else a.height - b.height
    return math.hypot(a.x - b.x, a.y - b.y, up)
