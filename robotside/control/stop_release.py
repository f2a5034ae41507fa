"""Releasing STOP by the robot's own time: held for a second, by one and the same operator, and not again at once.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from bridge.core.codes import Code
from robotside.core.notice import Notice, Problem
from robotside.core.text import number

__all__ = ["MAX_HOLD_TIME", "MIN_HOLD_TIME", "NOT_HELD", "PRESSED_SINCE", "RELEASE_PAUSE", "StopRelease"]

MIN_HOLD_TIME = 1.0
"""So long a hold has lasted at least when STOP is released [s]."""

MAX_HOLD_TIME = 5.0
"""Later than this after it began a hold is over [s]."""

RELEASE_PAUSE = 3.0
"""So long after a release the next hold begins at the earliest [s]."""

MAX_HOLDS = 64
"""As many holds are remembered; the oldest are forgotten first."""

PRESSED_SINCE = Notice(Code.STOP_PRESSED_SINCE, "STOP was pressed after this request: it stays.")

NOT_HELD = Notice(
    Code.STOP_NOT_HELD,
    f"STOP stays: hold Release for {MIN_HOLD_TIME:.0f} s, or call /stop/release again after {MIN_HOLD_TIME:.0f} to {MAX_HOLD_TIME:.0f} s.",
)


@dataclass(frozen=True, slots=True)
class _Hold:
    begun: float
    given: float
    """When it was asked for [s]; a STOP that was given later voids it."""


class StopRelease:
    """The holds that are under way, by the ids of their operators' connections."""

    def __init__(self) -> None:
        self._holds: dict[str, _Hold] = {}
        self._next = -math.inf

    def hold(self, client: str, given: float, now: float) -> Problem:
        """`client` begins to hold; a hold of its own that was under way begins anew. It was asked for when it was `given`."""
        if now < self._next:
            wait = self._next - now
            said = f"STOP was released lately; hold Release again in {number(wait)} s."
            return Notice(Code.STOP_RELEASED_LATELY, said, seconds=wait)
        self._holds.pop(client, None)
        self._holds[client] = _Hold(now, min(given, now))
        while len(self._holds) > MAX_HOLDS:
            del self._holds[next(iter(self._holds))]
        return ""

    def objection(self, client: str, stop_given: float, now: float) -> Problem:
        """Why `client` does not release the STOP that was given then [s]; empty when it may."""
        hold = self._holds.get(client)
        if hold is None:
            return NOT_HELD
        lasted = now - hold.begun
        if not 0.0 <= lasted <= MAX_HOLD_TIME:
            del self._holds[client]
            return NOT_HELD
        if hold.given < stop_given:
            return PRESSED_SINCE
        if lasted < MIN_HOLD_TIME:
            left = MIN_HOLD_TIME - lasted
            return Notice(
                Code.STOP_HELD_SHORT, f"STOP stays: hold Release {number(left)} s longer.", seconds=left
            )
        return ""

    def on_released(self, now: float) -> None:
        """STOP is released: every hold is over, and the next begins a pause later."""
        self._holds.clear()
        self._next = now + RELEASE_PAUSE
