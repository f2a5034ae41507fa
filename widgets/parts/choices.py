"""Choices: one of several, on or off."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.animation import Animation
from kivy.lang import Builder
from kivy.metrics import Metrics, dp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    StringProperty,
)
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.label import Label
from kivy.uix.widget import Widget

from widgets.core.base import fitting_size, text_texture
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme

__all__ = ["Segmented", "Toggle"]

Builder.load_string("""
<Segmented>:
    size_hint_y: None
    height: max(dp(46), theme.least + 2 * theme.outline)
    padding: theme.outline

<Segment>:
    font_name: theme.font
    font_size: root.text_size_px
    bold: self.chosen
    color: theme.ink_accent if self.chosen else theme.text
    disabled_color: self.color
    halign: 'center'
    valign: 'middle'
    text_size: self.width - dp(8), self.height
    canvas.before:
        Rounded:
            rgba: theme.accent if self.chosen else (theme.text[:3] + [.12 if self.state == 'down' else 0])
            pos: self.pos
            size: self.size
            radius: self.radii
        Color:
            rgba: theme.line if not self.first else (0, 0, 0, 0)
        Rectangle:
            pos: self.x - theme.outline / 2, self.y
            size: theme.outline, self.height

<Toggle>:
    size_hint: None, None
    size: max(dp(54), theme.target), theme.target
    canvas:
        Rounded:
            rgba: theme.accent if self.active else theme.muted
            pos: self.track_pos
            size: dp(54), dp(31)
            radius: [dp(15.5)]
        Rounded:
            rgba: theme.accent if self.active else theme.raised
            pos: self.track_pos[0] + dp(1.5), self.track_pos[1] + dp(1.5)
            size: dp(51), dp(28)
            radius: [dp(14)]
        Color:
            rgba: theme.knob if self.active else theme.muted
        SmoothEllipse:
            pos: self.track_pos[0] + dp(3.5) + dp(23) * self.travel, self.track_pos[1] + dp(3.5)
            size: dp(24), dp(24)
        Rounded:
            rgba: theme.surface[:3] + [.62 if root.disabled else 0]
            pos: self.track_pos
            size: dp(54), dp(31)
            radius: [dp(15.5)]
""")


class Segment(ButtonBehavior, Label):
    """One of the choices of a `Segmented`."""

    chosen = BooleanProperty(False)
    first = BooleanProperty(False)
    """Has no line before it."""
    radii: ListProperty[float] = ListProperty([0, 0, 0, 0])
    """Of its corners [px]: only the ends of the row are round."""
    text_size_px = NumericProperty("16sp")


class Segmented(Outlined, BoxLayout):
    """One of a few choices, all in sight. `options` are `(value, words)` or just words."""

    __events__ = ("on_choose",)

    options = ListProperty()
    value = StringProperty("")
    """The chosen one; empty or unknown when none is."""
    font_size = NumericProperty("16sp")
    """Of the words [px]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.bind(options=self._rebuild, value=self._mark, font_size=self._fit, width=self._fit)
        theme.bind(corner=self._rebuild)
        self._rebuild()

    def _rebuild(self, *_: object) -> None:
        self.clear_widgets()
        pairs = [option if isinstance(option, list | tuple) else (option, option) for option in self.options]
        self._values = [value for value, _ in pairs]
        for index, (value, words) in enumerate(pairs):
            segment = Segment(text=words, first=index == 0)
            segment.radii = self._corners(index, len(pairs))
            segment.bind(on_release=lambda _, value=value: self.choose(value))
            self.add_widget(segment)
        self._fit()
        self._mark()

    def _fit(self, *_: object) -> None:
        """One size of type for all, at which the longest words keep clear of the lines even when they are bold."""
        room = self.width / max(len(self.children), 1) - max(dp(10), dp(18) / Metrics.fontscale)
        size = fitting_size([segment.text for segment in self.children], self.font_size, room, bold=True)
        widths = [text_texture(one.text, size, theme.font, bold=True).width for one in self.children]
        crowded = max(widths, default=0) > room  # then the longest has more than an even part
        for segment, wide in zip(self.children, widths, strict=True):
            segment.text_size_px = size
            segment.size_hint_x = wide + dp(10) if crowded else 1

    def _corners(self, index: int, count: int) -> list[float]:
        left = theme.corner - 1 if index == 0 else 0
        right = theme.corner - 1 if index == count - 1 else 0
        return [left, right, right, left]

    def _mark(self, *_: object) -> None:
        for value, segment in zip(self._values, reversed(self.children), strict=True):
            segment.chosen = value == self.value

    def choose(self, value: str) -> None:
        """Take `value` as a finger would, and say so when it was another one."""
        if value != self.value:
            self.value = value
            self.dispatch("on_choose", value)

    def on_choose(self, value: str) -> None:
        """A finger chose `value`."""


class Toggle(ButtonBehavior, Widget):
    """On or off; dispatches `on_change`."""

    __events__ = ("on_change",)

    active = BooleanProperty(False)
    travel = NumericProperty(0.0)
    """Of the knob, 0 off to 1 on."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.travel = float(self.active)
        self.bind(active=self._move)

    def _track_pos(self) -> tuple[float, float]:
        return self.center_x - dp(54) / 2, self.center_y - dp(31) / 2

    track_pos = AliasProperty(_track_pos, bind=["pos", "size"])

    def _move(self, *_: object) -> None:
        Animation.cancel_all(self, "travel")
        Animation(travel=float(self.active), d=0.12, t="out_quad").start(self)

    def on_release(self) -> None:
        """Change over."""
        self.active = not self.active
        self.dispatch("on_change", self.active)

    def on_change(self, active: bool) -> None:
        """A finger switched it."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Each choice in the states that it knows."""
    motions = [("loop", "Loop"), ("random", "Random"), ("intermittent", "Intermittent")]
    wide = {"size_hint_x": None, "width": "330dp"}
    return {
        "segmented": lambda: Segmented(options=motions, value="loop", **wide),
        "segmented last": lambda: Segmented(options=motions, value="intermittent", **wide),
        "toggle on": lambda: Toggle(active=True),
        "toggle off": Toggle,
        "toggle disabled": lambda: Toggle(active=True, disabled=True),
    }
