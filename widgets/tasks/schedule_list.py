"""Scheduled tasks and their times: a row each, with a switch.

schedule = ScheduleList()
robot.on("/schedule", schedule.show)
schedule.bind(on_command=lambda _, task: print(task.enabled), on_open=lambda _, task: edit(task))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.properties import ListProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import Schedule, ScheduledTask, TaskOrder
from bridge.msgs.std_msgs import Time
from widgets.core.language import mark
from widgets.core.task_words import TASKS, rhythm, span_words, title
from widgets.parts.choices import Toggle
from widgets.parts.listing import Listing
from widgets.parts.rows import ListRow

__all__ = ["ScheduleList"]


class ScheduleList(Listing):
    """Dispatches `on_command(task)` for one that was switched on or off, `on_open(task)` for one that was pressed."""

    accepts = (Schedule,)
    sends = (ScheduledTask,)

    __events__ = ("on_open",)

    tasks: ListProperty[ScheduledTask] = ListProperty()
    """Every `ScheduledTask`."""
    nothing = StringProperty(mark("No tasks are scheduled."))
    now = NumericProperty(math.nan)
    """The operators' clock [s]; NaN while it is not known."""

    def __init__(self, **kwargs: Any) -> None:
        self._rows: list[tuple[ScheduledTask, ListRow]] = []
        super().__init__(**kwargs)
        self.bind(tasks=self._build, now=self._update)
        self._build()

    def show(self, msg: Schedule) -> None:
        """Take over all that starts by itself."""
        self.tasks = list(msg.tasks)

    def on_open(self, task: ScheduledTask) -> None:
        """A finger pressed its row."""

    def _build(self, *_: object) -> None:
        self._rows = [(task, self._row(task)) for task in self.tasks]
        self.fill(row for _, row in self._rows)
        self._update()

    def _row(self, task: ScheduledTask) -> ListRow:
        words = TASKS.get(task.order.task)
        row = ListRow(
            icon=words.icon if words else "help",
            role="plan" if task.enabled else "muted",
            title=title(task.order),
            faded=not task.enabled,
        )
        row.bind(on_release=lambda _: self.dispatch("on_open", task))
        toggle = Toggle(active=task.enabled, pos_hint={"center_y": 0.5})
        toggle.bind(on_change=lambda _, on: self._switch(task, on))
        row.add_widget(toggle)
        return row

    def _switch(self, task: ScheduledTask, on: bool) -> None:
        switched = ScheduledTask(task.id, on, task.order, task.at, task.days, task.every, task.next)
        self.dispatch("on_command", switched)

    def _update(self, *_: object) -> None:
        for task, row in self._rows:
            left = task.next.seconds - self.now
            soon = task.enabled and task.next.seconds > 0 and math.isfinite(left)
            row.detail = rhythm(task) + (f" · in {span_words(max(0.0, left))}" if soon else "")


SOME = [
    ScheduledTask(
        id=1,
        order=TaskOrder(task="patrol"),
        at="22:00",
        days=[True] * 5 + [False] * 2,
        next=Time.at(10800.0),
    ),
    ScheduledTask(
        id=2, order=TaskOrder(task="deliver", places=["Reception", "Lab"]), every=5400.0, next=Time.at(1500.0)
    ),
    ScheduledTask(id=3, order=TaskOrder(task="dock"), at="06:30", enabled=False),
]
"""For the samples here and elsewhere."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Some, none, and while it cannot be changed."""

    def make(tasks: list[ScheduledTask] = SOME, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = ScheduleList(size_hint=(None, None), size=("388dp", "200dp"), now=0.0, **kwargs)
            widget.show(Schedule(tasks=tasks))
            return widget

        return build

    return {"some": make(), "none": make([]), "disabled": make(state="disabled")}
