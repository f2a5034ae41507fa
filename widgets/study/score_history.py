"""Scores over time: a dot for each, newest at the right, and a dashed line to compare with.

history = ScoreHistory(title="Workload", baseline=34.2, baseline_words="in the paper")
history.scores = [("Voice", 41.7), ("Shake", 36.0)]
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["ScoreHistory", "samples"]

MAX_SCORE = 100.0


class ScoreHistory(Gauge):
    """Scores from 0 to 100, one beside the other in their order."""

    drawn_from: ClassVar[tuple[str, ...]] = ("scores", "baseline", "baseline_words", "nothing")

    scores = ListProperty()
    """What each is of, and the score, 0 to 100; the oldest first."""
    baseline = NumericProperty(math.nan)
    """To compare with; NaN for nothing."""
    baseline_words = StringProperty("")
    nothing = StringProperty("No questionnaire completed yet.")

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Title and newest score, lines of the scale, what it is compared with, a dot for each."""
        newest = f"{self.scores[-1][1]:.1f}" if self.scores else ""
        yield from self.header([f"newest {newest}", newest] if newest else [], told=True)
        left, right = self.x + self.edge + dp(30), self.right - self.edge - dp(8)
        low, top = (
            self.y + self.edge + dp(24),
            self.top - self.edge - dp(46 if math.isfinite(self.baseline) else 30),
        )

        def at(score: float) -> float:
            return float(low + (top - low) * score / MAX_SCORE)

        for value in (0, 25, 50, 75, 100):
            shapes.segments(
                np.array([[left, at(value)]]), np.array([[right, at(value)]]), dp(1), tint(theme.muted, 0.45)
            )
            if value % 50 == 0:
                yield Word(str(value), left - dp(6), at(value), sp(12), theme.muted, anchor=(1, 0.5))
        if not self.scores:
            said = first_fitting((self.nothing, "Nothing yet"), sp(14), right - left - dp(12))
            word = Word(
                said, (left + right) / 2, at(62.5 if self.baseline < 50 else 37.5), sp(14), theme.muted
            )
            ground(shapes, word, theme.surface)
            yield word
        yield from self._compared(shapes, (left, right), at(self.baseline))
        yield from self._dots(shapes, (left, right), at, low)

    def _compared(self, shapes: Shapes, span: tuple[float, float], y: float) -> Iterator[Word]:
        if not math.isfinite(self.baseline):
            return
        points = np.array([[span[0], y], [span[1], y]])
        shapes.dashes(points, dp(2.5), theme.plan, period=dp(13), dash=dp(6))
        left, above = self.x + self.edge, self.top - self.edge - dp(27)
        sample = np.array([[left, above], [left + dp(26), above]])
        shapes.dashes(sample, dp(2.5), theme.plan, period=dp(13), dash=dp(6))
        said = f"{self.baseline:g} {self.baseline_words}".strip()
        yield Word(said, left + dp(34), above, sp(13), theme.plan, bold=True, anchor=(0, 0.5))

    def _dots(
        self, shapes: Shapes, span: tuple[float, float], at: Callable[[float], float], low: float
    ) -> Iterator[Word]:
        (left, right), room = span, max(int((span[1] - span[0]) / dp(24)), 2)
        shown = self.scores[-room:]
        step = (right - left) / max(len(shown), 1)
        xs = [left + step * (number + 0.5) for number in range(len(shown))]
        points = np.array([[x, at(score)] for x, (_, score) in zip(xs, shown, strict=True)])
        if len(points) > 1:
            shapes.line(points, dp(2), tint(theme.accent, 0.6))
        for (x, y), (name, score) in zip(points, shown, strict=True):
            shapes.disc(x, y, dp(8), theme.surface)
            shapes.disc(x, y, dp(6), theme.accent)
            if step >= dp(34):
                word = Word(f"{score:.0f}", x, y + dp(16), sp(13), theme.text, bold=True)
                ground(shapes, word, theme.surface)
                yield word
            if wide(name, sp(12)) <= step - dp(4):
                yield Word(name, x, low - dp(13), sp(12), theme.muted)


def samples() -> dict[str, Callable[[], Widget]]:
    """None, few, many, without a line to compare with."""
    few = [("Buttons", 21.7), ("Voice", 36.0), ("Shake", 44.2), ("Switches", 30.8)]

    def made(scores: list[tuple[str, float]], width: float = 460, **more: Any) -> Callable[[], Widget]:
        given = {
            "title": "Workload, raw TLX",
            "baseline": 34.2,
            "baseline_words": "in the paper",
            "state": "live",
        }
        size = {"size_hint": (None, None), "size": (dp(width), dp(210))}
        return lambda: ScoreHistory(scores=scores, **{**given, **size, **more})

    return {
        "never": made([], state="never"),
        "live": made(few),
        "many": made([("Voice", 60 - 25 * math.sin(number / 5) - number * 0.5) for number in range(60)]),
        "no line": made(few[:2], baseline=math.nan, title="Usability, SUS"),
        "narrow": made(few, 300),
        "stale": made(few, state="stale", age=12.0),
        "alarm": made(few, state="alarm"),
        "disabled": made(few, state="disabled"),
    }
