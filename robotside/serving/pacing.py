"""The pace of the loop that drives the stations: the steps of one tick, and what is given up when they take too long."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from robotside.core.clock import MAX_TICK, RobotClock
from robotside.core.loop_timing import LoopTiming

__all__ = ["Pacing"]


class Pacing:
    """Gives the moments to which the robots are brought, by the clock that they share."""

    def __init__(self, clock: RobotClock, wall: Callable[[], float]) -> None:
        """`wall` is real time [s]."""
        self._clock, self._wall = clock, wall
        self._began = math.nan
        self._done = 0.0
        self.timing = LoopTiming()
        """Of the last seconds."""

    def begin(self) -> float:
        """A tick begins: by how much the clock jumps, since it was too far behind [s, robot clock]; 0 as a rule."""
        wall = self._wall()
        lag = self._clock.lag(wall)
        if not math.isnan(self._began):
            self.timing.on_tick(self._began, wall, done=self._done, lag=lag)
        self._began, self._done = wall, 0.0
        return self._clock.give_up(wall)

    def steps(self) -> Iterator[float]:
        """Moments of the robots' clock [s] to be brought to one after the other; none after too long a time for one tick."""
        before = self._clock.now
        for now in self._clock.steps(self._wall()):
            self._done += now - before
            before = now
            yield now
            if self._wall() - self._began > MAX_TICK:
                self._clock.cut(now)
                return
