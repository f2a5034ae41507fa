"""A form to fill in, with the way out of it: workload or usability, kept and scored when it is complete."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.uix.widget import Widget

from app.screens.inputs.study.zip_row import SURE
from widgets import SusForm, TlxScales
from widgets.parts.kit import Column, PrimaryButton, QuietButton, Remark

__all__ = ["FormView"]

WORDS = {
    "tlx": "How was that? Give each of the six an answer; there is no right one.",
    "sus": "How is the app? Answer at once, without thinking long.",
}

LEAVE = "Leave it out"
GAP = "18dp"
"""Beside the room between two buttons: what hands in and what throws away are not pressed for each other."""


class FormView(Column):
    """Dispatches `on_done(score)` with the score, NaN where it was left out."""

    __events__ = ("on_done",)

    def __init__(self, form: str, log: Any, now: Callable[[], float], **kwargs: Any) -> None:
        """`form` is `tlx` or `sus`; `log` is the app's `ResponseRecording`; `now` is our clock [s]."""
        super().__init__(spacing="10dp", **kwargs)
        self.form, self._log, self._now = form, log, now
        self.task: str = log.due
        """What it is about, where it is no study; empty for nothing that has just ended."""
        self._sure = -math.inf
        self.sheet = TlxScales(now) if form == "tlx" else SusForm(now)
        self.said = Remark(role="warn", font_size="15sp")
        self.hand_in = PrimaryButton(text="Hand it in", icon="check")
        self.hand_in.bind(on_release=lambda _: self._done())
        self.skip = QuietButton(text=LEAVE, icon="close")
        self.skip.bind(on_release=lambda _: self._leave())
        words, gap = Remark(text=WORDS[form], font_size="15sp"), Widget(size_hint_y=None, height=GAP)
        for widget in (words, self.sheet, self.said, self.hand_in, gap, self.skip):
            self.add_widget(widget)

    @property
    def begun(self) -> bool:
        """It has an answer that would be lost."""
        return bool(self.sheet.answers)

    def tick(self) -> None:
        """Ask no longer whether it shall be left out, after a while."""
        sure = self._now() - self._sure < SURE
        self.skip.text = "Press again: its answers go" if sure else LEAVE

    def _leave(self) -> None:
        """With answers the first press asks, the second one leaves it out."""
        if self.begun and self._now() - self._sure >= SURE:
            self._sure = self._now()
            self.tick()
        else:
            self.dispatch("on_done", math.nan)

    def _done(self) -> None:
        lacking = self.sheet.mark_unanswered()
        if lacking:
            what = ", ".join(lacking)
            self.said.text = f"No answer yet: {what if self.form == 'tlx' else 'number ' + what}."
            return
        sheet = self.sheet
        score = self._log.fill(self.form, sheet.answers, sheet.order, sheet.seconds, self.task)
        self.dispatch("on_done", score)

    def on_done(self, score: float) -> None:
        """It was handed in or left out."""
