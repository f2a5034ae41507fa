"""Crosshair that moves in steps and marks the place of the next touch, for hands that cannot point.

cross = Crosshair(at=(120, 80), holds=True)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty, ListProperty
from kivy.uix.widget import Widget

import widgets.core.theme  # noqa: F401 - its rules name the roles

__all__ = ["Crosshair"]

Builder.load_string("""
#:set CROSS_ARM 30
#:set CROSS_GAP 7

<Crosshair>:
    size_hint: None, None
    size: dp(2 * CROSS_ARM), dp(2 * CROSS_ARM)
    canvas:
        Color:
            rgba: theme.surface
        SmoothLine:
            points: self.x, self.center_y, self.center_x - dp(CROSS_GAP), self.center_y
            width: dp(4)
        SmoothLine:
            points: self.center_x + dp(CROSS_GAP), self.center_y, self.right, self.center_y
            width: dp(4)
        SmoothLine:
            points: self.center_x, self.y, self.center_x, self.center_y - dp(CROSS_GAP)
            width: dp(4)
        SmoothLine:
            points: self.center_x, self.center_y + dp(CROSS_GAP), self.center_x, self.top
            width: dp(4)
        SmoothLine:
            circle: self.center_x, self.center_y, dp(CROSS_GAP + 12)
            width: dp(4)
        Color:
            rgba: theme.danger if root.holds else theme.accent
        SmoothLine:
            points: self.x, self.center_y, self.center_x - dp(CROSS_GAP), self.center_y
            width: dp(2)
        SmoothLine:
            points: self.center_x + dp(CROSS_GAP), self.center_y, self.right, self.center_y
            width: dp(2)
        SmoothLine:
            points: self.center_x, self.y, self.center_x, self.center_y - dp(CROSS_GAP)
            width: dp(2)
        SmoothLine:
            points: self.center_x, self.center_y + dp(CROSS_GAP), self.center_x, self.top
            width: dp(2)
        SmoothLine:
            circle: self.center_x, self.center_y, dp(CROSS_GAP + 12)
            width: dp(2)
        Color:
            rgba: theme.danger if root.holds else (0, 0, 0, 0)
        SmoothEllipse:
            pos: self.center_x - dp(4), self.center_y - dp(4)
            size: dp(8), dp(8)
""")


class Crosshair(Widget):
    """Takes no finger; its middle is the place."""

    at: ListProperty[float] = ListProperty([0.0, 0.0])
    """Where it points [px, window]."""
    holds = BooleanProperty(False)
    """It has taken hold of what was there."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.fbind("at", self._go)
        self._go()

    def _go(self, *_: object) -> None:
        self.center = self.at

    def collide_point(self, x: float, y: float) -> bool:
        """Fingers go through it."""
        return False


def samples() -> dict[str, Callable[[], Widget]]:
    """Pointing, and holding what it was on."""

    def make(**kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            ground = Widget(size_hint=(None, None), size=(dp(120), dp(120)))
            cross = Crosshair(**kwargs)
            ground.add_widget(cross)
            ground.bind(center=lambda _, at: setattr(cross, "at", at))
            cross.at = ground.center
            return ground

        return build

    return {"points": make(), "holds": make(holds=True)}
