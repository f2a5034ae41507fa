"""Cells of a line sensor as bright as the ground under them, and the offset of the line.

line = LineSensorView(title="Line")
robot.on("/line_sensor", line.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float32Array
from bridge.msgs.pilothouse_msgs import LineSensor
from widgets.core.canvas_ink import Word
from widgets.core.geometry import DASH, tween
from widgets.core.language import figure, tr
from widgets.core.sensor_geometry import MIN_CONTRAST, contrast_of, line_offset
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_marks import arrow
from widgets.parts.sensor_card import Gauge, first_fitting

__all__ = ["LineSensorView", "samples"]

CENTRED = 0.5
"""A line within this part of a cell's spacing from the middle is under the middle."""
RESOLUTION = 0.05
"""Difference of brightness that is seen: the cells are not drawn anew for their noise."""
DARK, BRIGHT = 0.05, 0.95
"""Share of white that the darkest and the brightest cell are drawn with."""


class LineSensorView(Gauge):
    """A row of cells, the leftmost on the left."""

    accepts: ClassVar = (LineSensor,)
    grid_size: ClassVar = (4, 2)
    drawn_from: ClassVar = ("values", "spacing")

    values: ListProperty[float] = ListProperty()
    """Of the cells from left to right, 0 dark to 1 bright; NaN for one without a value. Empty before the first."""
    spacing = NumericProperty(math.nan)
    """Between neighbouring cells [m]; NaN when not known."""

    def _offset(self) -> float:
        return line_offset(self.values, self.spacing if math.isfinite(self.spacing) else 1.0)

    offset = AliasProperty(_offset, bind=["values", "spacing"], cache=True)
    """Where the line is from the middle, positive to the left [m, or cells without a spacing]; NaN without a line."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Line"), **kwargs})

    def show(self, msg: LineSensor) -> None:
        """Show the newest reading."""
        self.spacing = msg.spacing
        fresh = [value if math.isfinite(value) else math.nan for value in msg.values]
        if len(fresh) != len(self.values) or any(map(_differ, fresh, self.values)):
            self.values = fresh

    def words(self) -> tuple[str, ...]:
        """Where the line is, longest first."""
        contrast = contrast_of(self.values)
        if math.isnan(contrast):
            return (DASH,)
        if contrast < MIN_CONTRAST:
            bright = sum(value for value in self.values if value >= 0) > len(self.values) / 2
            return (tr("all bright"), tr("bright")) if bright else (tr("no line"), tr("none", context="line"))
        metric = math.isfinite(self.spacing)
        if abs(self.offset) < CENTRED * (self.spacing if metric else 1.0):
            return (tr("in the middle"), tr("middle"))
        side = tr("left") if self.offset > 0 else tr("right")
        away = (
            f"{abs(self.offset) * 1000:.0f} mm"
            if metric
            else tr("{count} cells").format(count=figure(abs(self.offset), 1))
        )
        return (f"{away} {side}", f"{away} {side[0].upper()}", side)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The cells and a pointer over where the line is."""
        edge, low = self.edge, self.low
        role = "text" if math.isfinite(self.offset) else "muted"
        if low:
            text = first_fitting(self.words(), sp(12), self.width - 2 * edge, bold=True)
            y = self.y + edge + sp(7)
            yield Word(text, self.center_x, y, sp(12), theme.roles[role], bold=True)
            bottom, top = y + sp(9), self.top - edge - dp(8)
        else:
            yield from self.header(self.words(), role)
            bottom = self.y + edge
            top = min(self.top - edge - sp(12) - dp(12), bottom + dp(46))
        if self.values and top > bottom:
            self._cells(shapes, bottom, top)

    def _cells(self, shapes: Shapes, bottom: float, top: float) -> None:
        left, room = self.x + self.edge, self.width - 2 * self.edge
        pitch = room / len(self.values)
        gap = min(dp(3), pitch / 5)
        for number, value in enumerate(self.values):
            x = left + (number + 0.5) * pitch
            self._cell(shapes, x, (bottom, top), pitch - gap, value)
        if math.isfinite(self.offset):
            cells = self.offset / (self.spacing if math.isfinite(self.spacing) else 1.0)
            x = left + room / 2 - cells * pitch
            shapes.polygon(arrow(x, top + dp(5), -math.pi / 2, dp(9)), theme.accent)

    def _cell(self, shapes: Shapes, x: float, rows: tuple[float, float], width: float, value: float) -> None:
        bottom, top = rows
        rim = theme.muted if math.isfinite(value) else theme.faint
        shapes.segments(np.array([[x, bottom]]), np.array([[x, top]]), width, rim)
        inner = dp(1)
        known = math.isfinite(value)
        share = DARK + (BRIGHT - DARK) * min(max(value, 0.0), 1.0) if known else 0.0
        fill = tween(theme.shade, theme.knob, share) if known else theme.surface
        ends = np.array([[x, bottom + inner]]), np.array([[x, top - inner]])
        shapes.segments(*ends, width - 2 * inner, fill)
        if not known:
            half = min(width, top - bottom) / 4
            y = (bottom + top) / 2
            for rise in (-half, half):
                shapes.segments(
                    np.array([[x - half, y - rise]]), np.array([[x + half, y + rise]]), dp(1.5), theme.muted
                )


def _differ(one: float, other: float) -> bool:
    """Whether two readings of a cell look different; both NaN do not."""
    return abs(one - other) > RESOLUTION or math.isnan(one) != math.isnan(other)


def _message(*values: float, spacing: float = 0.02) -> LineSensor:
    return LineSensor(values=Float32Array(values), spacing=spacing)


_LEFT = _message(0.13, 0.55, 0.82, 0.79, 0.31, 0.12, 0.11, 0.14)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""

    def made(
        msg: LineSensor | None = None, size: tuple[float, float] = (170, 84), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> LineSensorView:
            view = LineSensorView(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if msg:
                view.show(msg)
            return view

        return build

    return {
        "never": made(),
        "live": made(_LEFT, state="live"),
        "middle": made(_message(0.1, 0.1, 0.2, 0.8, 0.8, 0.2, 0.1, 0.1), state="live"),
        "no line": made(_message(*[0.13] * 8), state="live"),
        "dark line": made(_message(0.8, 0.8, 0.8, 0.8, 0.7, 0.1, 0.15, 0.8), state="live"),
        "dead cell": made(_message(0.13, math.nan, 0.82, 0.79, 0.31, 0.12, 0.11, 0.14), state="live"),
        "low": made(_LEFT, state="live", size=(120, 54)),
        "narrow": made(_LEFT, state="live", size=(72, 54), card=False),
        "stale": made(_LEFT, state="stale", age=2.0),
        "alarm": made(_LEFT, state="alarm"),
        "disabled": made(_LEFT, state="disabled"),
    }
