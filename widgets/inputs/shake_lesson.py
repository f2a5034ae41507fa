"""Lesson in shaking as a moving picture: a phone that goes to and fro as the hand should, and the progress.

lesson = ShakeLesson()
lesson.update("lr", doing=True, progress=0.2, beat=0.7)     # beat [s]: where the phone is drawn, from the clock
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty
from kivy.uix.widget import Widget

from widgets.core.canvas_ink import Drawing, Ink, Word, Words, tint
from widgets.core.icons import icon
from widgets.core.language import mark, tr, within
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import first_fitting

__all__ = ["ShakeLesson"]

WORDS = {
    "lr": (mark("Shake left and right"), mark("Left and right")),
    "ud": (mark("Shake up and down"), mark("Up and down")),
    "fb": (mark("Shake forward and back"), mark("Forward and back")),
    "": (mark("Done"), mark("Done")),
}
"""Of each movement, longest first."""
BEAT = 2.2
"""How often a second the phone goes to and fro [Hz]."""
PHONE = (0.3, 0.56)
"""Half of its width and height, in parts of the picture's half height."""
REACH = 0.42
"""How far it goes each way, in the same."""
NEAR = 0.28
"""How much larger and smaller it looks forward and back."""


class ShakeLesson(Drawing):
    """Shows and asks for nothing."""

    drawn_from: ClassVar[tuple[str, ...]] = ("axis", "doing", "progress", "offset")

    axis = OptionProperty("lr", options=list(WORDS))
    """`lr`, `ud` or `fb`; empty once it is over."""
    doing = BooleanProperty(False)
    """The hand is to move; else it is to be still and read."""
    progress = NumericProperty(0.0)
    """Of the whole lesson, 0 to 1."""
    offset = NumericProperty(0.0)
    """Where the phone is drawn, -1 to 1 of its way."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**{"state": "live", **kwargs})
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    @property
    def texts(self) -> list[str]:
        """What is written."""
        return self._words.texts

    def update(self, axis: str, *, doing: bool, progress: float, beat: float = 0.0) -> None:
        """Show that movement; `beat` is any clock [s] that the picture moves by."""
        self.axis, self.doing, self.progress = axis, doing, min(1.0, max(0.0, progress))
        self.offset = math.sin(math.tau * BEAT * beat) if doing and axis else 0.0

    def draw(self) -> None:
        """The phone between its arrows, the words below, and how far it is."""
        shapes, words = Shapes(), []
        foot = dp(6) + sp(22) + dp(14)
        # as high as there is room, and no wider with its arrows than there is
        half = max(1.0, min((self.height - foot - dp(8)) / 2, (self.width / 2 - dp(20)) / 1.1))
        x, y = self.center_x, (self.y + foot + self.top) / 2
        colour = theme.accent if self.doing or not self.axis else theme.muted
        shift, scale = self._shift(half)
        if self.axis:
            self._arrows(shapes, x, y, half, colour)
        self._phone(shapes, (x + shift[0], y + shift[1]), half * scale, colour)
        if not self.axis:
            words.append(Word(icon("check"), x, y, half * 0.5, colour, font="Icons"))
        words.append(self._caption(foot))
        self._bar(shapes, colour)
        self._ink.fill(shapes)
        self._words.write(words, 1.0)

    def _caption(self, foot: float) -> Word:
        texts = [f"{text} …" if self.doing else text for text in map(tr, WORDS[self.axis])]
        if self.axis and not self.doing:
            texts = [
                tr("Hold still. Next: {texts}").format(texts=within(texts[1])),
                tr("Next: {texts}").format(texts=within(texts[1])),
                texts[1],
            ]
        size = sp(18)
        text = first_fitting(texts, size, self.width - dp(12), bold=True) or texts[-1]
        return Word(text, self.center_x, self.y + foot - sp(14), size, theme.text, bold=True)

    def _shift(self, half: float) -> tuple[tuple[float, float], float]:
        way = REACH * half * self.offset
        if self.axis == "lr":
            return (way, 0.0), 1.0
        if self.axis == "ud":
            return (0.0, way * 0.7), 0.8
        return (0.0, 0.0), 0.8 * (1.0 + NEAR * self.offset)

    def _phone(self, shapes: Shapes, middle: tuple[float, float], half: float, colour: Any) -> None:
        (x, y), (across, up) = middle, (PHONE[0] * half, PHONE[1] * half)
        corners = np.array(
            [[x - across, y - up], [x + across, y - up], [x + across, y + up], [x - across, y + up]]
        )
        shapes.polygon([(float(a), float(b)) for a, b in corners], theme.raised)
        around = np.concatenate([corners, corners[:2]])
        shapes.line(around, dp(3.5), colour)
        shapes.line(
            np.array([[x - 0.25 * across, y + up * 0.88], [x + 0.25 * across, y + up * 0.88]]),
            dp(2.5),
            colour,
        )

    def _arrows(self, shapes: Shapes, x: float, y: float, half: float, colour: Any) -> None:
        faint = tint(colour, 0.9 if self.doing else 0.6)
        reach, begin = 0.98 * half, PHONE[0] * half + REACH * half + dp(8)
        if self.axis == "lr":
            ways = [((-1.0, 0.0), begin), ((1.0, 0.0), begin)]
        elif self.axis == "ud":
            ways = [((0.0, 1.0), 0.0), ((0.0, -1.0), 0.0)]
            x += 0.8 * half
            begin = 0.0
        else:  # towards the eye and away from it, drawn aslant
            ways = [((0.72, 0.42), 0.0), ((-0.72, -0.42), 0.0)]
            x += 0.95 * half
            reach *= 0.62
        for (dx, dy), start in ways:
            far = max(reach, start + 0.36 * half)
            self._arrow(shapes, (x + dx * start, y + dy * start), (x + dx * far, y + dy * far), faint)

    def _arrow(
        self, shapes: Shapes, start: tuple[float, float], end: tuple[float, float], colour: Any
    ) -> None:
        length = math.dist(start, end) or 1.0
        dx, dy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
        head = min(dp(16), 0.5 * length)
        neck = end[0] - dx * head, end[1] - dy * head
        shapes.line(np.array([start, neck]), dp(5), colour)
        side = 0.62 * head
        shapes.polygon(
            [end, (neck[0] - dy * side, neck[1] + dx * side), (neck[0] + dy * side, neck[1] - dx * side)],
            colour,
        )

    def _bar(self, shapes: Shapes, colour: Any) -> None:
        """Three pieces, one for each movement."""
        left, right, y = self.x + dp(10), self.right - dp(10), self.y + dp(7)
        piece = (right - left) / 3.0
        for index in range(3):
            start, end = left + index * piece + dp(3), left + (index + 1) * piece - dp(3)
            shapes.line(np.array([[start, y], [end, y]]), dp(7), theme.line)
            done = min(1.0, max(0.0, 3.0 * self.progress - index))
            if done > 0.02:
                shapes.line(np.array([[start, y], [start + done * (end - start), y]]), dp(7), colour)


def samples() -> dict[str, Callable[[], Widget]]:
    """Each movement, waiting for one, and the end."""

    def make(axis: str, beat: float = 0.0, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            lesson = ShakeLesson(size_hint=(None, None), size=("330dp", "230dp"))
            lesson.update(axis, beat=beat, **kwargs)
            return lesson

        return build

    quarter = 0.25 / BEAT
    return {
        "next": make("lr", doing=False, progress=0.05),
        "left and right": make("lr", quarter, doing=True, progress=0.2),
        "up and down": make("ud", quarter, doing=True, progress=0.55),
        "forward and back": make("fb", quarter, doing=True, progress=0.9),
        "done": make("", doing=False, progress=1.0),
    }
