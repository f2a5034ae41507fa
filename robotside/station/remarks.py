"""Remarks on bad commands, each kind at most every few seconds."""

from __future__ import annotations

import math
from collections.abc import Callable

from robotside.core.notice import Problem
from robotside.records.events import Say

__all__ = ["Remarks"]

REMARK_PERIOD = 3.0
"""Remarks of one key are made at most this often [s]."""


class Remarks:
    """Makes remarks as events of the kind `command`."""

    def __init__(self, say: Say, clock: Callable[[], float]) -> None:
        """`clock` is the operators' [s]."""
        self._say, self._clock = say, clock
        self._next: dict[str, float] = {}

    def make(self, key: str, remark: Problem) -> Problem:
        """Make a remark unless one of the same `key` was made lately; an empty one is none. Returns it in any case."""
        now = self._clock()
        if remark and now >= self._next.get(key, -math.inf):
            self._next[key] = now + REMARK_PERIOD
            self._say("command", remark, "warn")
        return remark

    def forget(self, key: str) -> None:
        """No more remarks of `key` are to come."""
        self._next.pop(key, None)
