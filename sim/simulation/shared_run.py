"""A simulation that one or several robots share: the first one read moves it on, and none misses a message."""

from __future__ import annotations

from collections.abc import Callable

from sim.core.constants import STEPS_PER_SECOND
from sim.simulation.simulation import Simulation

__all__ = ["SharedRun"]

_STEP_TOLERANCE = 1e-3
"""Part of a step by which `now` may fall short of it: so that the clock's rounding causes no wait."""


class SharedRun:
    """Owns the simulation; it is freed when the last of its robots leaves."""

    def __init__(self, simulation: Simulation) -> None:
        """Nothing has moved yet."""
        self.simulation = simulation
        self.origin: float | None = None
        """Time of the first step [s, robots' clock]; None until a robot is first read."""
        self._listeners: list[Callable[[], None]] = []

    def join(self, collect: Callable[[], None]) -> None:
        """Let `collect` be called after every step."""
        self._listeners.append(collect)

    def leave(self, collect: Callable[[], None]) -> None:
        """No longer call it; frees the simulation when no robot is left. Leaving twice does nothing."""
        if collect in self._listeners:
            self._listeners.remove(collect)
            if not self._listeners:
                self.simulation.close()

    @property
    def now(self) -> float:
        """[s, robots' clock]"""
        return (self.origin or 0.0) + self.simulation.time

    def skip_to(self, now: float) -> None:
        """Let what is simulated stand still up to `now` [s]: it goes on from there, and measures with the time of then."""
        if self.origin is not None:
            self.origin = max(self.origin, now - self.simulation.time)

    def advance(self, now: float) -> None:
        """Simulate up to `now` [s]; the first call sets the origin and simulates nothing."""
        if self.origin is None:
            self.origin = now
        goal = int((now - self.origin) * STEPS_PER_SECOND + _STEP_TOLERANCE)
        while self.simulation.steps < goal:
            self.simulation.advance()
            for collect in tuple(self._listeners):
                collect()
