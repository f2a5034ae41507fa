"""Bars one below the other, each with an icon, a name, its spread and a figure: the base of charts of methods.

class HeightChart(BarRows):
    def rows(self): return [Group("stairs", [Bar("person", "Ada", 1.2, 0.9, 1.4, "1.2 m")])]
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import NumericProperty, StringProperty

from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.icons import icon
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["Bar", "BarRows", "Group", "nice_step"]

ROW, HEAD, FOOT, TITLE = 30, 26, 24, 24
"""Heights of a row, of a group's name, of the scale below and of the title above [dp]."""
MAX_ROWS_WITHOUT_HEAD = 6
"""More rows than these have the scale above them as well, as one end of a chart may be off a phone's glass."""
STEPS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
MAX_STEPS = 5
MIN_WIDTH_WITH_NAMES = 330
"""Narrower ones have the icons alone [dp]."""


@dataclass(frozen=True, slots=True)
class Bar:
    """One bar."""

    icon: str
    """As in `widgets.core.icons`."""
    name: str
    value: float
    """Where it ends, in the unit of the scale; NaN draws none."""
    low: float
    high: float
    """Ends of the spread; NaN for none."""
    figure: str
    """What is written at its right end."""
    mark: float = math.nan
    """Where something to compare with is; NaN for nothing."""


@dataclass(frozen=True, slots=True)
class Group:
    """Bars that belong together, under one name; an empty name takes no room."""

    name: str
    bars: Sequence[Bar]


def nice_step(full: float) -> float:
    """Between two lines of a scale that goes to `full`: of at most five, at round figures."""
    return next((step for step in STEPS if full / step <= MAX_STEPS), STEPS[-1])


