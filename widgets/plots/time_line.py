"""Line of a recording's time: where it stands, what happened when, and a finger that goes elsewhere.

line = TimeLine(start=index.start, end=index.end)
line.bind(on_seek=lambda _, at: player.seek(at))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.input import MotionEvent
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty
from kivy.uix.widget import Widget

from widgets.core.canvas_ink import Drawing, Ink, Word, Words
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.plots.axes import clock_text

__all__ = ["TimeLine", "length_text", "samples"]

LEVELS = {"alarm": "danger", "warn": "warn"}
"""Level of what happened to the role of its mark; anything else is muted."""


def length_text(seconds: float) -> str:
    """How long something lasts, as in `4:31` or `1:02:05`; a dash for NaN."""
    if not math.isfinite(seconds):
        return "—"
    minutes, rest = divmod(max(0, round(seconds)), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02d}:{rest:02d}" if hours else f"{minutes}:{rest:02d}"


class TimeLine(Drawing):
    """A finger anywhere on it goes to that moment, and along with the finger. Dispatches `on_seek(at)`."""

    drawn_from: ClassVar = ("start", "end", "position", "marks")
    veiled: ClassVar = False

    __events__ = ("on_seek",)

    start = NumericProperty(math.nan)
    """Where the recording begins [s since 1970]."""
    end = NumericProperty(math.nan)
    """Where it ends."""
    position: NumericProperty[float] = NumericProperty(math.nan)
    """The moment that is shown."""
    marks: ListProperty[tuple[float, str]] = ListProperty()
    """When something happened, and its level."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**kwargs)
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    def on_seek(self, at: float) -> None:
        """A finger asks for a moment [s since 1970]."""

    @property
    def _ends(self) -> tuple[float, float]:
        """Left and right end of the line [px]."""
        return self.x + dp(12), self.right - dp(12)

    def x_of(self, at: float) -> float:
        """Where a moment is [px]."""
        left, right = self._ends
        return left + (right - left) * (at - self.start) / max(self.end - self.start, 1e-9)

    def _seek(self, x: float) -> None:
        left, right = self._ends
        part = min(max((x - left) / max(right - left, 1.0), 0.0), 1.0)
        if math.isfinite(self.start) and math.isfinite(self.end):
            self.dispatch("on_seek", self.start + part * (self.end - self.start))

    def on_touch_down(self, touch: MotionEvent) -> bool:
        """Go where the finger is."""
        if self.disabled or touch.is_mouse_scrolling or not self.collide_point(*touch.pos):
            return False
        touch.grab(self)
        self._seek(touch.x)
        return True

    def on_touch_move(self, touch: MotionEvent) -> bool:
        """Go along with it."""
        if touch.grab_current is self:
            self._seek(touch.x)
            return True
        return False

    def on_touch_up(self, touch: MotionEvent) -> bool:
        """Stay there."""
        if touch.grab_current is self:
            touch.ungrab(self)
            return True
        return False

    def draw(self) -> None:
        """The line, what has passed of it, marks, the moment."""
        shapes, (left, right) = Shapes(), self._ends
        known = math.isfinite(self.start) and math.isfinite(self.end)
        y = self.y + self.height * (0.6 if self.height > dp(40) else 0.5)
        shapes.line(np.array([[left, y], [right, y]]), dp(6), theme.line)
        words = []
        if known and math.isfinite(self.position):
            x = self.x_of(self.position)
            shapes.line(np.array([[left, y], [max(x, left + 0.1), y]]), dp(6), theme.plan)
            for at, level in self.marks:
                place, role = self.x_of(at), LEVELS.get(level, "muted")
                tall = dp(11) if role == "muted" else dp(14)
                shapes.line(np.array([[place, y - tall], [place, y + tall]]), dp(2), theme.roles[role])
            shapes.disc(x, y, dp(11), theme.plan)
            shapes.disc(x, y, dp(5), theme.surface)
        if known and self.height > dp(40):
            size = sp(12)
            for at, x, anchor in ((self.start, left, 0.0), (self.end, right, 1.0)):
                words.append(
                    Word(clock_text(at, 1.0), x, self.y + dp(1), size, theme.muted, anchor=(anchor, 0))
                )
        self._ink.fill(shapes)
        self._words.write(words)


def samples() -> dict[str, Callable[[], Widget]]:
    """Before a recording is open, and within one."""

    def made(**kwargs: Any) -> Callable[[], Widget]:
        return lambda: TimeLine(size_hint=(None, None), size=(dp(420), dp(56)), **kwargs)

    start = 1763719271.0
    marks = [(start + 30, "info"), (start + 80, "warn"), (start + 200, "alarm")]
    return {
        "never": made(),
        "live": made(state="live", start=start, end=start + 271, position=start + 120, marks=marks),
    }
