"""Where everything of a plot is: title, legend, scales and the frame of the lines; and their words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from kivy.metrics import dp, sp

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Ink, Word, Words, tint
from widgets.core.language import figure, language, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.labels import spaced
from widgets.plots.axes import clock_text, nice_step, tick_text, ticks, time_step
from widgets.plots.figures import Figure
from widgets.plots.plot_base import PlotBase
from widgets.plots.trace_ink import TraceInk

__all__ = ["Scales", "ago_text", "cursor_word", "lay_out", "legend_figures"]

MIN_SHARE = 0.45
"""Of the height that the lines have at least: the legend gives way."""
MINUS, DASH, DOTS = "−", "—", "…"

Box = tuple[float, float, float, float]


@dataclass
class Scales:
    """What the picture is drawn by."""

    frame: Box = (0.0, 0.0, 1.0, 1.0)
    """Of the lines: left, low, right, top [px]."""
    low: float = 0.0
    high: float = 1.0
    """Ends of the scale of values."""
    fitted: bool = False
    """They have been fitted to values."""
    type_size: float = 15.0
    """Of the legend's values [px]."""
    places: list[tuple[float, float]] = field(default_factory=list)
    """Right end and middle of each value in the legend [px]; those of lines that have no room in it are left out."""


def lay_out(plot: PlotBase, scales: Scales, grid: Ink, words: Words, keys: TraceInk) -> Box:
    """Lay everything out anew; returns the frame of the lines."""
    written: list[Word] = []
    marks: list[tuple[float, float, int, str]] = []
    scales.type_size = round(sp(15), 1)
    head = _head(plot, scales, written, marks)
    small = plot.height < dp(110)
    low = plot.y + (dp(8) if small else sp(12) + dp(14))
    top = max(plot.top - head, low + dp(10))
    step = nice_step(scales.high - scales.low, max(int((top - low) / sp(34)), 2))
    values = ticks(scales.low, scales.high, step)
    widest = max((_wide(tick_text(value, step)) for value in values), default=0.0)
    left = plot.x + dp(10) + math.ceil((widest + dp(6)) / dp(10)) * dp(10)
    frame = (round(left), round(low), round(plot.right - dp(14)), round(top))
    shapes = Shapes()
    tall = (frame[3] - frame[1]) / (scales.high - scales.low)
    for value in values:
        y = frame[1] + (value - scales.low) * tall
        _line(shapes, (frame[0], y), (frame[2], y), strong=value == 0)
        written.append(
            Word(tick_text(value, step), frame[0] - dp(6), y, sp(12), theme.muted, anchor=(1, 0.5))
        )
    if not small:
        written += _times(plot, frame, shapes)
    if plot.silent:
        text = tr("No message received yet.")
        middle = (frame[0] + frame[2]) / 2, (frame[1] + frame[3]) / 2
        written.append(Word(_cut(text, sp(14), frame[2] - frame[0]), *middle, sp(14), theme.muted))
    elif math.isfinite(plot.cursor) and frame[0] - 1 <= _x(plot, frame, plot.cursor) <= frame[2] + 1:
        written.append(cursor_word(plot, frame))
    grid.fill(shapes)
    words.write(written)
    _draw_keys(plot, keys, marks)
    return frame


def _line(shapes: Shapes, start: tuple[float, float], end: tuple[float, float], *, strong: bool) -> None:
    colour = theme.line if strong else tint(theme.line, 0.55)
    shapes.segments(np.array([start]), np.array([end]), theme.outline * (1.4 if strong else 1), colour)


def _wide(text: str, size: float = 0.0, *, bold: bool = False) -> float:
    return float(text_texture(text, round(size or sp(12), 1), theme.font, bold=bold).width) if text else 0.0


def _cut(text: str, size: float, room: float) -> str:
    """`text`, or as much of its end as fits: the end of a path says most."""
    if _wide(text, size) <= room:
        return text
    for start in range(1, len(text)):
        if _wide(DOTS + text[start:], size) <= room:
            return DOTS + text[start:]
    return ""


