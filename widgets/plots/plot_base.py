"""What a plot is made of: its lines, their words, and the stretch of time that is seen of them."""

from __future__ import annotations

import math
from typing import Any

from kivy.properties import ListProperty, NumericProperty, StringProperty

from widgets.core.language import tr
from widgets.parts.buttons import IconButton
from widgets.plots.history import MAX_SAMPLES
from widgets.plots.time_view import TimeView
from widgets.plots.trace import MAX_TRACES, Trace

__all__ = ["PlotBase"]


class PlotBase(TimeView):
    """Lines over a stretch of time. It says what there is to be drawn, and draws nothing."""

    title = StringProperty("")
    unit = StringProperty("")
    """Of the values, where all have the same."""
    epoch = NumericProperty(math.nan)
    """What is added to times to give the time of day [s since 1970], for a recording; NaN shows how long ago."""
    paths: ListProperty[str] = ListProperty()
    """Fields of the messages that `show` takes, as in `twist.twist.linear.x` or `ranges[3]`; at most eight."""
    names: ListProperty[str] = ListProperty()
    """What the legend calls them; a path where there is none."""
    capacity = NumericProperty(MAX_SAMPLES)
    """Samples kept of each field."""

    def __init__(self, **kwargs: Any) -> None:
        self.traces: list[Trace] = []
        """The lines, in the order of the legend. Made by `paths` or `trace`."""
        self.button = IconButton(icon="pause", bare=True, role="muted")
        """Holds the picture still, and lets it go on."""
        super().__init__(**kwargs)
        for name in ("paths", "names"):
            self.fbind(name, self._make_traces)

    def refresh(self) -> None:
        """Draw everything anew: the lines, their names or their histories are others."""
        raise NotImplementedError

    def _on_sample(self, trace: Trace, time: float, value: float) -> None:
        """A line was told something."""
        raise NotImplementedError

    def _make_traces(self, *_: object) -> None:
        if not self.paths:
            return
        if len(self.paths) > MAX_TRACES:
            raise ValueError(
                tr("A plot has at most {max_traces} fields, not {paths}.").format(
                    max_traces=MAX_TRACES, paths=len(self.paths)
                )
            )
        self.clear()
        for path, name in zip(
            self.paths, [*self.names, *[""] * (len(self.paths) - len(self.names))], strict=False
        ):
            self.trace(path, name)

    def trace(self, path: str, name: str = "", unit: str = "", topic: str = "", scale: float = 1.0) -> Trace:
        """Add a line for a field of any topic, and give it: its own `show` takes the messages. ValueError for a ninth."""
        if len(self.traces) >= MAX_TRACES:
            raise ValueError(tr("A plot has at most {max_traces} fields.").format(max_traces=MAX_TRACES))
        made = Trace(
            path,
            name,
            unit or self.unit,
            topic,
            scale=scale,
            most=int(self.capacity),
            changed=self._on_sample,
        )
        self.traces.append(made)
        self._renumber()
        return made

    def remove(self, trace: Trace) -> None:
        """Take a line away; ValueError for one of another plot."""
        self.traces.remove(trace)
        self._renumber()

    def clear(self) -> None:
        """Take all lines away, with what they were told."""
        self.traces = []
        self._renumber()

    def _renumber(self) -> None:
        for number, trace in enumerate(self.traces):
            trace.number = number
        self.refresh()

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
        return min([one.oldest for one in kept]), max([one.newest for one in kept]) + self.lateness

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
