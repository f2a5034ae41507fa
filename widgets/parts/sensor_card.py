"""Base of the small sensors' pictures: a card, a name, and a brief form for little height.

class LineSensorView(Gauge):
    def marks(self, shapes): yield Word(…)
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from typing import Any

from kivy.metrics import dp, sp
from kivy.properties import StringProperty

from widgets.core.base import text_texture
from widgets.core.canvas_ink import Drawing, Ink, Word, Words
from widgets.core.shapes import Shapes
from widgets.core.surfaces import Glass
from widgets.core.theme import theme

__all__ = ["Gauge", "first_fitting", "wide"]


def wide(text: str, size: float, *, bold: bool = False) -> float:
    """Width of a text in type of `size` [px]."""
    return float(text_texture(text, round(size, 1), theme.font, bold=bold).width)


def first_fitting(texts: Iterable[str], size: float, room: float, *, bold: bool = False) -> str:
    """The first of `texts`, longest first, that fits into `room` [px] in type of `size` [px]; empty when none does."""
    return next((text for text in texts if wide(text, size, bold=bold) <= room), "")


@lru_cache(maxsize=256)
def _cut(text: str, size: float, room: float, font: str) -> str:  # noqa: ARG001 - the widths are those of that font
    """As much of `text` as fits into `room` [px], with dots for the rest; `font` is that of the theme."""
    if wide(text, size) <= room:
        return text
    count = bisect_right(range(1, len(text)), room, key=lambda kept: wide(f"{text[:kept].rstrip()}…", size))
    return f"{text[:count].rstrip()}…" if count else ""


class Gauge(Glass, Drawing):
    """A drawing on a card of its own. Subclasses say what is on it in `marks`."""

    title = StringProperty("")
    """Name of the sensor."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**kwargs)
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)
        for name in ("card", "title", "age"):
            self.fbind(name, self.redraw)

    @property
    def low(self) -> bool:
        """Too little height for more than the newest figure."""
        return bool(self.height < dp(68))

    @property
    def texts(self) -> list[str]:
        """What is written."""
        return self._words.texts

    @property
    def edge(self) -> float:
        """From the border to what is drawn [px]."""
        return float(dp(6 if self.low else 12)) if self.card else float(dp(2))

    def draw(self) -> None:
        """Bring the picture up to date."""
        shapes = Shapes()
        words = list(self.marks(shapes))
        self._ink.fill(shapes)
        self._words.write(words)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Draw into `shapes` and give the words."""
        raise NotImplementedError(f"{type(self).__name__} does not say what is on it")

    def header(self, figures: Sequence[str], role: str = "text", *, told: bool = True) -> Iterator[Word]:
        """The name in the upper left corner and the first of `figures` that fits beside it, longest first.

        Where none does the name gives way, or, when it is not `told`, the figure. A name longer than the card is cut.
        """
        left, y = self.x + self.edge, self.top - self.edge - sp(6)
        right = self.right - self.edge - (dp(22) if self.alarmed else 0)
        name = self.title.upper()
        taken = wide(name, sp(11.5)) + dp(8)
        figure = first_fitting(figures, sp(13), right - left - taken, bold=True)
        if told and not figure and figures:
            figure, name = first_fitting(figures, sp(13), right - left, bold=True), ""
        room = right - left - (wide(figure, sp(13), bold=True) + dp(8) if figure else 0)
        yield Word(_cut(name, sp(11.5), room, theme.font), left, y, sp(11.5), theme.muted, anchor=(0, 0.5))
        yield Word(figure, right, y, sp(13), theme.roles[role], bold=True, anchor=(1, 0.5))
