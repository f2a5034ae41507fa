"""Workload and usability: fill in a form, and how the scores went over time beside what the paper found."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from app.screens.inputs.parts.setting_row import switch_row
from app.screens.inputs.study.form_view import FormView
from app.screens.inputs.study.log_view import look_of
from app.study.questionnaires import BASELINE, SUS_ABOVE
from widgets.parts.kit import Column, QuietButton, Remark
from widgets.study.score_history import ScoreHistory

__all__ = ["LoadView"]


class LoadView(Column):
    """Two buttons and two histories; while a form is open the form."""

    def __init__(self, log: Any, now: Callable[[], float], **kwargs: Any) -> None:
        """`log` is the app's `ResponseRecording`."""
        super().__init__(spacing="10dp", **kwargs)
        self._log, self._now = log, now
        self.form: FormView | None = None
        """The form that is open; None for none."""
        self._begun: dict[str, FormView] = {}
        """Forms that were closed with answers in them: they are gone on with."""
        self.said = Remark(role="ok", font_size="15sp")
        self.load, self.use = QuietButton(icon="edit"), QuietButton(icon="edit")
        self.load.bind(on_release=lambda _: self.open("tlx"))
        self.use.bind(on_release=lambda _: self.open("sus"))
        self.asks, self.reminds = switch_row(
            "notifications",
            "Remind me after each task",
            "When a task is over, a sentence offers its workload form.",
            log.remind,
        )
        size = {"size_hint_y": None, "height": "220dp", "state": "live"}
        self.loads = ScoreHistory(
            title="Workload, raw TLX",
            baseline=BASELINE,
            baseline_words="in the paper; less is better",
            **size,
        )
        self.uses = ScoreHistory(
            title="Usability, SUS", baseline=SUS_ABOVE, baseline_words="is average; more is better", **size
        )
        self._lay()

    def open(self, form: str) -> None:
        """Show a form, `tlx` or `sus`: the one that was begun, else an empty one."""
        begun = self._begun.pop(form, None)
        self.form = begun or FormView(form, self._log, self._now)
        if begun is None:
            self.form.bind(on_done=lambda _, score: self._done(form, score))
        self.form.sheet.resume()
        self._lay()

    def back(self) -> bool:
        """Close the form that is open, which keeps its answers; False where none is."""
        if self.form is None:
            return False
        self.form.sheet.pause()
        if self.form.begun:
            self._begun[self.form.form] = self.form
        self.form = None
        self._lay()
        self.tick()
        return True

    def enter(self) -> None:
        """Come onto the glass."""
        if self._log.due and self.form is None:
            self.open("tlx")
        self.tick()

    def leave(self) -> None:
        """Leave the glass; a form that is open stays so."""

    def tick(self) -> None:
        """Bring up to date what was filled in."""
        self.reminds.active = self._log.reminds
        for button, form, words in (
            (self.load, "tlx", "workload (TLX)"),
            (self.use, "sus", "usability (SUS)"),
        ):
            button.text = f"Go on with the {words}" if form in self._begun else f"Fill in the {words}"
        if self.form is not None:
            self.form.tick()
        kept = self._log.archive.workloads.kept
        for history, form in ((self.loads, "tlx"), (self.uses, "sus")):
            history.scores = [(_name(one), one.score) for one in kept if one.form == form]

    def _done(self, form: str, score: float) -> None:
        about, self.form = self.form, None
        if about is not None and about.task == self._log.due:
            self._log.due = ""
        if math.isfinite(score):
            self.said.text = f"{'Workload' if form == 'tlx' else 'Usability'} {score:.1f} of 100, kept."
        self._lay()
        self.tick()

    def _lay(self) -> None:
        self.clear_widgets()
        shown = (
            [self.form]
            if self.form is not None
            else [self.load, self.use, self.said, self.loads, self.uses, self.asks]
        )
        for widget in shown:
            self.add_widget(widget)


def _name(one: Any) -> str:
    """What a score is of: the method, else the task, else the day."""
    if one.method:
        return look_of(one.method)[1]
    return one.task.replace("_", " ") or time.strftime("%d %b", time.localtime(one.at))
