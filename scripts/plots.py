"""Line plots drawn with Pillow alone: axes with round ticks, lines, dots, a legend; as large as they are printed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

__all__ = ["BLUE", "GREEN", "GREY", "ORANGE", "PURPLE", "RED", "Plot", "Series", "page"]

Colour = tuple[int, int, int]
BLUE: Colour = (38, 99, 176)
ORANGE: Colour = (214, 96, 24)
GREEN: Colour = (40, 130, 74)
PURPLE: Colour = (122, 74, 160)
RED: Colour = (176, 38, 58)
GREY: Colour = (120, 124, 130)
INK: Colour = (34, 37, 42)
PALE: Colour = (224, 227, 231)

SIZE = (560, 400)
LEFT, RIGHT, TOP, BOTTOM = 66, 18, 58, 52
_FONT = Path(__file__).parents[1] / "widgets" / "fonts" / "B612-Regular.ttf"
_FINE = 2
"""Everything is drawn so many times larger and shrunk, for smooth lines."""


@dataclass(frozen=True, slots=True)
class Series:
    """Points of one kind."""

    name: str
    points: Sequence[tuple[float, float]]
    colour: Colour = BLUE
    dots: bool = False
    """Draw dots instead of a line."""


@dataclass(frozen=True, slots=True)
class Plot:
    """One picture with axes."""

    title: str
    x: str
    y: str
    series: Sequence[Series]
    even: bool = False
    """A metre along x is as long as one along y."""


def _font(size: int) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(_FONT, size * _FINE)


class _Frame:
    """Where values lie in the picture."""

    def __init__(self, plot: Plot) -> None:
        values = [point for series in plot.series for point in series.points]
        self.x = _range([x for x, _ in values])
        self.y = _range([y for _, y in values])
        if plot.even:
            self._make_even()

    def _make_even(self) -> None:
        width, height = SIZE[0] - LEFT - RIGHT, SIZE[1] - TOP - BOTTOM
        (x0, x1), (y0, y1) = self.x, self.y
        scale = max((x1 - x0) / width, (y1 - y0) / height)
        grow_x, grow_y = (scale * width - (x1 - x0)) / 2, (scale * height - (y1 - y0)) / 2
        self.x, self.y = (x0 - grow_x, x1 + grow_x), (y0 - grow_y, y1 + grow_y)

    def at(self, x: float, y: float) -> tuple[float, float]:
        """In pixels of the large picture."""
        (x0, x1), (y0, y1) = self.x, self.y
        across = LEFT + (x - x0) / (x1 - x0) * (SIZE[0] - LEFT - RIGHT)
        down = SIZE[1] - BOTTOM - (y - y0) / (y1 - y0) * (SIZE[1] - TOP - BOTTOM)
        return across * _FINE, down * _FINE


def _range(values: Sequence[float]) -> tuple[float, float]:
    low, high = min(values), max(values)
    room = (high - low) * 0.06 or 1.0
    return low - room, high + room


def _ticks(low: float, high: float) -> list[float]:
    rough = (high - low) / 6
    power = 10 ** math.floor(math.log10(rough))
    step = next(power * share for share in (1, 2, 5, 10) if power * share >= rough)
    first = math.ceil(low / step)
    return [number * step for number in range(first, math.floor(high / step) + 1)]


def draw(plot: Plot) -> Image.Image:
    """The picture of one plot."""
    image = Image.new("RGB", (SIZE[0] * _FINE, SIZE[1] * _FINE), (255, 255, 255))
    pen, frame = ImageDraw.Draw(image), _Frame(plot)
    _axes(pen, frame, plot)
    for series in plot.series:
        pixels = [frame.at(x, y) for x, y in series.points]
        if series.dots:
            for x, y in pixels:
                pen.ellipse((x - 7, y - 7, x + 7, y + 7), outline=series.colour, width=4)
        else:
            for one, other in pairwise(pixels):
                pen.line((*one, *other), fill=series.colour, width=5)
    _legend(pen, plot.series)
    return image.resize(SIZE, Image.Resampling.LANCZOS)


def _axes(pen: ImageDraw.ImageDraw, frame: _Frame, plot: Plot) -> None:
    small = _font(13)
    for x in _ticks(*frame.x):
        across, down = frame.at(x, frame.y[0])
        pen.line((across, down, across, frame.at(x, frame.y[1])[1]), fill=PALE, width=_FINE)
        pen.text((across, down + 8), f"{x:.6g}", INK, small, anchor="ma")
    for y in _ticks(*frame.y):
        across, down = frame.at(frame.x[0], y)
        pen.line((across, down, frame.at(frame.x[1], y)[0], down), fill=PALE, width=_FINE)
        pen.text((across - 10, down), f"{y:.6g}", INK, small, anchor="rm")
    left, bottom = frame.at(frame.x[0], frame.y[0])
    right, top = frame.at(frame.x[1], frame.y[1])
    pen.rectangle((left, top, right, bottom), outline=GREY, width=_FINE)
    pen.text(((left + right) / 2, SIZE[1] * _FINE - 12), plot.x, INK, small, anchor="ms")
    pen.text((16, 100), plot.y, INK, small, anchor="ls")
    pen.text((SIZE[0] * _FINE / 2, 14), plot.title, INK, _font(16), anchor="ma")


def _legend(pen: ImageDraw.ImageDraw, series: Sequence[Series]) -> None:
    font = _font(12)
    x = (SIZE[0] - RIGHT) * _FINE - 10
    for entry in reversed(series):
        width = pen.textlength(entry.name, font)
        x -= width
        pen.text((x, 100), entry.name, entry.colour, font, anchor="ls")
        if entry.dots:
            pen.ellipse((x - 26, 86, x - 14, 98), outline=entry.colour, width=4)
        else:
            pen.line((x - 36, 92, x - 10, 92), fill=entry.colour, width=5)
        x -= 60


def page(plots: Sequence[Plot], path: Path, columns: int = 2) -> None:
    """Several plots in one picture file."""
    rows = -(-len(plots) // columns)
    sheet = Image.new("RGB", (SIZE[0] * min(columns, len(plots)), SIZE[1] * rows), (255, 255, 255))
    for number, plot in enumerate(plots):
        sheet.paste(draw(plot), (number % columns * SIZE[0], number // columns * SIZE[1]))
    path.parent.mkdir(parents=True, exist_ok=True)
    sheet.quantize(64, dither=Image.Dither.NONE).save(path, optimize=True)
