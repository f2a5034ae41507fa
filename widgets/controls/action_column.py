"""Column of large buttons for what a robot can do at once.

column = ActionColumn(actions=[Action("task.surface", "Surface", "water"), Action("lights", "Lights", "lightbulb")])
column.bind(on_action=lambda _, name: commands.ask(name))
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from kivy.clock import Clock
from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    StringProperty,
)
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.rows  # noqa: F401 - its rules draw what is used here
from widgets.core.base import Control, text_texture
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme
from widgets.parts.buttons import PushButton
from widgets.parts.sensor_card import wide

__all__ = ["Action", "ActionColumn"]

MAX_BUTTON_HEIGHT = 104.0
"""Higher ones say nothing more [dp]."""
MIN_FONT_SIZE = 11.0
"""The state stands behind the words where both can be as large as this [sp]."""
MIN_ROW_WIDTH = 176.0
"""A narrower button has its icon above its words, which say all [dp]."""

Builder.load_string("""
#:import spaced widgets.parts.labels.spaced

<ActionColumn>:
    orientation: 'vertical'
    padding: root.inset, root.inset, root.inset, root.inset + root.foot
    spacing: dp(8)
    rim: 'line' if root.framed else ''
    ground: 'surface' if root.framed else ''
    corner: theme.radius
    BoxLayout:
        id: head
        size_hint_y: None
        height: dp(18) if root.titled else 0
        opacity: 1 if root.titled else 0
        Text:
            text: spaced(tr('Actions')) if root.titled else ''
            role: 'muted'
            font_size: sp(12)
            size_hint_x: None
            width: sp(76)
            pos_hint: {'center_y': .5}
        Text:
            text: spaced(root.hint) if root.titled else ''
            role: 'muted'
            font_size: sp(12)
            halign: 'right'
            shorten: True
            shorten_from: 'right'
            pos_hint: {'center_y': .5}
    Roll:
        id: roll
        Grid:
            id: grid
            cols: root.across
            spacing: dp(9)
            padding: dp(2)

<ActionKey>:
    size_hint_y: None
    height: root.high
    anchor_x: 'left' if root.flow == 'horizontal' else 'center'
    padding: (dp(14), 0, dp(14) + root.taken + (dp(10) if root.taken else 0), 0) if root.flow == 'horizontal' else (dp(8), 0, dp(8), 0)
    canvas.after:
        Color:
            rgba: theme.muted
        Rectangle:
            pos: self.right - dp(14) - root.taken, self.center_y - root.end_texture.height / 2
            size: (root.end_texture.width, root.end_texture.height) if root.taken else (0, 0)
            texture: root.end_texture
""")


@dataclass(frozen=True, slots=True)
class Action:
    """One button."""

    name: str
    """What `on_action` says."""
    text: str
    icon: str = ""
    able: bool = True
    """It can be asked for now."""
    said: str = ""
    """How it stands, in a word at the button's end, as in `on`; empty for nothing."""
    meaning: str = ""
    """What a press does, where that changes; half a second after a change no finger is taken."""


class ActionKey(PushButton):
    """One of them."""

    high = NumericProperty("52dp")
    end = StringProperty("")
    """At its end; empty for nothing."""
    name = StringProperty("")
    """What it stands for, in words."""
    said = StringProperty("")
    """How that stands: at its end, or behind its words where it is narrow and has room for both."""

    def _end_texture(self) -> Texture:
        return text_texture(self.end, sp(13), theme.font, bold=True)

    end_texture = AliasProperty(_end_texture, bind=["end"], cache=True)

    def _taken(self) -> float:
        return float(self.end_texture.width) if self.end and self.flow == "horizontal" else 0.0

    taken = AliasProperty(_taken, bind=["end_texture", "flow"], cache=True)
    """Width of what is at its end [px]."""


