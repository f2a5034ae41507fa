"""A form to fill in, with the way out of it: workload or usability, kept and scored when it is complete."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.screens.inputs.log_view import BESIDE
from widgets import SusForm, TlxScales
from widgets.kit import Column, PrimaryButton, QuietButton, Remark

__all__ = ["FormView"]

WORDS = {
    "tlx": "How was that? Give each of the six an answer; there is no right one.",
    "sus": "How is the app? Answer at once, without thinking long.",
}


class FormView(Column):
    """Dispatches `on_done(score)` with the score, NaN where it was left out."""

    __events__ = ("on_done",)

    def __init__(self, form: str, log: Any, now: Callable[[], float], **kwargs: Any) -> None:
        """`form` is `tlx` or `sus`; `log` is the app's `Responding`."""
        super().__init__(spacing="10dp", padding=BESIDE, **kwargs)
        self.form, self._log = form, log
        self.sheet = TlxScales(now) if form == "tlx" else SusForm(now)
        self.said = Remark(role="warn", font_size="15sp")
        self.hand_in = PrimaryButton(text="Hand it in", icon="check")
        self.hand_in.bind(on_release=lambda _: self._done())
        self.skip = QuietButton(text="Leave it out", icon="close")
        self.skip.bind(on_release=lambda _: self.dispatch("on_done", float("nan")))
        words = Remark(text=WORDS[form], font_size="15sp")
        for widget in (words, self.sheet, self.said, self.hand_in, self.skip):
            self.add_widget(widget)

    def _done(self) -> None:
        lacking = self.sheet.miss()
        if lacking:
            what = ", ".join(lacking)
            self.said.text = f"No answer yet: {what if self.form == 'tlx' else 'number ' + what}."
            return
        score = self._log.fill(self.form, self.sheet.answers, self.sheet.order, self.sheet.seconds)
        self.dispatch("on_done", score)

    def on_done(self, score: float) -> None:
        """It was handed in or left out."""
