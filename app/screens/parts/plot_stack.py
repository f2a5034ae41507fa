"""Plots one below the other: fields of one unit share one, and all of them show the same stretch of time."""

from __future__ import annotations

import math
from typing import Any

from kivy.properties import BooleanProperty, NumericProperty
from kivy.uix.boxlayout import BoxLayout

from widgets import Plot
from widgets.plots.trace import MAX_TRACES, Trace

__all__ = ["MAX_PLOTS", "PlotStack"]

MAX_PLOTS = 4
"""More are too low to be read."""
SHARED = ("span", "until", "held", "cursor")
"""What all plots have alike."""


class PlotStack(BoxLayout):
    """Dispatches `on_pick(at)` when a finger chose a moment on any of them."""

    __events__ = ("on_pick",)

    epoch = NumericProperty(math.nan)
    """As of `Plot`."""
    pausable = BooleanProperty(True)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"orientation": "vertical", "spacing": "4dp", **kwargs})
        self.plots: list[Plot] = []
        self._units: dict[Plot, str] = {}
        self._sharing = False

    def on_pick(self, at: float) -> None:
        """A finger chose a moment, as of `TimeView`."""

    @property
    def traces(self) -> list[Trace]:
        """Every line."""
        return [trace for plot in self.plots for trace in plot.traces]

    def find(self, topic: str, path: str) -> Trace | None:
        """The line of a field; None where there is none."""
        return next((one for one in self.traces if (one.topic, one.path) == (topic, path)), None)

    def add(self, topic: str, path: str, unit: str = "") -> tuple[Plot, Trace] | None:
        """A line for a field, and the plot that it is in; None where there is no room for one more."""
        plot = next(
            (one for one in self.plots if self._units[one] == unit and len(one.traces) < MAX_TRACES), None
        )
        if plot is None and len(self.plots) < MAX_PLOTS:
            plot = self._make(unit)
        if plot is None:
            return None
        return plot, plot.trace(path, f"{topic} {path}", unit, topic)

    def remove(self, topic: str, path: str) -> None:
        """Take a line away, and its plot where that was the last; nothing where there is none."""
        trace = self.find(topic, path)
        if trace is None:
            return
        plot = next(one for one in self.plots if trace in one.traces)
        plot.remove(trace)
        if not plot.traces:
            self._drop(plot)

    def clear(self) -> None:
        """Take all away."""
        for plot in list(self.plots):
            self._drop(plot)

    def _make(self, unit: str) -> Plot:
        plot = Plot(epoch=self.epoch, pausable=self.pausable, state="live")
        if self.plots:
            for name in SHARED:
                setattr(plot, name, getattr(self.plots[0], name))
        for name in SHARED:
            plot.fbind(name, self._share, name)
        plot.bind(on_pick=lambda _, at: self.dispatch("on_pick", at))
        self.plots.append(plot)
        self._units[plot] = unit
        self.add_widget(plot)
        return plot

    def _drop(self, plot: Plot) -> None:
        self.plots.remove(plot)
        del self._units[plot]
        self.remove_widget(plot)

    def _share(self, name: str, plot: Plot, value: float) -> None:
        """One of them was moved: the others follow."""
        if self._sharing:
            return
        self._sharing = True
        for other in self.plots:
            if other is not plot:
                setattr(other, name, value)
        self._sharing = False

    def show(self, **view: float) -> None:
        """Have all of them show this: `span`, `until`, `cursor`."""
        for plot in self.plots[:1]:
            for name, value in view.items():
                setattr(plot, name, value)