class ActionColumn(Outlined, Control, BoxLayout):
    """Dispatches `on_action(name)`, and `on_command` with the same."""

    __events__ = ("on_action",)

    veiled = False

    actions: ListProperty[Action] = ListProperty()
    """`Action` after `Action`, from the top."""
    hint = StringProperty("")
    """How else they can be worked, at the end of its title, as in `Tab next · Enter do it`; empty for nothing."""
    across = NumericProperty(1)
    """How many buttons stand side by side."""
    titled = BooleanProperty(True)
    """Says over the buttons what they are."""
    framed = BooleanProperty(True)
    """Is a card of its own."""
    inset = NumericProperty("12dp")
    """From its edge to the buttons [px]."""
    foot = NumericProperty(0)
    """Kept free at its lower end for something else [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._buttons: dict[str, ActionKey] = {}
        super().__init__(**kwargs)
        self._fitting = Clock.create_trigger(self._fit, -1)
        self.roll, self.grid = self.ids.roll.__self__, self.ids.grid.__self__  # kv holds ids weakly
        for name in ("actions", "state"):
            self.fbind(name, self._write)
        for name in ("across", "titled", "foot", "inset", "size"):
            self.fbind(name, self._fitting)
        self.roll.bind(size=self._fitting)
        self._write()

    # what a finger does

    def _press(self, name: str) -> None:
        self.dispatch("on_action", name)
        self.dispatch("on_command", name)

    def on_action(self, name: str) -> None:
        """Somebody asked for the action of that name."""

    # what is where

    def _write(self, *_: object) -> None:
        names = [action.name for action in self.actions]
        if list(self._buttons) != names:
            self.grid.clear_widgets()
            self._buttons = {name: self._make(name) for name in names}
            self._fitting()
        for action in self.actions:
            button = self._buttons[action.name]
            button.name, button.icon, button.said = action.text, action.icon, action.said
            button.meaning = action.meaning or action.text
            button.disabled = not action.able or self.state == "disabled"
        self._update()

    def _make(self, name: str) -> ActionKey:
        button = ActionKey()
        button.bind(on_release=lambda _: self._press(name))
        self.grid.add_widget(button)
        return button

    def _update(self) -> None:
        count = max(1, round(self.across))
        room = (self.roll.width - (count - 1) * self.grid.spacing[0]) / count - dp(20)
        for button in self._buttons.values():
            button.end = button.said
            both = f"{button.name} · {button.said}"
            beside = button.flow == "horizontal" or not button.said
            cut = wide(both, sp(MIN_FONT_SIZE), bold=True) > room
            button.text = button.name if beside or cut else both

    def _fit(self, *_: object) -> None:
        """Share the height out, within what a finger needs and what looks like a button."""
        count = len(self._buttons)
        if not count or not self.roll.height:
            return
        across = max(1, round(self.across))
        rows, between = -(-count // across), self.grid.spacing[1]
        room = self.roll.height - self.grid.padding[1] - self.grid.padding[3] - between * (rows - 1)
        high = max(theme.target, min(room / rows, dp(MAX_BUTTON_HEIGHT)))
        wide = (self.roll.width - (across - 1) * between) / across
        for button in self._buttons.values():
            button.high, button.flow = high, "vertical" if wide < dp(MIN_ROW_WIDTH) else "horizontal"
        self._update()


def samples() -> dict[str, Callable[[], Widget]]:
    """Plain and with a hint, some that cannot be asked for, side by side, none of them, disabled."""
    some = [
        Action("task.surface", "Surface", "water"),
        Action("task.hold", "Hold depth", "pause_circle", said="4.5 m"),
        Action("record", "Start recording", "fiber_manual_record_fill"),
        Action("task.follow_heading", "Follow heading", "explore", able=False),
        Action("lights", "Lights", "lightbulb_fill", said="on"),
        Action("task.go_home", "Go home", "home"),
    ]

    def make(**kwargs: Any) -> Callable[[], Widget]:
        return lambda: ActionColumn(
            **{"actions": some, "size_hint": (None, None), "size": (dp(292), dp(470)), **kwargs}
        )

    return {
        "fingers": make(),
        "switches": make(hint="Tab next · Enter do it"),
        "none able": make(actions=[Action("a", "Surface", "water", able=False)]),
        "two across": make(across=2, titled=False, size=(dp(300), dp(220))),
        "narrow": make(titled=False, size=(dp(150), dp(300))),
        "disabled": make(state="disabled"),
    }
