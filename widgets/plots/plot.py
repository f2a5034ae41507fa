"""Plot of numbers over time: several fields in one picture, with pause, zoom and a cursor.

plot = Plot(title="Speed", paths=["twist.twist.linear.x", "twist.twist.angular.z"])
robot.on("/odom", plot.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.metrics import dp
from kivy.properties import BooleanProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs import Msg
from widgets.core.canvas_ink import Drawing, Ink, Words
from widgets.core.theme import theme
from widgets.plots.axes import nice_range
from widgets.plots.cursor_ink import CursorInk
from widgets.plots.figures import Figures
from widgets.plots.history import Floats
from widgets.plots.plot_base import PlotBase
from widgets.plots.plot_layout import Scales, lay_out, legend_figures
from widgets.plots.plot_samples import SELDOM, TIMES, motion, voltage, wave
from widgets.plots.trace import MAX_TRACES, Trace
from widgets.plots.trace_ink import TraceInk

__all__ = ["Plot", "samples"]

LEGEND_PERIOD = 0.2
"""Between two writings of the newest values [s]: figures that change faster cannot be read."""
SHRINK = 0.45
"""The scale is made smaller when what is seen fills less of it than this: else it would pump."""
LONG_WAY = 16
"""Times are counted from a new origin after so many widths: the graphics card has 32 bits."""
FAR = 1000.0
"""Values are counted from a new base when the scale is so many of its heights away from it."""
LINE_WIDTH, MARK_SIZE = 1.0, 4.6
"""Half the width of a line and of a mark [dp]."""


class Plot(PlotBase, Drawing):
    """Up to eight fields over time. A line is broken where data is missing; spikes are never lost."""

    accepts: ClassVar = (Msg,)
    shows_fields: ClassVar = ("number",)
    over_time: ClassVar = True
    grid_size: ClassVar = (6, 4)
    drawn_from: ClassVar = ("title", "unit", "span", "until", "cursor", "age", "low", "high", "epoch")

    low = NumericProperty(math.nan)
    """Lower end of the scale; NaN follows what is seen."""
    high = NumericProperty(math.nan)
    """Upper end of the scale; NaN follows what is seen."""
    pausable = BooleanProperty(True)
    """Has a button that holds the picture still."""

    def __init__(self, **kwargs: Any) -> None:
        self._grid, self._ink, self._cursor = Ink(), TraceInk(), CursorInk()
        self._keys, self._words, self._figures = TraceInk(), Words(), Figures()
        self._scales = Scales()
        self._laid: object = None
        self._drawn_columns: tuple[float, ...] = ()
        self._origin = self._base = 0.0
        self._rescale = True
        self._written = -math.inf
        self._write_later = Clock.create_trigger(self._write_figures, LEGEND_PERIOD)
        super().__init__(**kwargs)
        self.button.bind(on_release=self._toggle)
        for part in (
            self._grid,
            self._ink,
            self._cursor.canvas,
            self._keys,
            self._words.canvas,
            self._figures.canvas,
        ):
            self.canvas.add(part)
        for name in ("until", "pausable"):
            self.fbind(name, self._show_button)
        self._make_traces()
        self._show_button()

    # what comes in

    def refresh(self) -> None:
        """Draw everything anew: the lines, their names or their histories are others."""
        self._laid, self._drawn_columns, self._rescale = None, (), True
        self.redraw()

    def show(self, msg: Any) -> None:
        """Take the fields at `paths` of a message as told now."""
        now = Clock.get_time()
        for trace in self.traces:
            if not trace.topic:
                trace.show(msg, now)

    def load(self, trace: Trace, times: Floats, values: Floats) -> None:
        """Give a line the samples of a recording; times [s] rise."""
        trace.load(times, values)
        self.refresh()

    def _on_sample(self, trace: Trace, time: float, value: float) -> None:
        if self.paused or not self._drawn_columns:
            if not self.paused:
                self.redraw()
            return
        if trace.columns.add(time, value) or not self._scales.low <= value <= self._scales.high:
            self._rescale = True
        self.redraw()

    # time

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """Where the lines are: left, low, right, top [px]."""
        return self._scales.frame

    @property
    def lateness(self) -> float:
        """Its age, where it is stale."""
        return float(self.age) if self.state == "stale" and math.isfinite(self.age) else 0.0

    def _toggle(self, *_: object) -> None:
        if self.paused:
            self.resume()
        else:
            self.pause()

    def _show_button(self, *_: object) -> None:
        self.button.icon, self.button.role = ("play_arrow", "accent") if self.paused else ("pause", "muted")
        self._laid = None
        self.redraw()

    # the picture

    def _on_theme(self, *args: object) -> None:
        self._laid = None
        super()._on_theme(*args)

    def draw(self) -> None:
        """Bring the lines up to date, and all the rest where that has changed."""
        self._update_columns()
        self._update_scale()
        laid = (
            *self.pos,
            *self.size,
            self.title,
            self.unit,
            self.span,
            self.until if self.paused else math.inf,
            self._scales.low,
            self._scales.high,
            self.silent,
            self.epoch if math.isfinite(self.epoch) else None,
            self.state,
            self.cursor if math.isfinite(self.cursor) else None,
        )
        if laid != self._laid:
            self._laid = laid
            self._lay()
        self._place_lines()
        if self._cursor.draw(self, self._scales):
            self._written = -math.inf
        self._write_soon()

    def _lay(self) -> None:
        """Scales, words and legend: what changes seldom."""
        was = self.frame
        self._place_button()
        self._scales.frame = lay_out(self, self._scales, self._grid, self._words, self._keys)
        if self.frame != was:
            self._drawn_columns = ()
            self._update_columns()
        self._written = -math.inf

    def _place_button(self) -> None:
        wanted = self.pausable and self.height >= 2.4 * theme.target and self.width >= 3 * theme.target
        if wanted and self.button.parent is None:
            self.add_widget(self.button)
        elif not wanted and self.button.parent is not None:
            self.remove_widget(self.button)
        aside = self.button.width + (dp(22) if self.alarmed else 0)  # beside the sign of an alarm
        self.button.pos = self.right - aside, self.top - self.button.height

    def _update_columns(self) -> None:
        """Draw the lines anew where the view is another; else each sample has drawn itself."""
        left, right = self.seen
        if not math.isfinite(right):
            return
        wide = 1.0 / self.pace
        view: tuple[float, ...] = (
            self.span,
            self.until if self.paused else 0.0,
            *self.frame,
            len(self.traces),
        )
        far = (right - self._origin) / wide > LONG_WAY * max(self.width, 1.0)
        if view == self._drawn_columns and not far:
            return
        self._drawn_columns = view
        self._origin = math.floor((left - 2 * wide) / wide) * wide
        self._rebuild(left, right, wide)
        self._rescale = True

    def _rebuild(self, left: float, right: float, wide: float) -> None:
        every = self.span * dp(110) / max(self.frame[2] - self.frame[0], 1.0)
        for trace in self.traces:
            columns = trace.columns
            columns.resize(math.ceil(self.frame[2] - self.frame[0]) + 1)
            columns.gap = trace.widest_gap
            several = len(self.traces) > 1
            columns.mark(trace.mark if several else 0, every, every * trace.number / MAX_TRACES)
            columns.rebuild(trace.history, left, right, origin=self._origin, base=self._base, wide=wide)

    def _update_scale(self) -> None:
        """Fit the values that are seen, at once where one is beyond, later where there is too much room."""
        if not self._rescale or not self._drawn_columns:
            return
        self._rescale = False
        extents = [trace.columns.extent(*self.seen) for trace in self.traces]
        low, high = (
            min((one[0] for one in extents), default=math.inf),
            max((one[1] for one in extents), default=-math.inf),
        )
        if not low <= high:
            return
        was_low, was_high = self._scales.low, self._scales.high
        fits = was_low <= low and high <= was_high
        if not fits or high - low < SHRINK * (was_high - was_low) or not self._scales.fitted:
            self._scales.low, self._scales.high = nice_range(low, high)
            self._scales.fitted = True
        if math.isfinite(self.low):
            self._scales.low = float(self.low)
        if math.isfinite(self.high):
            self._scales.high = max(float(self.high), self._scales.low + 1e-12)
        size = self._scales.high - self._scales.low
        if abs(self._scales.low - self._base) > FAR * size:
            self._base = self._scales.low
            left, right = self.seen
            self._rebuild(left, right, 1.0 / self.pace)

    def _place_lines(self) -> None:
        _, low, right, top = self.frame
        self._ink.layers(len(self.traces))
        if not self._drawn_columns:
            return
        tall = (top - low) / (self._scales.high - self._scales.low)
        self._ink.widths(dp(LINE_WIDTH), dp(MARK_SIZE))
        self._ink.place(
            self.frame,
            (self.pace, tall),
            (right - (self.seen[1] - self._origin) * self.pace, low + (self._base - self._scales.low) * tall),
        )
        for layer, trace in enumerate(self.traces):
            self._ink.paint(layer, theme.roles[trace.role])
            self._ink.draw_columns(layer, trace.columns)

    # the legend's values

    def _write_soon(self) -> None:
        if Clock.get_time() - self._written >= LEGEND_PERIOD:
            self._write_figures()
        elif not self._write_later.is_triggered:
            self._write_later()

    def _write_figures(self, *_: object) -> None:
        self._written = Clock.get_time()
        self._figures.write(legend_figures(self, self._scales), self._scales.type_size)


def _sample(size: tuple[float, float] = (520, 300), **kwargs: Any) -> Plot:
    return Plot(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **{"state": "live", **kwargs})


def _motion(size: tuple[float, float] = (520, 300), **kwargs: Any) -> Plot:
    made = _sample(size, title="Motion", **kwargs)
    for name, unit, values in motion():
        line = made.trace(name, unit=unit)
        if made.state != "never":
            made.load(line, TIMES, values)
    return made


def _many() -> Plot:
    made = _sample((700, 360), title="Eight joints")
    for number in range(MAX_TRACES):
        made.load(made.trace(f"position[{number}]", unit="rad"), TIMES, wave(number))
    return made


def _single() -> Plot:
    made = _sample((360, 200), title="Battery", low=20.0, high=26.0)
    made.load(made.trace("voltage", unit="V"), TIMES, voltage())
    return made


def _seldom() -> Plot:
    made = _sample((360, 180))
    made.trace("level").gap = 10.0
    made.load(made.traces[0], *SELDOM)
    return made


def samples() -> dict[str, Callable[[], Widget]]:
    """Every state; held still with a cursor, from a recording, many lines and one, small."""
    return {
        "never": lambda: _motion(state="never"),
        "live": _motion,
        "stale": lambda: _motion(state="stale", age=4.0),
        "alarm": lambda: _motion(state="alarm"),
        "disabled": lambda: _motion(state="disabled"),
        "held": lambda: _motion(until=34.0, span=12.0, held=40.0, cursor=27.3),
        "recorded": lambda: _motion((700, 320), epoch=1763719271.0, until=36.0, cursor=28.0),
        "many": _many,
        "single": _single,
        "seldom": _seldom,
        "small": lambda: _motion((260, 100)),
    }
