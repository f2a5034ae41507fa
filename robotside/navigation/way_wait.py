"""The wait before a way that is blocked by something that may go again: it stands, and looks anew when something has gone."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem
from robotside.navigation.planner import Unreachable

__all__ = ["BLOCKED_TIMEOUT", "WayWait"]

BLOCKED_TIMEOUT = 35.0
"""So long it waits on one leg for its way to be free [s]: longer than anything is remembered that nobody sees again."""

RETRY_PERIOD = 1.0
"""Least time between two looks for a way [s]."""


class WayWait:
    """Times are of the robot's clock [s]."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Another leg, or the same one from elsewhere."""
        self._spent = 0.0
        self._since, self._looked, self._cleared = math.inf, -math.inf, 0
        self.text = ""
        """Why it waits, as one sentence; empty when it does not."""

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing happened."""
        self._since += seconds
        self._looked += seconds

    def over(self, now: float) -> None:
        """There is a way; what was waited before counts when it is blocked again."""
        self._spent += max(0.0, now - self._since)
        self._since, self.text = math.inf, ""

    def _time(self, now: float) -> float:
        """How long it has waited on this leg [s]."""
        return self._spent + max(0.0, now - self._since)

    def blocked(self, problem: Unreachable, name: str, now: float, cleared: int) -> Problem:
        """There is no way to `name` for now: empty while it is worth waiting, else why it gives up.

        `cleared` counts what was forgotten of the obstacles so far.
        """
        self._since = min(self._since, now)
        self._looked, self._cleared = now, cleared
        x, y = problem.blocked or (math.nan, math.nan)
        if self._time(now) >= BLOCKED_TIMEOUT:
            self.forget()
            said = f"{str(problem)[:-1]}; it did not become free within {BLOCKED_TIMEOUT:.0f} s."
            return Notice(Code.WAY_BLOCKED, said, place=name, x=x, y=y)
        self.text = f"Way blocked at ({x:.1f}, {y:.1f}), waiting."
        if problem.gap:
            gap = str(problem.gap)
            self.text = f"Way blocked: {gap}; waiting."
        return ""

    def holds(self, now: float, cleared: int) -> bool:
        """It waits and there is no reason to look for a way now: nothing has gone, and the time is not over."""
        if not self.text:
            return False
        due = cleared != self._cleared and now - self._looked >= RETRY_PERIOD
        return not due and self._time(now) < BLOCKED_TIMEOUT
