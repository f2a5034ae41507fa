"""Tasks that the robot offers, one tile each.

chooser = TaskChooser()
chooser.bind(on_command=lambda _, task: form.begin(task))
"""

from __future__ import annotations

import math
from collections.abc import Callable

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the icons
from bridge.msgs.pilothouse_msgs import TaskOrder
from widgets.core.base import Control
from widgets.core.surfaces import Pressable
from widgets.core.task_words import TASKS
from widgets.parts.column import Grid

__all__ = ["TaskChooser"]

MAX_COLUMNS = 4
"""Tiles side by side where there is no room for all."""
MIN_TILE_WIDTH = 68.0
"""A tile needs so much for its word [dp]."""

Builder.load_string("""
<TaskChooser>:
    cols: root.across
    spacing: dp(8)

<TaskTile>:
    orientation: 'vertical'
    size_hint_y: None
    height: max(theme.target, dp(66)) if not root.about else dp(118)
    padding: dp(2), dp(9), dp(2), dp(7)
    spacing: dp(2)
    rim: 'plan' if root.chosen else 'line'
    ground: 'plan' if root.chosen else 'raised'
    press_share: .14
    Icon:
        name: root.icon
        role: 'ink_plan' if root.chosen else 'plan'
        pos_hint: {'center_x': .5}
    Label:
        text: root.text
        font_name: theme.font
        font_size: sp(13.5)
        bold: root.chosen
        color: theme.roles['ink_plan' if root.chosen else 'text']
        disabled_color: self.color
        size_hint_y: 1 if not root.about else None
        height: dp(22)
    Text:
        text: root.about
        role: 'ink_plan' if root.chosen else 'muted'
        font_size: sp(13)
        halign: 'center'
        valign: 'top'
        text_size: self.width - dp(12), dp(52)
        height: dp(52) if root.about else 0
        opacity: 1 if root.about else 0
""")


class TaskTile(Pressable, BoxLayout):
    """One task."""

    icon = StringProperty("route")
    text = StringProperty("")
    about = StringProperty("")
    """What it is for; empty to leave that out."""
    chosen = BooleanProperty(False)


class TaskChooser(Control, Grid):
    """Dispatches `on_command(task)` with the name that TaskOrder has for it."""

    accepts = (TaskOrder,)

    tasks: ListProperty[str] = ListProperty(list(TASKS))
    """Those that are offered."""
    chosen = StringProperty("")
    """The task that stands out; empty for none."""

    told = BooleanProperty(False)
    """Each tile says what its task is for."""

    def _across(self) -> int:
        count = max(1, len(self.tasks))
        if not self.told and self.width >= count * dp(MIN_TILE_WIDTH):
            return count
        return math.ceil(count / math.ceil(count / MAX_COLUMNS))

    across = AliasProperty(_across, bind=["width", "told", "tasks"], cache=True)
    """How many tiles stand side by side: all where there is room, else the same number in each row as far as it goes."""

    def __init__(self, **kwargs: object) -> None:
        self._tiles: dict[str, TaskTile] = {}
        super().__init__(**kwargs)
        self.bind(tasks=self._build, chosen=self._mark, told=self._mark)
        self._build()

    def show(self, msg: TaskOrder) -> None:
        """Mark the task of an order; nothing is dispatched."""
        self.chosen = msg.task

    def choose(self, task: str) -> None:
        """Choose as a finger would; KeyError for a task that is not offered."""
        self.chosen = task if self._tiles[task] else ""
        self.dispatch("on_command", task)

    def _build(self, *_: object) -> None:
        self.clear_widgets()
        self._tiles = {}
        for task in self.tasks:
            words = TASKS[task]
            tile = self._tiles[task] = TaskTile(icon=words.icon, text=words.name)
            tile.bind(on_release=lambda _, task=task: self.choose(task))
            self.add_widget(tile)
        self._mark()

    def _mark(self, *_: object) -> None:
        for task, tile in self._tiles.items():
            tile.chosen = task == self.chosen
            tile.about = TASKS[task].about if self.told else ""


def samples() -> dict[str, Callable[[], Widget]]:
    """None chosen, one chosen, in one row."""

    def make(width: str = "388dp", **kwargs: object) -> Callable[[], Widget]:
        return lambda: TaskChooser(size_hint_x=None, width=width, **kwargs)

    return {
        "none": make(),
        "one": make(chosen="deliver"),
        "told": make("748dp", told=True),
        "row": make("760dp", chosen="guide"),
        "of a swimmer": make(
            tasks=["patrol", "go_to", "go_home", "hold", "follow_heading", "surface"], chosen="surface"
        ),
        "disabled": make(chosen="patrol", state="disabled"),
    }
