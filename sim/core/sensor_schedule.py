"""Schedule of the sensors: each measures at its own rate, on the grid of the physics steps."""

from __future__ import annotations

import math
from collections.abc import Mapping

from sim.core.constants import STEPS_PER_SECOND

__all__ = ["Schedule"]

_NONE: tuple[str, ...] = ()


class Schedule:
    """Names with rates; each falls due at the first step at or after every whole period, and at step 0."""

    def __init__(self, rates: Mapping[str, float]) -> None:
        """`rates` in [Hz], each at most one a step."""
        self._periods = {name: STEPS_PER_SECOND / rate for name, rate in rates.items()}
        self._counts = dict.fromkeys(rates, 0)
        self._next = dict.fromkeys(rates, 0)
        self._soonest = 0

    def anything_due(self, step: int) -> bool:
        """Whether `due` will return anything for `step`; a step for which it does not may be left out."""
        return step >= self._soonest

    def is_due(self, name: str, step: int) -> bool:
        """Whether `name` will be among the names that `due` returns for `step`, which has not been asked for yet."""
        return self._next[name] <= step

    def due(self, step: int) -> tuple[str, ...]:
        """The names that fall due at `step`, in the order given; steps are asked for in order, none left out."""
        if step < self._soonest:
            return _NONE
        names = tuple(name for name, next_ in self._next.items() if next_ <= step)
        for name in names:
            self._counts[name] += 1
            self._next[name] = math.ceil(self._counts[name] * self._periods[name] - 1e-9)
        self._soonest = min(self._next.values())
        return names
