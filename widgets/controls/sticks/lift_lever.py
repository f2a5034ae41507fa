"""Lever for one thumb: up climbs, down descends; it springs back when released.

lever = LiftLever(max_climb=0.3)
lever.bind(on_command=lambda _, twist: drive.command(twist))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp
from kivy.properties import NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import Twist, Vector3
from widgets.controls.sticks.stick import DEAD_ZONE
from widgets.controls.sticks.stick_caption import Captioned
from widgets.core.canvas_ink import tint
from widgets.core.geometry import Points
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["LiftLever"]


class LiftLever(Captioned):
    """Dispatches `on_command(twist)` at every change: a climb and nothing else."""

    sends = (Twist,)
    specificity: ClassVar = 0.5
    drawn_from: ClassVar[tuple[str, ...]] = ("forward", "left", "max_climb")

    max_climb = NumericProperty(0.3)
    """Speed up at its upper end [m/s], 0 or more."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.fbind("size", self._round_veil)
        self._round_veil()

    def _round_veil(self, *_: object) -> None:
        self.veil_radius = self.width / 2

    @property
    def caption_drop(self) -> float:
        """Between the knob at rest and the arrow."""
        return float((self.knob_radius + self.height / 2 - dp(16)) / 2)

    @property
    def order(self) -> Twist:
        """What it commands now."""
        return Twist(Vector3(0.0, 0.0, self.forward * self.max_climb + 0.0), Vector3())

    @property
    def knob_radius(self) -> float:
        """[px]"""
        return min(self.width * 0.36, theme.target * 0.6)

    @property
    def travel(self) -> tuple[float, float]:
        """Up and down only."""
        return 1.0, max(1.0, self.height / 2 - self.knob_radius - dp(8))

    @property
    def knob_pos(self) -> tuple[float, float]:
        """The knob's middle [px]."""
        return self.center_x, self.center_y + self.forward * self.travel[1]

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """Nothing near the middle, never beyond its ends, and nothing aside."""
        return (0.0 if abs(forward) < DEAD_ZONE else max(-1.0, min(1.0, forward))), 0.0

    def holds(self, x: float, y: float) -> bool:
        """Anywhere on it."""
        return bool(self.collide_point(x, y))

    def draw(self) -> None:
        """The slot with its ends, the way from the middle to the knob, the knob."""
        shapes, (x, y), radius = Shapes(), self.center, self.width / 2 - dp(1)
        up = self.height / 2 - radius - dp(1)
        ends = np.array([(x, y - up), (x, y + up)])
        if self.bare:
            self._rail(shapes, ends, radius)
        else:
            for width, colour in ((radius * 2, theme.line), (radius * 2 - dp(3), theme.surface)):
                shapes.line(ends, width, colour)
                for _, end in ends:
                    shapes.disc(x, end, width / 2, colour)
        line = self.glassy(theme.text) if self.bare else theme.line
        shapes.line(np.array([(x - radius * 0.4, y), (x + radius * 0.4, y)]), dp(1.5), line)
        for sign, share in ((1.0, self.forward), (-1.0, -self.forward)):
            tip, size = y + sign * (self.height / 2 - dp(8)), radius * 0.26
            corners = [(x, tip), (x - size, tip - sign * size * 1.3), (x + size, tip - sign * size * 1.3)]
            rest = self.glassy(theme.text) if self.bare else theme.muted
            shapes.polygon(corners, theme.accent if share > DEAD_ZONE else rest)
        knob = self.knob_pos
        if self.forward:
            shapes.line(np.array([self.center, knob]), dp(5), theme.accent)
        self.draw_knob(shapes, knob, self.knob_radius, theme.accent)
        self._ink.fill(shapes)

    def _rail(self, shapes: Shapes, ends: Points, radius: float) -> None:
        """The way of the knob over a picture: a faint line."""
        for width, colour in ((dp(4), tint(theme.surface, 0.3)), (dp(1.5), self.glassy(theme.text))):
            for side in (-radius, radius):
                shapes.line(ends + np.array((side * 0.8, 0.0)), width, colour)


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, pushed up and down, disabled."""

    def make(forward: float = 0.0, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            lever = LiftLever(**{"size_hint": (None, None), "size": ("84dp", "200dp"), **kwargs})
            lever.lean(forward, 0.0)
            return lever

        return build

    return {
        "at rest": make(),
        "up": make(0.7),
        "down": make(-1.0),
        "captioned": make(caption="climb"),
        "disabled": make(state="disabled"),
        "bare": make(bare=True),
        "bare, up": make(0.7, bare=True),
        "small": make(size=("60dp", "120dp")),
    }
