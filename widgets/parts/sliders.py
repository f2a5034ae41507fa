"""Sliders: the progress of something, or an amount to set."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import (
    AliasProperty,
    NumericProperty,
    StringProperty,
)
from kivy.uix.widget import Widget

from widgets.core.surfaces import Outlined

__all__ = ["Fader", "Progress"]

Builder.load_string("""
<Progress>:
    size_hint_y: None
    height: dp(10)
    corner: self.height / 2
    canvas.before:
        Rounded:
            rgba: theme.roles[root.role] if self.filled else (0, 0, 0, 0)
            pos: self.pos
            size: max(self.filled, self.height), self.height
            radius: [self.height / 2]

<Fader>:
    size_hint_x: None
    width: max(dp(88), theme.target)
    canvas:
        Rounded:
            rgba: theme.line
            pos: self.center_x - dp(6), self.low
            size: dp(12), self.high - self.low
            radius: [dp(6)]
        Rounded:
            rgba: theme.accent
            pos: self.center_x - dp(6), self.low
            size: dp(12), max(self.knob_y - self.low, dp(12))
            radius: [dp(6)]
        Color:
            rgba: theme.accent
        SmoothEllipse:
            pos: self.center_x - dp(20), self.knob_y - dp(20)
            size: dp(40), dp(40)
        Color:
            rgba: theme.knob
        SmoothEllipse:
            pos: self.center_x - dp(17), self.knob_y - dp(17)
            size: dp(34), dp(34)
""")


class Progress(Outlined, Widget):
    """How far something is."""

    value = NumericProperty(math.nan)
    """0 to 1; NaN when it is not known, drawn as an empty bar."""
    role = StringProperty("plan")
    """Role of the filled part."""

    def _filled(self) -> float:
        return 0.0 if math.isnan(self.value) else max(0.0, min(1.0, self.value)) * self.width

    filled = AliasProperty(_filled, bind=["value", "width"], cache=True)
    """Length of the filled part [px]."""


class Fader(Widget):
    """An upright slide for how much, such as the greatest speed; dispatches `on_change`."""

    __events__ = ("on_change",)

    value = NumericProperty(0.0)
    minimum = NumericProperty(0.0)
    maximum = NumericProperty(1.0)
    step = NumericProperty(0.0)
    """`value` is a multiple of this from `minimum`; 0 for any."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._finger: Any = None

    def _low(self) -> float:
        return self.y + dp(20)

    low = AliasProperty(_low, bind=["pos"], cache=True)
    """Where `minimum` lies [px]."""

    def _high(self) -> float:
        return self.top - dp(20)

    high = AliasProperty(_high, bind=["pos", "size"], cache=True)
    """Where `maximum` lies [px]."""

    def _normalized(self) -> float:
        span = self.maximum - self.minimum
        return max(0.0, min(1.0, (self.value - self.minimum) / span)) if span > 0 else 0.0

    value_normalized = AliasProperty(_normalized, bind=["value", "minimum", "maximum"], cache=True)
    """`value` from 0 (`minimum`) to 1 (`maximum`)."""

    def _knob_y(self) -> float:
        return self.low + self.value_normalized * (self.high - self.low)

    knob_y = AliasProperty(_knob_y, bind=["value_normalized", "low", "high"], cache=True)

    def _set_from(self, y: float) -> None:
        share = max(0.0, min(1.0, (y - self.low) / max(1.0, self.high - self.low)))
        value = self.minimum + share * (self.maximum - self.minimum)
        if self.step:
            value = min(self.maximum, self.minimum + round((value - self.minimum) / self.step) * self.step)
        if value != self.value:
            self.value = value
            self.dispatch("on_change", value)

    def on_touch_down(self, touch: Any) -> bool:
        """The knob comes to the finger."""
        if self.disabled or self._finger is not None or not self.collide_point(*touch.pos):
            return bool(super().on_touch_down(touch))
        touch.grab(self)
        self._finger = touch
        self._set_from(touch.y)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """And follows it."""
        if touch.grab_current is self:
            self._set_from(touch.y)
            return True
        return bool(super().on_touch_move(touch))

    def on_touch_up(self, touch: Any) -> bool:
        """It stays where it was left."""
        if touch.grab_current is self:
            touch.ungrab(self)
            self._finger = None
            return True
        return bool(super().on_touch_up(touch))

    def on_change(self, value: float) -> None:
        """A finger set `value`."""


def samples() -> dict[str, Callable[[], Widget]]:
    """A bar and a slide at several amounts."""
    wide = {"size_hint_x": None, "width": "330dp"}
    return {
        "progress": lambda: Progress(value=0.38, **wide),
        "progress done": lambda: Progress(value=1.0, role="ok", **wide),
        "progress unknown": lambda: Progress(**wide),
        "fader": lambda: Fader(value=0.6, size_hint_y=None, height="180dp"),
        "fader low": lambda: Fader(size_hint_y=None, height="180dp"),
    }
