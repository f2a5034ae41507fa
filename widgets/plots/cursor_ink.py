"""The cursor of a plot: an upright line with the time, and a dot on each of the plot's lines."""

from __future__ import annotations

import math

import numpy as np
from kivy.graphics import InstructionGroup
from kivy.metrics import dp

from widgets.core.canvas_ink import Ink, ground
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.plots.plot_base import PlotBase
from widgets.plots.plot_layout import Scales, cursor_word

__all__ = ["CursorInk"]


class CursorInk:
    """Draws the cursor above the lines; `canvas` is empty while there is none in sight, as ink that draws nothing costs as much."""

    def __init__(self) -> None:
        self.canvas = InstructionGroup()
        self._ink = Ink()
        self._shown = False

    def draw(self, plot: PlotBase, scales: Scales) -> bool:
        """Draw it where `plot.cursor` is now; False where nothing was there and nothing is."""
        left, _, right, _ = scales.frame
        x = plot.x_of(plot.cursor) if math.isfinite(plot.cursor) else math.nan
        shown = left - 1 <= x <= right + 1
        if not shown and not self._shown:
            return False
        if shown != self._shown:
            self._shown = shown
            (self.canvas.add if shown else self.canvas.remove)(self._ink)
            self._ink.see(plot.opacity)
        self._ink.fill(_shapes(plot, scales, x) if shown else Shapes())
        return True


def _shapes(plot: PlotBase, scales: Scales, x: float) -> Shapes:
    """The cursor at `x` [px]."""
    _, low, _, top = scales.frame
    shapes = Shapes()
    shapes.line(np.array([[x, low], [x, top]]), dp(1.5), theme.text)
    for trace in plot.traces:
        value = trace.value_at(plot.cursor)
        if math.isfinite(value):
            y = low + (value - scales.low) / (scales.high - scales.low) * (top - low)
            if low <= y <= top:
                shapes.disc(x, y, dp(5.5), theme.surface)
                shapes.disc(x, y, dp(4), theme.roles[trace.role])
    ground(shapes, cursor_word(plot), theme.raised)
    return shapes
