"""Tasks that the robot offers, one tile each.

chooser = TaskChooser()
chooser.bind(on_command=lambda _, task: form.begin(task))
"""

from __future__ import annotations

import math
from collections.abc import Callable

from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, ListProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the icons
from bridge.msgs.pilothouse_msgs import TaskOrder
from widgets.core.base import Control, fitting_size
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
    height: max(theme.target, dp(66), dp(20) + sign.height + root.type_size * 1.3) if not root.about else max(dp(118), self.minimum_height)
    padding: dp(2), dp(9), dp(2), dp(7)
    spacing: dp(2)
    rim: 'plan' if root.chosen else 'line'
    ground: 'plan' if root.chosen else 'raised'
    press_share: .14
    Icon:
        id: sign
        name: root.icon
        font_size: min(theme.size_icon, dp(30))
        role: 'ink_plan' if root.chosen else 'plan'
        pos_hint: {'center_x': .5}
    FittedLabel:
        text: root.text
        largest: root.type_size
        room: max(root.width - dp(6), 1)
        bold: root.chosen
        color: theme.roles['ink_plan' if root.chosen else 'text']
        disabled_color: self.color
        size_hint_y: 1 if not root.about else None
        height: max(dp(22), root.type_size * 1.3)
    Text:
        text: root.about
        role: 'ink_plan' if root.chosen else 'muted'
        font_size: sp(13)
        halign: 'center'
        valign: 'top'
        text_size: self.width - dp(12), None
        height: max(dp(52), self.texture_size[1]) if root.about else 0
        opacity: 1 if root.about else 0
""")


class TaskTile(Pressable, BoxLayout):
    """One task."""

    icon = StringProperty("route")
    text = StringProperty("")
    about = StringProperty("")
    """What it is for; empty to leave that out."""
    chosen = BooleanProperty(False)
    type_size = NumericProperty("13.5sp")
    """Of its word [px]."""


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
        self.bind(tasks=self._build, chosen=self._mark, told=self._mark, width=self._fit, across=self._fit)
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
        self._fit()

    def _fit(self, *_: object) -> None:
        """One size of type for all words."""
        across = self.across
        room = (self.width - (across - 1) * dp(8)) / across - dp(8)
        size = fitting_size([tile.text for tile in self._tiles.values()], sp(13.5), max(room, 1.0), bold=True)
        for tile in self._tiles.values():
            tile.type_size = size

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
