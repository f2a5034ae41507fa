"""Noise where one speaks: level, noise, the distance that a voice needs from it, and the words understood last.

meter = NoiseMeter()
meter.update(level=-28.0, noise=-52.0, snr=24.0)           # dB over full scale, and dB of speech over noise
meter.answer("go home", 0.91, understood=True)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from widgets.core.canvas_ink import Drawing, Ink, Word, Words
from widgets.core.icons import icon
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import first_fitting

__all__ = ["NoiseMeter", "samples"]

LOW, HIGH = -72.0, 0.0
"""Ends of the scale [dB over full scale]."""
HEIGHT = 96
"""[dp]"""


class NoiseMeter(Drawing):
    """Shows and asks for nothing. `state` is `disabled` while nothing is heard, `alarm` where it is too loud."""

    drawn_from: ClassVar[tuple[str, ...]] = (
        "level", "noise", "snr", "needed", "speaking", "clipped", "heard", "confidence", "understood",
    )  # fmt: skip

    level = NumericProperty(-math.inf)
    """Of the last tenth of a second [dB over full scale]; -inf in silence."""
    noise = NumericProperty(math.nan)
    """Of what is no speech [dB over full scale]; NaN unknown."""
    snr = NumericProperty(math.nan)
    """Of speech over noise [dB]; NaN unknown."""
    needed = NumericProperty(6.0)
    """With less of it nothing is understood [dB]."""
    speaking = BooleanProperty(False)
    """Somebody is thought to talk."""
    clipped = BooleanProperty(False)
    """The microphone is overdriven."""
    heard = StringProperty("")
    """What was heard last; empty before the first."""
    confidence = NumericProperty(math.nan)
    """How sure that is, 0 to 1; NaN unknown."""
    understood = BooleanProperty(True)
    """It was a command; else it was turned down."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**{"state": "live", "size_hint_y": None, "height": dp(HEIGHT), **kwargs})
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    @property
    def texts(self) -> list[str]:
        """What is written."""
        return self._words.texts

    def update(
        self, *, level: float, noise: float, snr: float, speaking: bool = False, clipped: bool = False
    ) -> None:
        """Show how loud it is, as of the properties."""
        self.level, self.noise, self.snr = level, noise, snr
        self.speaking, self.clipped = speaking, clipped

    def answer(self, heard: str, confidence: float = math.nan, *, understood: bool) -> None:
        """Show what was heard last, or why nothing was."""
        self.heard, self.confidence, self.understood = heard, confidence, understood

    # what is drawn

    def draw(self) -> None:
        """The words above, the scale, and below it what was heard."""
        shapes = Shapes()
        self._scale(shapes)
        words = [*self._title(), *self._below()]
        self._ink.fill(shapes)
        self._words.write(words, 1.0)

    def _place(self, level: float) -> float:
        share = min(1.0, max(0.0, (level - LOW) / (HIGH - LOW)))
        return float(self.x + dp(8) + share * (self.width - dp(16)))

    def _scale(self, shapes: Shapes) -> None:
        y, begin, end = self.center_y + dp(2), self._place(LOW), self._place(HIGH)
        shapes.line(np.array([[begin, y], [end, y]]), dp(3), theme.line)
        live = self.state in ("live", "alarm")
        now = self._place(self.level)
        if live and now > begin + 1:
            shapes.line(np.array([[begin, y], [now, y]]), dp(14), theme.roles[self._role()])
        if live and math.isfinite(self.noise):
            noise = self._place(self.noise)
            shapes.line(np.array([[noise, y - dp(12)], [noise, y + dp(12)]]), dp(2.5), theme.muted)
            enough = self._place(self.noise + self.needed)
            marks = np.array([[enough, y - dp(15)], [enough, y + dp(15)]])
            shapes.line(marks, dp(7), theme.bg)
            shapes.line(marks, dp(3.5), theme.text)

    def _role(self) -> str:
        if self.clipped or self.state == "alarm":
            return "danger" if self.clipped else "warn"
        return "ok" if self.speaking else "accent"

    def _title(self) -> list[Word]:
        y, size = self.top - dp(16), sp(15)
        texts, role = self._says()
        words = first_fitting(texts, size, self.width - dp(44), bold=True) or texts[-1]
        colour = theme.roles[role]
        return [
            Word(icon("mic"), self.x + dp(18), y, sp(22), colour, font="Icons"),
            Word(words, self.x + dp(34), y, size, colour, bold=True, anchor=(0.0, 0.5)),
        ]

    def _says(self) -> tuple[list[str], str]:
        """Longest first, and the role of the words."""
        if self.state in ("never", "disabled", "stale"):
            return [tr("The microphone is closed"), tr("Closed")], "muted"
        over = f"{self.snr:.0f} dB" if math.isfinite(self.snr) else ""
        if self.state == "alarm":
            need = (
                tr("Too loud: {over} over the noise, {needed:.0f} are needed").format(
                    over=over, needed=self.needed
                )
                if over
                else tr("Too loud here")
            )
            return [need, tr("Too loud: {over}").format(over=over) if over else tr("Too loud")], "warn"
        if self.clipped:
            return [tr("Overdriven: speak further away"), tr("Overdriven")], "danger"
        lead = tr("Voice detected") if self.speaking else tr("Listens")
        role = "ok" if self.speaking else "text"
        return (
            [tr("{lead} · {over} over the noise").format(lead=lead, over=over), f"{lead} · {over}"]
            if over
            else [lead]
        ), role

    def _below(self) -> list[Word]:
        y, size = self.y + dp(15), sp(15)
        if not self.heard:
            return [Word(tr("Nothing heard yet"), self.x + dp(34), y, size, theme.muted, anchor=(0.0, 0.5))]
        sure = (
            " · " + tr("{percent:.0f} % sure").format(percent=self.confidence * 100)
            if math.isfinite(self.confidence)
            else ""
        )
        texts = [f"{self.heard}{sure}", self.heard]
        room = self.width - dp(44)
        text = first_fitting(texts, size, room) or _shortened(self.heard, size, room)
        colour = theme.ok if self.understood else theme.warn
        mark = icon("check_circle_fill" if self.understood else "help")
        return [
            Word(mark, self.x + dp(18), y, sp(20), colour, font="Icons"),
            Word(text, self.x + dp(34), y, size, theme.text, anchor=(0.0, 0.5)),
        ]


