"""Which list of the tasks screen is looked at: four groups, some of two lists, and the robot's settings."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, StringProperty

from widgets.core.language import mark, tr
from widgets.parts.column import Column
from widgets.parts.kit import IconButton, Segmented

__all__ = ["GROUPS", "TaskTabs"]

GROUPS = {
    "now": (mark("Now"), {"now": mark("Now")}),
    "schedule": (mark("Schedule"), {"schedule": mark("Schedule")}),
    "places": (mark("Places"), {"places": mark("Places"), "missions": mark("Missions")}),
    "log": (mark("Log"), {"events": mark("Events"), "history": mark("Tasks")}),
}
"""Name of each group to its words and its lists, each with its words; the first one is shown at first."""

Builder.load_string("""
<TaskTabs>:
    spacing: dp(8)
    BoxLayout:
        id: line
        size_hint_y: None
        height: theme.target
        spacing: dp(8)
        Segmented:
            id: groups
            pos_hint: {'center_y': .5}
            font_size: sp(15)
            on_choose: root.choose(args[1])
""")


def group_of(tab: str) -> str:
    """The group that a list belongs to; KeyError for an unknown one."""
    return {one: group for group, (_, lists) in GROUPS.items() for one in lists}[tab]


class TaskTabs(Column):
    """Dispatches `on_settings`."""

    __events__ = ("on_settings",)

    tab = StringProperty("now")
    """The list that is shown."""
    waiting = NumericProperty(0)
    """Events that somebody has to see to: counted where they are listed."""
    has_settings = BooleanProperty(True)
    """The robot's settings can be looked at."""
    at_settings = BooleanProperty(False)
    """They are looked at."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._line, self.groups = self.ids.line.__self__, self.ids.groups.__self__  # kv holds ids weakly
        self.lists = Segmented(font_size="15sp")
        self.lists.bind(on_choose=lambda _, tab: setattr(self, "tab", tab))
        self.gear = IconButton(icon="settings", pos_hint={"center_y": 0.5})
        self.gear.bind(on_release=lambda _: self.dispatch("on_settings"))
        self._last = {group: next(iter(lists)) for group, (_, lists) in GROUPS.items()}
        self.bind(tab=self._show, waiting=self._show, has_settings=self._show, at_settings=self._show)
        self._show()

    def choose(self, group: str) -> None:
        """Show a group as a finger would: the list of it that was looked at last."""
        self.tab = self._last[group]

    def _show(self, *_: object) -> None:
        group = group_of(self.tab)
        self._last[group] = self.tab
        count = f" · {self.waiting:.0f}" if self.waiting else ""
        options = [(one, tr(words) + (count if one == "log" else "")) for one, (words, _) in GROUPS.items()]
        if list(self.groups.options) != options:
            self.groups.options = options
        self.groups.value = group
        lists = [
            (one, tr(words) + (count if one == "events" else "")) for one, words in GROUPS[group][1].items()
        ]
        if list(self.lists.options) != lists:
            self.lists.options = lists
        self.lists.value = self.tab
        if (len(lists) > 1) != (self.lists.parent is self):
            (self.add_widget if len(lists) > 1 else self.remove_widget)(self.lists)
        if self.has_settings != (self.gear.parent is self._line):
            (self._line.add_widget if self.has_settings else self._line.remove_widget)(self.gear)
        self.gear.role = "accent" if self.at_settings else "text"

    def on_settings(self) -> None:
        """A finger asked for the robot's settings."""
