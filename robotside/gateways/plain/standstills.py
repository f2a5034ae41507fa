"""Standstills of the robot's loop: what came meanwhile waited, for nobody knows how long, and nobody may want it any more."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable

__all__ = ["ROUNDS", "STALL_PERIOD", "STALL_TIMEOUT", "Standstills"]

STALL_PERIOD, STALL_TIMEOUT = 0.25, 1.0
"""The loop is looked at so often [s]; when it stood still for longer than that [s], what waited meanwhile is too old."""
ROUNDS = 16
"""After a standstill all that waited in the machine is read within so many rounds of the loop: to take a connection is some five."""


class Standstills:
    """Knows when a loop stood still, as a process that was stopped or starved; belongs to that loop."""

    def __init__(self, clock: Callable[[], float] | None = None) -> None:
        """`clock` only goes forward [s], the loop's when left out."""
        self._clock = clock
        self._beat = math.inf
        self._over = -math.inf
        """Until when what was read may have waited [s]; infinite while the loop still reads such."""
        self._rounds = 0
        self._timer: asyncio.TimerHandle | None = None

    def start(self) -> None:
        """Begin to watch the running loop."""
        self._beat = self.now()
        self._look_later()

    def stop(self) -> None:
        """Watch no more; from now on there are no standstills."""
        self._beat = math.inf
        if self._timer is not None:
            self._timer.cancel()

    def now(self) -> float:
        """The time of the clock [s]."""
        return self._clock() if self._clock else asyncio.get_running_loop().time()

    def touches(self, read: float) -> bool:
        """Whether what was read at that time [s] waited through a standstill, or has stood through one since."""
        self._look()
        return read <= self._over

    def _look_later(self) -> None:
        self._timer = asyncio.get_running_loop().call_later(STALL_PERIOD, self._look_on)

    def _look_on(self) -> None:
        self._look()
        self._look_later()

    def _look(self) -> None:
        now = self.now()
        stood = now - self._beat > STALL_PERIOD + STALL_TIMEOUT
        if self._beat < math.inf:
            self._beat = now
        if not stood:
            return
        counts, self._rounds, self._over = self._rounds > 0, ROUNDS, math.inf
        if not counts:
            asyncio.get_running_loop().call_soon(self._round)

    def _round(self) -> None:
        """One round of the loop after a standstill."""
        self._rounds -= 1
        if self._rounds > 0:
            asyncio.get_running_loop().call_soon(self._round)
        else:
            self._over = self.now()
