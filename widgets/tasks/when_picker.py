"""Time of a scheduled task: a time of day on some days, or an interval.

when = WhenPicker()
when.show(ScheduledTask(at="22:00"))
when.bind(on_command=lambda _, task: print(task.at, task.days, task.every))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.label import Label
from kivy.uix.widget import Widget

import widgets.parts.choices
import widgets.parts.stepper  # noqa: F401 - their rules draw what is used here
from bridge.msgs.pilothouse_msgs import ScheduledTask
from widgets.core.base import Control
from widgets.core.language import tr
from widgets.core.surfaces import Outlined
from widgets.core.task_words import DAYS
from widgets.parts.column import Column

__all__ = ["WhenPicker"]

Builder.load_string("""
<WhenPicker>:
    spacing: dp(8)
    Segmented:
        options: [('at', tr('At a time')), ('every', tr('Every so often'))]
        value: root.way
        on_choose: root.choose(way=args[1])
    BoxLayout:
        size_hint_y: None
        height: max(dp(44), theme.target)
        spacing: dp(16)
        Stepper:
            id: hours
            value: root.hour
            unit: 'h'
            minimum: -1 if root.way == 'at' else 0
            maximum: 24 if root.way == 'at' else 167
            pos_hint: {'center_y': .5}
            on_change: root.choose(hour=int(args[1]))
        Stepper:
            id: minutes
            value: root.minute
            unit: 'min'
            step: 5
            minimum: -5
            maximum: 60
            pos_hint: {'center_y': .5}
            on_change: root.choose(minute=int(args[1]))
        Widget:
    BoxLayout:
        id: week
        size_hint_y: None
        height: theme.target
        spacing: dp(4)

<Day>:
    font_name: theme.font
    font_size: sp(13)
    bold: root.on
    color: theme.ink_accent if root.on else theme.muted
    disabled_color: self.color
    rim: 'accent' if root.on else 'line'
    ground: 'accent' if root.on else 'raised'
""")


class Day(Outlined, ButtonBehavior, Label):
    """One day of the week, on or off."""

    on = BooleanProperty(True)


class WhenPicker(Control, Column):
    """Dispatches `on_command(task)`: the task it was shown, with what a finger changed."""

    accepts = (ScheduledTask,)
    sends = (ScheduledTask,)

    task: ObjectProperty[ScheduledTask] = ObjectProperty(ScheduledTask(at="08:00"))
    """What it starts, with when."""
    way = StringProperty("at")
    """`at` a time of day, or `every` so often."""
    hour = NumericProperty(8)
    """Of the time of day, or of the period [h]."""
    minute = NumericProperty(0)
    """The same [min]."""
    days: ListProperty[bool] = ListProperty([True] * 7)
    """Monday first."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._days = []
        for index, name in enumerate(map(tr, DAYS)):
            day = Day(text=name)
            day.bind(on_release=lambda _, index=index: self._flip(index))
            self._days.append(day)
            self.ids.week.add_widget(day)
        self._week = self.ids.week.__self__
        self.bind(days=self._mark, way=self._mark)
        self._mark()

    def show(self, msg: ScheduledTask) -> None:
        """Take over when a task starts; nothing is dispatched."""
        self.task, self.days = msg, list(msg.days)
        self.way = "at" if msg.at or not msg.every else "every"
        hour, _, minute = (msg.at or "08:00").partition(":")
        minutes = round(msg.every / 60)
        known = self.way == "at" and hour.isdecimal() and minute.isdecimal()
        self.hour, self.minute = (int(hour), int(minute)) if known else divmod(minutes, 60)

    def _flip(self, index: int) -> None:
        days = list(self.days)
        days[index] = not days[index]
        self.choose(days=days)

    def choose(self, **changes: Any) -> None:
        """Change `way`, `hour`, `minute` or `days` as a finger would; hours and minutes go round the clock."""
        if changes.get("way") == "every" and self.way == "at":
            self.hour, self.minute = 1, 0
        elif changes.get("way") == "at" and self.way == "every":
            self.hour, self.minute = 8, 0
        for name, value in changes.items():
            setattr(self, name, value)
        self.minute %= 60
        self.hour = self.hour % 24 if self.way == "at" else max(0, self.hour)
        if self.way == "every" and not self.hour and not self.minute:
            self.minute = 5
        self.task = self._scheduled()
        self.dispatch("on_command", self.task)

    def _scheduled(self) -> ScheduledTask:
        at = f"{int(self.hour):02d}:{int(self.minute):02d}" if self.way == "at" else ""
        every = 0.0 if at else self.hour * 3600.0 + self.minute * 60.0
        was = self.task
        return ScheduledTask(was.id, was.enabled, was.order, at, list(self.days), every, was.next)

    def _mark(self, *_: object) -> None:
        for day, on in zip(self._days, self.days, strict=True):
            day.on = bool(on)
        if (self.way == "at") != (self._week.parent is self):
            (self.add_widget if self.way == "at" else self.remove_widget)(self._week)


def samples() -> dict[str, Callable[[], Widget]]:
    """At a time on working days, every so often, disabled."""

    def make(task: ScheduledTask, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = WhenPicker(size_hint_x=None, width="388dp", **kwargs)
            widget.show(task)
            return widget

        return build

    return {
        "at": make(ScheduledTask(at="22:30", days=[True] * 5 + [False] * 2)),
        "every": make(ScheduledTask(every=5400.0)),
        "disabled": make(ScheduledTask(at="08:00"), state="disabled"),
    }
