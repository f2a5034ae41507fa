"""What a plot is made of: its lines, their words, and the stretch of time that is seen of them."""

from __future__ import annotations

import math
from typing import Any

from kivy.properties import NumericProperty, StringProperty

from widgets.parts.buttons import IconButton
from widgets.plots.time_view import TimeView
from widgets.plots.trace import Trace

__all__ = ["PlotBase"]


class PlotBase(TimeView):
    """Lines over a stretch of time. It says what there is to be drawn, and draws nothing."""

    title = StringProperty("")
    unit = StringProperty("")
    """Of the values, where all have the same."""
    epoch = NumericProperty(math.nan)
    """What is added to times to give the time of day [s since 1970], for a recording; NaN shows how long ago."""

    def __init__(self, **kwargs: Any) -> None:
        self.traces: list[Trace] = []
        """The lines, in the order of the legend. Made by `paths` or `trace`."""
        self.button = IconButton(icon="pause", bare=True, role="muted")
        """Holds the picture still, and lets it go on."""
        super().__init__(**kwargs)

    @property
    def lateness(self) -> float:
        """How long nothing has come although something should have [s]."""
        return 0.0

    @property
    def known(self) -> tuple[float, float]:
        """The oldest and the newest time [s]; the newest goes on while nothing comes."""
        kept = [trace.history for trace in self.traces if len(trace.history)]
        if not kept:
            return math.nan, math.nan
        return min(float(one.times[0]) for one in kept), max(one.newest for one in kept) + self.lateness

    @property
    def silent(self) -> bool:
        """Nothing has ever come."""
        return not math.isfinite(self.known[1])

    @property
    def values(self) -> list[float]:
        """Of each line: at the cursor, or the newest that is seen; NaN where it was told nothing."""
        if math.isfinite(self.cursor):
            return [trace.value_at(self.cursor) for trace in self.traces]
        if self.paused:
            return [trace.value_at(self.until) for trace in self.traces]
        return [trace.history.last for trace in self.traces]
