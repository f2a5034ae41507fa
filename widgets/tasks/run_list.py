"""Runs of tasks, newest first: each with its outcome, distance, time and operator.

history = RunList()
history.show(await robot.call("/history/get", GetHistoryRequest(), GetHistoryResponse))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import UTC, datetime
from typing import Any

from kivy.properties import BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import GetHistoryResponse, TaskOrder, TaskRun
from bridge.msgs.std_msgs import Time
from widgets.core.language import mark, tr
from widgets.core.task_words import distance_words, outcome_words, span_words, title
from widgets.parts.buttons import QuietButton
from widgets.parts.listing import Listing
from widgets.parts.rows import ListRow
from widgets.status.event_row import when_words

__all__ = ["RunList", "run_words"]

MAX_RUNS = 300
"""Runs kept here; the oldest are let go [rows]."""


def run_words(run: TaskRun, now: float = math.nan) -> str:
    """How it ended, how far and how long it went and who asked for it, as in `done · 340 m · 12 min · tablet-B`."""
    over = run.ended.seconds if run.ended.seconds > 0 else now
    parts = [tr(outcome_words(run.state, run.code)[2]), distance_words(run.distance)]
    if math.isfinite(over) and run.started.seconds > 0:
        parts.append(span_words(max(0.0, over - run.started.seconds)))
    parts.append(run.by or tr("by itself"))
    return " · ".join(parts)


class RunList(Listing):
    """Dispatches `on_command(before)` with the number before which older runs are wanted."""

    accepts = (GetHistoryResponse,)

    runs: ListProperty[TaskRun] = ListProperty()
    """Every `TaskRun` known here, newest first."""
    more = BooleanProperty(False)
    """There may be older ones at the robot."""
    now = NumericProperty(math.nan)
    """The operators' clock [s]; NaN while it is not known."""
    nothing = StringProperty(mark("No runs yet."))

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.bind(runs=self._build, more=self._build, nothing=self._build)
        self._build()

    def show(self, msg: GetHistoryResponse) -> None:
        """Take over an answer: what is known already is brought up to date, the rest is added in its order."""
        known = {run.id: run for run in self.runs} | {run.id: run for run in msg.runs}
        self.runs = sorted(known.values(), key=lambda run: -run.id)[:MAX_RUNS]

    def clear(self) -> None:
        """Forget all."""
        self.runs = []

    def _build(self, *_: object) -> None:
        self.fill(self._row(run) for run in self.runs)
        if self.runs and self.more:
            button = QuietButton(text=tr("Older"), icon="history")
            button.bind(on_release=lambda _: self.dispatch("on_command", self.runs[-1].id))
            self.ids.column.add_widget(button)

    def _row(self, run: TaskRun) -> ListRow:
        icon, role, _ = outcome_words(run.state, run.code)
        row = ListRow(
            icon=icon, role=role, title=title(run.order), aside=when_words(run.started.seconds, self.now)
        )
        brief = run_words(run, self.now)

        def update(*_: object) -> None:
            row.detail = f"{brief}\n{run.reason}" if row.whole and run.reason else brief

        row.bind(on_release=lambda _: setattr(row, "whole", not row.whole), whole=update)
        update()
        return row


NOON = datetime(2026, 3, 4, 12, 0, tzinfo=UTC).timestamp()
SOME = [
    TaskRun(
        9,
        TaskOrder(task="patrol"),
        Time.at(NOON - 300),
        Time(),
        "RUNNING",
        "Driving to point 3.",
        84.0,
        2,
        "vm",
    ),
    TaskRun(
        8,
        TaskOrder(task="deliver", places=["Office 12", "Lab"]),
        Time.at(NOON - 5000),
        Time.at(NOON - 4300),
        "SUCCEEDED",
        "Delivered at Lab.",
        342.0,
        2,
        "tablet-B",
    ),
    TaskRun(
        7,
        TaskOrder(task="go_to", places=["Office 9"]),
        Time.at(NOON - 90000),
        Time.at(NOON - 89000),
        "FAILED",
        "No way to Office 9: the door is closed.",
        1210.0,
    ),
]
"""For the samples here and elsewhere."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Some, one of them opened, none."""

    def make(runs: list[TaskRun] = SOME, opened: int = -1, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = RunList(size_hint=(None, None), size=("388dp", "270dp"), now=NOON, **kwargs)
            widget.show(GetHistoryResponse(runs=runs))
            if opened >= 0:
                rows = [one for one in widget.walk() if isinstance(one, ListRow)]
                rows[opened].whole = True
            return widget

        return build

    return {"some": make(more=True), "opened": make(opened=2), "none": make([])}