class BarRows(Gauge):
    """As high as all its rows are together; narrow or wide, each has its own line."""

    drawn_from: ClassVar[tuple[str, ...]] = ("nothing", "compared")

    legends: ClassVar[tuple[str, ...]] = ()
    """What the figures are, the longest first, where there are no marks."""

    nothing = StringProperty("Nothing yet")
    """What to say while there are no bars."""
    compared = StringProperty("")
    """What the marks are, as in `in the paper`; empty for no legend."""
    wanted = NumericProperty(0.0)
    """Height that all rows need [px]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"size_hint_y": None, **kwargs})
        self.fit()

    def groups(self) -> list[Group]:
        """What is drawn, from above."""
        raise NotImplementedError(f"{type(self).__name__} does not say what its bars are")

    def scale(self) -> tuple[float, float]:
        """Value at the right end, and the step between two lines."""
        raise NotImplementedError(f"{type(self).__name__} does not say how far its bars go")

    def tick(self, value: float) -> str:
        """What is written at a line of the scale."""
        raise NotImplementedError(f"{type(self).__name__} does not say what its scale says")

    def fit(self, *_: object) -> None:
        """Be as high as the rows need."""
        groups = self.groups()
        rows = sum(len(group.bars) for group in groups)
        heads = sum(bool(group.name) for group in groups)
        scales = FOOT * (2 if rows > MAX_ROWS_WITHOUT_HEAD else 1)
        inner = rows * dp(ROW) + heads * dp(HEAD) + dp(scales if rows else 44)
        self.wanted = self.height = 2 * dp(12) + dp(TITLE) + inner
        self.redraw()

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Title, scale, and a row for each bar."""
        groups = self.groups()
        yield from self.header(self._legends(shapes, groups), "muted", told=False)
        bars = [bar for group in groups for bar in group.bars]
        top = self.top - self.edge - dp(TITLE)
        if not bars:
            size = sp(14)
            said = first_fitting((self.nothing, "Nothing yet"), size, self.width - 2 * self.edge)
            yield Word(said, self.center_x, (self.y + top) / 2, size, theme.muted)
            return
        span = self._span(bars)
        twice = len(bars) > MAX_ROWS_WITHOUT_HEAD
        top -= dp(FOOT) if twice else 0
        yield from self._lines(shapes, span, top, twice=twice)
        for group in groups:
            if group.name:
                yield self._heading(shapes, group.name, top - dp(HEAD) * 0.55)
                top -= dp(HEAD)
            for bar in group.bars:
                yield from self._row(shapes, bar, span, top - dp(ROW) / 2)
                top -= dp(ROW)

    def _heading(self, shapes: Shapes, name: str, y: float) -> Word:
        """The name of a group, which the lines of the scale do not cross."""
        word = Word(name, self.x + self.edge, y, sp(14.5), theme.text, bold=True, anchor=(0, 0.5))
        ground(shapes, word, theme.surface)
        return word

    def _legends(self, shapes: Shapes, groups: Sequence[Group]) -> Sequence[str]:
        """What the marks are, where there are any; a mark is drawn before the words where they fit."""
        marked = any(math.isfinite(bar.mark) for group in groups for bar in group.bars)
        if not (marked and self.compared):
            return self.legends if groups else ()
        signed = dp(22) if self.alarmed else 0
        room = self.width - 2 * self.edge - wide(self.title.upper(), sp(11.5)) - dp(26) - signed
        said = first_fitting((self.compared,), sp(13), room, bold=True)
        if said:
            x = self.right - self.edge - signed - wide(said, sp(13), bold=True) - dp(10)
            self._mark(shapes, x, self.top - self.edge - sp(6), dp(7))
        return (said,)

    def _span(self, bars: Sequence[Bar]) -> tuple[float, float]:
        """Left and right end of the bars [px]: between the names and the figures."""
        named = max(wide(bar.name, sp(14)) for bar in bars) + dp(10) if self._names else 0.0
        figures = max(wide(bar.figure, sp(14), bold=True) for bar in bars)
        return self.x + self.edge + dp(30) + named, self.right - self.edge - figures - dp(12)

    @property
    def _names(self) -> bool:
        return bool(self.width >= dp(MIN_WIDTH_WITH_NAMES))

    def _lines(self, shapes: Shapes, span: tuple[float, float], top: float, *, twice: bool) -> Iterator[Word]:
        (left, right), (full, step) = span, self.scale()
        low = self.y + self.edge + dp(FOOT)
        every = 1 if (right - left) / max(full / step, 1) >= dp(46) else 2
        for number in range(int(full / step + 1e-6) + 1):
            x = left + (right - left) * number * step / full
            shapes.segments(np.array([[x, low]]), np.array([[x, top]]), dp(1), tint(theme.muted, 0.45))
            if number % every == 0:
                for y in (low - dp(10), top + dp(9)) if twice else (low - dp(10),):
                    yield Word(self.tick(number * step), x, y, sp(12), theme.muted)

    def _row(self, shapes: Shapes, bar: Bar, span: tuple[float, float], y: float) -> Iterator[Word]:
        left, right = span
        full, _ = self.scale()
        yield Word(icon(bar.icon), self.x + self.edge, y, sp(20), theme.text, font="Icons", anchor=(0, 0.5))
        if self._names:
            yield Word(bar.name, self.x + self.edge + dp(30), y, sp(14), theme.text, anchor=(0, 0.5))
        yield Word(bar.figure, self.right - self.edge, y, sp(14), theme.text, bold=True, anchor=(1, 0.5))

        def at(value: float) -> float:
            return left + (right - left) * max(0.0, min(value / full, 1.0))

        if math.isfinite(bar.value):
            shapes.segments(
                np.array([[left, y]]), np.array([[max(at(bar.value), left + dp(2)), y]]), dp(14), theme.accent
            )
        if math.isfinite(bar.low) and math.isfinite(bar.high):
            self._whisker(shapes, at(bar.low), at(bar.high), y)
        if math.isfinite(bar.mark):
            self._mark(shapes, at(bar.mark), y, dp(11))

    def _whisker(self, shapes: Shapes, low: float, high: float, y: float) -> None:
        """A line with ends, dark within light or light within dark, so that it is seen on the bar and beside it."""
        for width, grown, colour in ((dp(5), dp(1.5), theme.surface), (dp(2), 0.0, theme.text)):
            shapes.segments(np.array([[low - grown, y]]), np.array([[high + grown, y]]), width, colour)
            for x in (low, high):
                ends = np.array([[x, y - dp(5) - grown]]), np.array([[x, y + dp(5) + grown]])
                shapes.segments(*ends, width, colour)

    def _mark(self, shapes: Shapes, x: float, y: float, reach: float) -> None:
        """A diamond with a hole: a shape that no bar and no whisker has."""
        for grown, colour in ((dp(2), theme.surface), (0.0, theme.plan), (-dp(3), theme.surface)):
            half = reach * 0.7 + grown
            shapes.polygon([(x, y - half), (x + half, y), (x, y + half), (x - half, y)], colour)
