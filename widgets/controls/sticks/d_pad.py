"""Four arrows for one thumb: what is touched drives at full, between two of them both, and nothing once it is let go.

pad = DPad(max_speed=0.2, max_yaw_rate=0.6)
pad.bind(on_command=lambda _, twist: drive.command(twist))
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp
from kivy.properties import NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import Twist
from widgets.controls.dead_man import DeadMan
from widgets.controls.sticks.stick_caption import Captioned
from widgets.core.canvas_ink import tint
from widgets.core.geometry import rounded
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["DPad"]

SECTORS = 8
"""Directions: the four arrows, and between each two of them."""
HUB = 0.2
"""Of the half width, round the middle: a finger there commands nothing."""
ARM, REACH = 0.34, 0.97
"""Half the width of an arm and its length from the middle, of the half width."""


class DPad(DeadMan, Captioned):
    """Dispatches `on_command(twist)` at every change: the full speed of its arrows while a finger is on them, else zero.

    It commands zero when the finger is lifted, and when it is disabled, moved, hidden, covered or removed under the finger. Who
    sends repeats `twist` while it is held, and the robot lets it expire: a handheld that died drives nobody.
    """

    sends = (Twist,)
    specificity: ClassVar = 0.9
    drawn_from: ClassVar[tuple[str, ...]] = ("forward", "left", "max_speed", "max_yaw_rate")

    max_speed = NumericProperty(0.2)
    """Forward speed of the arrows [m/s], 0 or more."""
    max_yaw_rate = NumericProperty(0.6)
    """Yaw rate of the arrows [rad/s], 0 or more."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.veil_radius = dp(12)

    @property
    def twist(self) -> Twist:
        """What it commands now."""
        # + 0.0 turns the minus zero of a pad at rest into zero
        return Twist.planar(self.forward * self.max_speed + 0.0, self.left * self.max_yaw_rate + 0.0)

    @property
    def order(self) -> Twist:
        """The same."""
        return self.twist

    @property
    def half(self) -> float:
        """Half the width of its square [px]."""
        return max(1.0, min(self.size) / 2)

    @property
    def reach(self) -> float:
        """From the middle to where an arrow's middle is [px]."""
        return self.half * 0.65

    @property
    def travel(self) -> tuple[float, float]:
        """The same to all sides."""
        return self.half, self.half

    @property
    def caption_drop(self) -> float:
        """Below the square."""
        return float(self.half + dp(8))

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """Full to the nearest of eight directions, nothing on the hub."""
        if math.hypot(forward, left) < HUB:
            return 0.0, 0.0
        sector = round(math.atan2(left, forward) / math.tau * SECTORS) * math.tau / SECTORS
        ahead, aside = math.cos(sector), math.sin(sector)
        return float(np.sign(round(ahead, 3))), float(np.sign(round(aside, 3)))

    def holds(self, x: float, y: float) -> bool:
        """On its square."""
        return abs(x - self.center_x) <= self.half and abs(y - self.center_y) <= self.half

    def draw(self) -> None:
        """The cross, the arms that are pushed, their arrows, the hub."""
        shapes, (x, y), half = Shapes(), self.center, self.half
        rim = theme.outline
        for grown, colour in ((rim, theme.line), (0.0, tint(theme.raised, 1.0))):
            for across in (True, False):
                long, broad = half * REACH + grown, half * ARM + grown
                wide, high = (long, broad) if across else (broad, long)
                corners = rounded(x - wide, y - high, 2 * wide, 2 * high, dp(10) + grown)
                shapes.polygon([(float(px), float(py)) for px, py in corners], colour)
        idle = theme.muted if self.state == "never" else theme.text
        for index, share in enumerate((self.forward, self.left, -self.forward, -self.left)):
            if share > 0:
                shapes.polygon([*self._arm(index)], theme.accent)
            shapes.polygon([*self._arrow(index)], theme.ink_accent if share > 0 else idle)
        shapes.disc(x, y, half * HUB * 0.7, theme.line if not (self.forward or self.left) else theme.accent)
        self._ink.fill(shapes)

    def _turned(self, index: int, points: list[tuple[float, float]]) -> Iterator[tuple[float, float]]:
        """Points as (outward, aside) of the arm `index`: 0 ahead, and on anticlockwise by quarters [px]."""
        yaw = index * math.pi / 2
        for out, aside in points:
            yield (
                self.center_x - out * math.sin(yaw) + aside * math.cos(yaw),
                self.center_y + out * math.cos(yaw) + aside * math.sin(yaw),
            )

    def _arm(self, index: int) -> Iterator[tuple[float, float]]:
        start, end, side = self.half * ARM, self.half * REACH, self.half * ARM
        corners = rounded(-side, start, 2 * side, end - start, dp(10))
        return self._turned(index, [(float(out), float(aside)) for aside, out in corners])

    def _arrow(self, index: int) -> Iterator[tuple[float, float]]:
        tip, size = self.half * 0.84, self.half * 0.17
        return self._turned(index, [(tip, 0.0), (tip - size * 1.6, size), (tip - size * 1.6, -size)])


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, pushed each way, every state."""

    def make(
        forward: float = 0.0, left: float = 0.0, size: float = 220, **kwargs: Any
    ) -> Callable[[], Widget]:
        def build() -> Widget:
            pad = DPad(size_hint=(None, None), size=(dp(size), dp(size)), **kwargs)
            pad.lean(forward, left)
            return pad

        return build

    return {
        "at rest": make(),
        "ahead": make(1.0, 0.0),
        "ahead to the left": make(1.0, 1.0),
        "back": make(-1.0, 0.0),
        "never": make(state="never"),
        "stale": make(state="stale", age=4.0),
        "alarm": make(state="alarm"),
        "disabled": make(state="disabled"),
        "gamepad drives": make(0.0, -1.0, gamepad="drives"),
        "small": make(size=130),
    }
