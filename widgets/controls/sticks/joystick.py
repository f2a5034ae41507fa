"""Stick for one thumb: forward drives, sideways turns; it springs back when released.

stick = Joystick(max_speed=0.5, max_yaw_rate=1.5)
stick.bind(on_command=lambda _, twist: drive.command(twist))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp
from kivy.properties import AliasProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import Twist
from widgets.controls.sticks.stick import DEAD_ZONE
from widgets.controls.sticks.stick_caption import Captioned
from widgets.core.canvas_ink import tint
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["DEAD_ZONE", "Joystick"]

BELOW = 0.6
"""From the middle down to the caption, of the radius: on the inner ring, between the knob at rest and the arrow."""


class Joystick(Captioned):
    """Dispatches `on_command(twist)` at every change. It follows the finger that came down on it and no other."""

    sends = (Twist,)
    drawn_from: ClassVar[tuple[str, ...]] = ("forward", "left", "max_speed", "max_yaw_rate")

    max_speed = NumericProperty(0.5)
    """Forward speed at the rim [m/s], 0 or more."""
    max_yaw_rate = NumericProperty(1.0)
    """Yaw rate at the rim [rad/s], 0 or more."""

    @property
    def caption_drop(self) -> float:
        """On the inner ring."""
        return float(BELOW * min(self.size) / 2)

    def _reach(self) -> float:
        return float(max(1.0, min(self.size) / 2 - self.knob_radius - dp(6)))

    def _knob_radius(self) -> float:
        return min(min(self.size) * 0.18, theme.target)

    knob_radius = AliasProperty(_knob_radius, bind=["size"], cache=True)
    """[px]"""
    reach = AliasProperty(_reach, bind=["size"], cache=True)
    """From the middle to where the knob's middle can be at most [px]."""

    def _knob_pos(self) -> tuple[float, float]:
        return self.center_x - self.left * self.reach, self.center_y + self.forward * self.reach

    knob_pos = AliasProperty(_knob_pos, bind=["left", "forward", "reach", "pos", "size"], cache=True)
    """The knob's middle [px]."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.fbind("size", self._round_veil)
        self._round_veil()

    def _round_veil(self, *_: object) -> None:
        self.veil_radius = min(self.size) / 2

    def _twist(self) -> Twist:
        # + 0.0 turns the minus zero of a stick at rest into zero
        return Twist.planar(self.forward * self.max_speed + 0.0, self.left * self.max_yaw_rate + 0.0)

    twist = AliasProperty(_twist, bind=["forward", "left", "max_speed", "max_yaw_rate"])
    """What the stick commands now."""

    @property
    def order(self) -> Twist:
        """The same."""
        return self._twist()

    @property
    def travel(self) -> tuple[float, float]:
        """The same to all sides."""
        return self.reach, self.reach

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """Nothing near the middle, never beyond the rim."""
        length = math.hypot(forward, left)
        scale = 0.0 if length < DEAD_ZONE else 1.0 / max(1.0, length)
        return forward * scale, left * scale

    def holds(self, x: float, y: float) -> bool:
        """On the round."""
        return math.dist((x, y), self.center) <= min(self.size) / 2

    def draw(self) -> None:
        """The pad, its arrows, the way from the middle to the knob, the knob."""
        shapes, radius, (x, y) = Shapes(), min(self.size) / 2 - dp(1), self.center
        pushed = self.forward or self.left
        if self.bare:
            shapes.ring(x, y, radius - dp(2), dp(4), tint(theme.surface, 0.3))
        else:
            shapes.disc(x, y, radius, tint(theme.surface, 0.88))
            shapes.ring(x, y, radius * 0.6, dp(1.5), theme.line, dashes=36)
        rim = theme.text if self.bare else theme.line
        shapes.ring(x, y, radius - dp(0.75 if not self.bare else 2), dp(1.5), self.glassy(rim))
        for index, share in enumerate((self.forward, self.left, -self.forward, -self.left)):
            ink = theme.accent if share > DEAD_ZONE else self.glassy(rim if self.bare else theme.muted)
            shapes.polygon(self._arrow(index, radius), ink)
        knob = self.knob_pos
        if pushed:
            shapes.line(np.array([self.center, knob]), dp(5), theme.accent)
        self.draw_knob(shapes, knob, self.knob_radius, theme.accent)
        self._ink.fill(shapes)

    def _arrow(self, index: int, radius: float) -> list[tuple[float, float]]:
        """A triangle that points outward: 0 ahead, and on anticlockwise by quarters."""
        yaw, size, tip = index * math.pi / 2, radius * 0.075, radius * 0.9
        ahead, aside = (-math.sin(yaw), math.cos(yaw)), (math.cos(yaw), math.sin(yaw))
        corners = ((tip, 0.0), (tip - size * 1.7, size), (tip - size * 1.7, -size))
        return [
            (self.center_x + a * ahead[0] + b * aside[0], self.center_y + a * ahead[1] + b * aside[1])
            for a, b in corners
        ]


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, pushed each way, disabled."""

    def make(forward: float = 0.0, left: float = 0.0, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            stick = Joystick(size_hint=(None, None), size=("242dp", "242dp"), **kwargs)
            stick.lean(forward, left)
            return stick

        return build

    return {
        "at rest": make(),
        "ahead to the right": make(0.8, -0.35),
        "back": make(-0.6, 0.0),
        "disabled": make(state="disabled"),
        "climbs": make(caption="climb · turn"),
        "gamepad there": make(gamepad="ready"),
        "gamepad drives": make(0.7, 0.2, gamepad="drives"),
        "gamepad silent": make(gamepad="silent"),
        "gamepad must be let go": make(gamepad="let go"),
        "bare": make(bare=True),
        "bare, pushed": make(0.8, -0.35, bare=True),
        "bare, disabled": make(bare=True, state="disabled"),
        "small": lambda: Joystick(size_hint=(None, None), size=("140dp", "140dp")),
    }
