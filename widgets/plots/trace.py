"""One line of a plot: which field it follows, what it has been told, and how it is told from the others."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.clock import Clock

from widgets.core.field_paths import number_at
from widgets.plots.columns import Columns
from widgets.plots.history import MAX_SAMPLES, Floats, History

__all__ = ["MAX_TRACES", "ROLES", "Trace"]

ROLES = ("accent", "plan", "ok", "warn", "text", "accent", "plan", "ok")
"""Role of each line's colour; each has a mark of its own besides, for one colour comes twice and hues alone tell nobody apart."""
MAX_TRACES = len(ROLES)
"""More lines in one plot are told apart by nobody."""
GAP_EVERY = 64
"""The usual pause between two samples is looked at anew after so many of them."""


class Trace:
    """A field over time. `show` takes messages; `add` takes numbers."""

    def __init__(
        self,
        path: str,
        name: str = "",
        unit: str = "",
        topic: str = "",
        *,
        scale: float = 1.0,
        most: int = MAX_SAMPLES,
        changed: Callable[[Trace, float, float], object] = lambda *_: None,
    ) -> None:
        """`path` as in `twist.twist.linear.x` or `ranges[3]`; what is there is multiplied by `scale`.

        `topic` is kept for whoever brings the messages; `most` samples are kept; `changed` is told of each new one.
        """
        self.path, self.topic, self.unit, self.scale = path, topic, unit, scale
        self.name = name or path
        """As the legend says it."""
        self.number = 0
        """Place among the lines of its plot, which gives colour and mark."""
        self.gap = 0.0
        """Two samples farther apart [s] are not joined; 0 goes by how far apart they usually are."""
        self.history, self.columns = History(most), Columns()
        self._changed = changed
        self._since_gap = 0

    @property
    def role(self) -> str:
        """Role of its colour."""
        return ROLES[self.number % MAX_TRACES]

    @property
    def mark(self) -> int:
        """Kind of its mark, from 1 on."""
        return self.number % MAX_TRACES + 1

    def show(self, msg: Any, at: float = math.nan) -> None:
        """Take the field of a message that came `at` [s], by Kivy's clock where nothing else is said.

        A place beyond the end of an array is a hole; AttributeError, TypeError or ValueError where the message has no such number.
        """
        try:
            value = number_at(msg, self.path)
        except IndexError:
            value = math.nan
        self.add(at, value * self.scale)

    def add(self, at: float, value: float) -> None:
        """Take a value of the time `at` [s], by Kivy's clock where that is NaN; NaN and infinity are holes in the line."""
        value = value if math.isfinite(value) else math.nan
        time = self.history.add(Clock.get_time() if math.isnan(at) else at, value)
        self._since_gap += 1
        if self._since_gap >= GAP_EVERY or len(self.history) < GAP_EVERY:
            self._since_gap = 0
            self.columns.gap = self.widest_gap
        self._changed(self, time, value)

    def load(self, times: Floats, values: Floats) -> None:
        """Take samples of a recording instead of what was there; times [s] rise."""
        self.history.load(times, values)

    @property
    def widest_gap(self) -> float:
        """Two samples farther apart [s] are not joined."""
        return self.gap if self.gap > 0 else self.history.usual_gap()

    def value_at(self, time: float) -> float:
        """What it was at `time` [s]; NaN in a hole and outside of what is known."""
        return self.history.at(time, self.widest_gap)