def _shortened(text: str, size: float, room: float) -> str:
    cuts = [f"{text[:n].rstrip()}…" for n in range(len(text) - 1, 0, -2)]
    return first_fitting(cuts, size, room) or "…"


def samples() -> dict[str, Callable[[], Widget]]:
    """Listening, a voice, too loud, overdriven, turned down, narrow and closed."""

    def made(
        width: float = 420, answer: Any = None, state: str = "live", **told: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            meter = NoiseMeter(size_hint=(None, None), width=dp(width), state=state)
            meter.update(**{"level": -48.0, "noise": -54.0, "snr": 28.0, **told})
            if answer is not None:
                meter.answer(answer[0], answer[1], understood=answer[2])
            return meter

        return build

    home = ("go home", 0.91, True)
    return {
        "never": made(state="never"),
        "live": made(),
        "voice": made(level=-18.0, speaking=True, answer=home),
        "turned down": made(answer=("That was no command.", math.nan, False)),
        "alarm": made(state="alarm", level=-24.0, noise=-28.0, snr=3.0, answer=home),
        "overdriven": made(level=-1.0, clipped=True, speaking=True),
        "narrow": made(
            230, level=-20.0, speaking=True, answer=("It is too loud here to be sure.", 0.4, False)
        ),
        "disabled": made(state="disabled", answer=home),
    }