def _head(
    plot: PlotBase, scales: Scales, written: list[Word], marks: list[tuple[float, float, int, str]]
) -> float:
    """Title and legend from the upper edge; returns their height [px]."""
    button = plot.button.parent is not None
    left = plot.x + dp(14)
    room = plot.right - left - (plot.button.width if button else dp(14))
    y = plot.top - dp(10)
    if plot.title:
        size = theme.size_label
        text = spaced(plot.title)
        while text and _wide(text, size) > room:
            text = text[:-1].rstrip()
        written.append(Word(text, left, y, size, theme.muted, anchor=(0, 1)))
        y -= size + dp(9)
    line = scales.type_size + dp(9)
    cell = min(max((_cell(plot, scales, number) for number in range(len(plot.traces))), default=room), room)
    columns = max(int(room / max(cell, 1.0)), 1)
    rows = math.ceil(len(plot.traces) / columns)
    most = max(int((plot.height * (1 - MIN_SHARE) - (plot.top - y)) / line), 1)
    scales.places = []
    for number in range(min(len(plot.traces), min(rows, most) * columns)):
        x, middle = left + number % columns * cell, y - (number // columns + 0.5) * line
        _entry(plot, scales, number, (x, middle, cell - dp(18)), written, marks)
    over = len(plot.traces) - len(scales.places)
    if over:
        written.append(
            Word(f"+{over}", plot.right - dp(6), y - line / 2, sp(13), theme.muted, anchor=(1, 0.5))
        )
    used = plot.top - y + min(rows, most) * line + dp(8)
    return max(used, plot.button.height + dp(2) if button else 0.0)


def _value_width(scales: Scales) -> float:
    """Room for the longest value of the scale [px]."""
    texts = (value_text(scales, value) for value in (scales.low, scales.high))
    return max(_wide(text, scales.type_size, bold=True) for text in texts) + scales.type_size * 0.7


def _cell(plot: PlotBase, scales: Scales, number: int) -> float:
    """Width that an entry of the legend would have [px]."""
    trace = plot.traces[number]
    unit = _wide(trace.unit, sp(13)) + dp(5) if trace.unit else 0.0
    return dp(18) + _wide(trace.name, sp(14)) + dp(8) + _value_width(scales) + unit + dp(18)


def _entry(
    plot: PlotBase,
    scales: Scales,
    number: int,
    place: tuple[float, float, float],
    written: list[Word],
    marks: list[tuple[float, float, int, str]],
) -> None:
    """Mark, name, room for the value, unit."""
    trace, (x, y, wide) = plot.traces[number], place
    unit = _wide(trace.unit, sp(13)) + dp(5) if trace.unit else 0.0
    value = _value_width(scales)
    marks.append((x + dp(5), y, trace.mark if len(plot.traces) > 1 else 1, trace.role))
    name = _cut(trace.name, sp(14), wide - dp(18) - dp(8) - value - unit)
    written.append(Word(name, x + dp(16), y, sp(14), theme.muted, anchor=(0, 0.5)))
    end = x + dp(16) + _wide(name, sp(14)) + dp(8) + value
    scales.places.append((end, y))
    if trace.unit:
        written.append(Word(trace.unit, end + dp(5), y - dp(0.5), sp(13), theme.muted, anchor=(0, 0.5)))


def _draw_keys(plot: PlotBase, keys: TraceInk, marks: list[tuple[float, float, int, str]]) -> None:
    keys.layers(len(marks))
    keys.widths(dp(1.5), dp(5.5))
    keys.place((plot.x, plot.y, plot.right, plot.top), (1.0, 1.0), (0.0, 0.0))
    for layer, (x, y, kind, role) in enumerate(marks):
        keys.paint(layer, theme.roles[role])
        keys.draw_marks(layer, [(x, y, kind)])


# time


def _x(plot: PlotBase, frame: Box, time: float) -> float:
    return frame[2] - (plot.seen[1] - time) * (frame[2] - frame[0]) / plot.span


def _times(plot: PlotBase, frame: Box, shapes: Shapes) -> list[Word]:
    """Lines and words of the scale of time."""
    right = plot.seen[1] if math.isfinite(plot.seen[1]) else 0.0
    zero, wide = _zero(plot, right), frame[2] - frame[0]
    step = time_step(plot.span, max(int(wide / sp(84)), 1))
    made, end = [], -math.inf
    for time in ticks(right - plot.span - zero, right - zero, step):
        x = frame[2] - (right - zero - time) * wide / plot.span
        _line(shapes, (x, frame[1]), (x, frame[3]), strong=False)
        text = time_text(plot, time + zero, zero, step)
        half = _wide(text) / 2
        place = min(max(x, frame[0] + half - dp(4)), plot.right - dp(6) - half)
        if place - half > end + dp(4):
            made.append(Word(text, place, frame[1] - dp(5), sp(12), theme.muted, anchor=(0.5, 1)))
            end = place + half
    return made


def _zero(plot: PlotBase, right: float) -> float:
    """The time that others are counted from [s]: the newest, or midnight of a recording."""
    if math.isfinite(plot.epoch):
        return -float(plot.epoch)
    return plot.held if plot.paused and math.isfinite(plot.held) else right


def ago_text(ago: float, step: float) -> str:
    """How long before now [s], as in `−10 s` or `−2:30`; `now` for nothing."""
    if abs(ago) < step * 1e-6:
        return tr("now")
    sign, whole = (MINUS if ago < 0 else "+"), abs(ago)
    if whole < 60 or step < 1:
        return f"{sign}{tick_text(whole, min(step, 1.0) if step < 1 else 1.0)} s"
    minutes, seconds = divmod(round(whole), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{sign}{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{sign}{minutes}:{seconds:02d}"


def time_text(plot: PlotBase, time: float, zero: float, step: float) -> str:
    """A time [s] as the scale says it."""
    if math.isfinite(plot.epoch):
        return clock_text(time + plot.epoch, step)
    return ago_text(time - zero, step)


def cursor_word(plot: PlotBase, frame: Box | None = None) -> Word:
    """When the cursor stands, at its upper end."""
    left, low, right, top = frame or plot.frame
    step = nice_step(plot.span, 300)
    text = time_text(plot, plot.cursor, _zero(plot, plot.seen[1]), min(step, 1.0))
    half = _wide(text, sp(13)) / 2 + dp(4)
    x = min(max(_x(plot, (left, low, right, top), plot.cursor), left + half), right - half)
    return Word(text, x, top - sp(9), round(sp(13), 1), theme.text)


# values


def value_text(scales: Scales, value: float) -> str:
    """A value of the legend: as many decimals as tell two apart on this scale; a dash for NaN."""
    size = scales.high - scales.low
    if math.isfinite(value) and value and not 1e-4 <= abs(value) < 1e7:
        return f"{value:.2e}".replace("-", MINUS).replace(".", language.tongue.point)
    decimals = 3 - math.ceil(math.log10(size)) if size > 0 else 2
    return figure(value, min(max(decimals, 0), 6))


def legend_figures(plot: PlotBase, scales: Scales) -> Iterator[Figure]:
    """The values in the legend."""
    known = not plot.silent
    for place, value in zip(scales.places, plot.values, strict=False):
        right, y = place
        yield Figure(value_text(scales, value) if known else DASH, right, y, "text" if known else "muted")
