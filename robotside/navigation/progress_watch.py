"""The watches over a leg: who gets ready to go for too long gives up; who gets no nearer plans anew, and gives up after some times."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem

__all__ = ["MAX_STUCK", "READY_TIMEOUT", "STUCK_TIMEOUT", "ProgressWatch", "ReadyWatch"]

READY_TIMEOUT = 20.0
"""To get ready to go [s]."""

STUCK_TIMEOUT = 10.0
"""Without getting nearer for this long, the way is blocked [s]."""

MAX_STUCK = 3
"""Times stuck on one leg before it is given up."""

MIN_PROGRESS = 0.1
"""Less than this is none [m]."""


class ProgressWatch:
    """Times are of the robot's clock [s]."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """A new leg."""
        self._best, self._times = math.inf, 0
        self.pause()

    def pause(self) -> None:
        """It stands on purpose; the time runs anew when it goes on."""
        self._moved = -math.inf

    def wait(self, seconds: float) -> None:
        """A way was looked for meanwhile, which does not count."""
        self._moved += seconds

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing happened."""
        self.wait(seconds)

    @property
    def given_up(self) -> bool:
        """It has stood as often as is borne on one leg."""
        return self._times >= MAX_STUCK

    def stands(self, left: float, now: float) -> bool:
        """It has got no nearer for too long at `now`, with `left` [m] to go; time for another plan, if it is not `given_up`."""
        if self._moved == -math.inf or left < self._best - MIN_PROGRESS:
            self._moved, self._best = now, left
            return False
        if now - self._moved < STUCK_TIMEOUT:
            return False
        self._times += 1
        self._moved = now
        if not self.given_up:
            self._best = math.inf
        return True


class ReadyWatch:
    """Over who gets ready to go; times are of the robot's clock [s]."""

    def __init__(self) -> None:
        self._since = math.inf

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing happened."""
        self._since += seconds

    def late(self, waits: str, now: float) -> Problem:
        """Why it gives up, which `waits` for that sentence now, empty when it is ready; empty while there is time."""
        self._since = min(self._since, now) if waits else math.inf
        if not now - self._since > READY_TIMEOUT:
            return ""
        said = f"{waits[:-1]} took longer than {READY_TIMEOUT:.0f} s; the robot stays where it is."
        return Notice(Code.TASK_SLOW, said, seconds=READY_TIMEOUT)
