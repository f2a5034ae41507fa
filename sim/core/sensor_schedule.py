"""Schedule of the sensors: each measures at its own rate, on the grid of the physics steps."""

from __future__ import annotations

import math
from collections.abc import Mapping

from sim.core.constants import STEPS_PER_SECOND

__all__ = ["Schedule"]

_NONE: tuple[str, ...] = ()
_TOGETHER: Mapping[str, int] = {}


class Schedule:
    """Names with rates; each falls due at the first step at or after every whole period, and at step 0.

    One that falls due `after` has some steps between a whole period and its own, so that not all fall due together.
    """

    def __init__(self, rates: Mapping[str, float], after: Mapping[str, int] = _TOGETHER) -> None:
        """`rates` in [Hz], each at most one a step; `after` in steps, each less than its period."""
        self._periods = {name: STEPS_PER_SECOND / rate for name, rate in rates.items()}
        self._after = {name: after.get(name, 0) for name in rates}
        # one that has steps of its own falls due at step 0 as well, and so counts one period more
        self._counts = {name: -1 if steps else 0 for name, steps in self._after.items()}
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
            whole = math.ceil(self._counts[name] * self._periods[name] - 1e-9)
            self._next[name] = whole + self._after[name]
        self._soonest = min(self._next.values())
        return names
