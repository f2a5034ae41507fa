"""Six scales of the NASA task load index, each in 21 steps, none answered beforehand.

form = TlxScales()
form.bind(on_command=lambda form, name, value: …)
form.answers  # {"mental": 35, …}
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.canvas_ink import Drawing, Ink, Word, Words
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.buttons import IconButton
from widgets.study.questionnaire import AnswerRow, AnswerSheet

__all__ = ["SCALES", "TlxScales", "samples"]

SCALES: dict[str, tuple[str, str, str, str]] = {
    "mental": ("Mental demand", "How much did you have to think, look and decide?", "Low", "High"),
    "physical": ("Physical demand", "How much did your hands and body have to do?", "Low", "High"),
    "temporal": ("Temporal demand", "How hurried were you?", "Low", "High"),
    "performance": ("Performance", "How well did you do what you were asked to do?", "Perfect", "Failure"),
    "effort": ("Effort", "How hard did you have to work for that?", "Low", "High"),
    "frustration": ("Frustration", "How insecure, annoyed or stressed were you?", "Low", "High"),
}
"""Scale to its name, its question, and the words at its ends."""
STEP, MAX_RATING, MIDDLE = 5, 100, 50

Builder.load_string("""
<TlxScale>:
    padding: dp(12), dp(9), dp(12), dp(10)
    spacing: dp(2)
    BoxLayout:
        size_hint_y: None
        height: name.height
        Text:
            id: name
            text: root.name
            bold: True
            font_size: sp(16)
        Text:
            text: root.figure
            bold: True
            font_size: sp(16)
            role: 'warn' if root.lacking else 'text'
            halign: 'right'
            size_hint_x: None
            width: dp(100)
    Text:
        text: root.question
        role: 'muted'
        font_size: sp(14.5)
    BoxLayout:
        id: line
        size_hint_y: None
        height: theme.target
        spacing: dp(4)
""")


class Ticks(Drawing, Widget):
    """The line of a scale: 21 ticks, words at its ends, a knob where the answer is, none before there is one."""

    veiled = False
    drawn_from: ClassVar = ("value", "low", "high")

    value = NumericProperty(math.nan)
    """0 to 100; NaN for no answer."""
    low = StringProperty("Low")
    high = StringProperty("High")

    __events__ = ("on_point",)

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**{"state": "live", **kwargs})
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    @property
    def texts(self) -> list[str]:
        """What is written."""
        return self._words.texts

    @property
    def span(self) -> tuple[float, float]:
        """Left and right end of the line [px]."""
        return self.x + dp(12), self.right - dp(12)

    def at(self, x: float) -> int:
        """Value of the tick nearest to a place [px]."""
        left, right = self.span
        share = (x - left) / max(right - left, 1.0)
        return round(max(0.0, min(share, 1.0)) * MAX_RATING / STEP) * STEP

    def draw(self) -> None:
        """Ticks, words, knob."""
        shapes, (left, right), y = Shapes(), self.span, self.center_y + dp(7)
        xs = np.linspace(left, right, MAX_RATING // STEP + 1)
        tall = np.where(
            np.arange(len(xs)) % 10 == 0, dp(11), np.where(np.arange(len(xs)) % 2 == 0, dp(7), dp(4))
        )
        shapes.segments(np.array([[left, y]]), np.array([[right, y]]), dp(2), theme.muted)
        shapes.segments(np.stack([xs, y - tall], 1), np.stack([xs, y + tall], 1), dp(1.6), theme.muted)
        if math.isfinite(self.value):
            x = left + (right - left) * self.value / MAX_RATING
            shapes.disc(x, y, dp(12), theme.accent)
            shapes.ring(x, y, dp(8), dp(2), theme.ink_accent)
        self._ink.fill(shapes)
        low = self.y + dp(10)
        self._words.write(
            [
                Word(self.low, left, low, sp(13), theme.text, anchor=(0, 0.5)),
                Word(self.high, right, low, sp(13), theme.text, anchor=(1, 0.5)),
            ]
        )

    def on_touch_down(self, touch: Any) -> bool:
        """A finger points at a tick and may go on along the line."""
        if self.disabled or not self.collide_point(*touch.pos):
            return bool(super().on_touch_down(touch))
        touch.grab(self)
        self.dispatch("on_point", self.at(touch.x))
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Follow it."""
        if touch.grab_current is not self:
            return bool(super().on_touch_move(touch))
        self.dispatch("on_point", self.at(touch.x))
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Let go."""
        if touch.grab_current is not self:
            return bool(super().on_touch_up(touch))
        touch.ungrab(self)
        return True

    def on_point(self, value: int) -> None:
        """A finger is at that tick."""


class TlxScale(AnswerRow):
    """One scale, 0 to 100 in steps of 5: its question, the line, and a button at either end for who cannot point so finely."""

    question = StringProperty("")

    def _figure(self) -> str:
        without = "no answer" if self.lacking else "—"
        return f"{self.value:.0f}" if math.isfinite(self.value) else without

    figure = AliasProperty(_figure, bind=["value", "lacking"])
    """The answer in words."""

    def __init__(self, key: str, **kwargs: Any) -> None:
        name, question, low, high = SCALES[key]
        super().__init__(name=name, question=question, **kwargs)
        self.ticks = Ticks(low=low, high=high)
        self.less, self.more = IconButton(icon="remove"), IconButton(icon="add")
        self.less.bind(on_release=lambda _: self.step(-STEP))
        self.more.bind(on_release=lambda _: self.step(STEP))
        self.ticks.bind(on_point=lambda _, value: self.answer(value))
        self.bind(value=self.ticks.setter("value"))
        for part in (self.less, self.ticks, self.more):
            self.ids.line.add_widget(part)

    def step(self, by: int) -> None:
        """One tick on; the first step of all goes to the middle, from where either end is as far."""
        self.answer(MIDDLE if math.isnan(self.value) else int(max(0, min(self.value + by, MAX_RATING))))


class TlxScales(AnswerSheet):
    """Dispatches `on_command(scale, value)` with each answer, 0 to 100 in steps of 5."""

    def __init__(self, now: Callable[[], float] = time.monotonic, **kwargs: Any) -> None:
        """`now` times the answers [s]."""
        super().__init__({key: TlxScale(key) for key in SCALES}, now, **kwargs)


def samples() -> dict[str, Callable[[], Widget]]:
    """Without answers, with some, with all, with those that lack."""

    def made(
        some: int = 0, width: float = 460, *, lacking: bool = False, **more: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            form = TlxScales(size_hint=(None, None), width=dp(width), **more)
            for number, scale in enumerate(list(form.rows.values())[:some]):
                scale.answer((35, 10, 60, 25, 100, 0)[number])
            if lacking:
                form.mark_unanswered()
            return form

        return build

    return {
        "live": made(),
        "some": made(3),
        "full": made(6),
        "lacking": made(4, lacking=True),
        "narrow": made(6, 340),
        "disabled": made(2, state="disabled"),
    }
