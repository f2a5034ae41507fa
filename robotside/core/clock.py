"""The robot's clock when a simulation runs at another speed than real time, or falls behind it.

A clock that is behind is how old the newest data are. A little of that is made good; what is more is given up: the clock goes on
at the right time and a simulation has done nothing in between, so that data are never old.
"""

from __future__ import annotations

import math

__all__ = ["MAX_LAG", "MAX_TICK", "MAX_STEP", "RobotClock"]

MAX_TICK = 0.25
"""The most real time that one tick makes good [s]: after a longer halt the robot's clock falls behind."""

CATCH_UP = 0.1
"""Part by which ticks are longer until a clock that fell behind is right again."""


MAX_STEP = 1 / 30
"""Longest step of the robot's clock [s]."""

MAX_LAG, KEPT_LAG = 0.5, 0.1
"""A clock that is farther behind is given up, but for so much of it [s], real time."""


class RobotClock:
    """Turns real time into the robot's; jumps only where `give_up` says so."""

    def __init__(self, wall: float, speed: float = 1.0) -> None:
        """`wall` is real time at the start [s], where both clocks agree; `speed` is robot seconds per real second."""
        self._start = self._last = wall
        self._speed = speed
        self.now = wall
        """The robot's clock [s]."""

    def tick(self, wall: float) -> float:
        """Advance to real time `wall` [s] as far as is allowed; returns the robot's clock [s]."""
        passed = min(max(wall - self._last, 0.0), MAX_TICK)
        self._last = max(wall, self._last)
        due = self._start + (self._last - self._start) * self._speed
        self.now = min(due, self.now + passed * self._speed * (1.0 + CATCH_UP))
        return self.now

    def steps(self, wall: float) -> list[float]:
        """Like `tick`, in steps so short that a robot can be steered between them; none when no time passed."""
        before = self.now
        passed = self.tick(wall) - before
        count = math.ceil(passed / MAX_STEP - 1e-9)
        return [before + passed * number / count for number in range(1, count + 1)]

    def lag(self, wall: float) -> float:
        """How far it is behind what is due at real time `wall` [s, real time]; negative never."""
        due = self._start + (max(wall, self._last) - self._start) * self._speed
        return max(0.0, due - self.now) / self._speed

    def give_up(self, wall: float) -> float:
        """Jump to just behind real time `wall` [s] if it is farther behind than MAX_LAG; by how much it jumped [s, robot clock]."""
        lag = self.lag(wall)
        if lag <= MAX_LAG:
            return 0.0
        lost = (lag - KEPT_LAG) * self._speed
        self.now += lost
        return lost

    def cut(self, now: float) -> None:
        """The steps of the last tick were done up to `now` [s] only; the rest of it is still due."""
        self.now = min(self.now, now)

    def at(self, wall: float) -> float:
        """The robot's clock [s] at real time `wall` [s]; good for moments about the last tick."""
        return self.now + (wall - self._last) * self._speed

    def real(self, stamp: float) -> float:
        """Real time [s] at which the robot's clock showed `stamp` [s]; good for moments about the last tick."""
        return self._last - (self.now - stamp) / self._speed
