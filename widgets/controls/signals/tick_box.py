"""Box to tick for a bool of a robot: a tap asks for the other value, and the tick is there when the robot says so.

box = TickBox(title="Avoid obstacles")
robot.on("/avoidance/on", box.show)
box.bind(on_command=lambda _, msg: robot.publish("/avoidance/set", msg))
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from kivy.metrics import dp, sp
from kivy.uix.widget import Widget

from bridge.msgs.std_msgs import Bool
from widgets.controls.signals.bool_control import Switchable
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word
from widgets.core.geometry import rounded
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["TickBox"]

SIDE = 28
"""Of the box [dp]."""


class TickBox(Switchable):
    """A box with a tick for on, empty for off, with a bar while that is not known; its name beside it."""

    specificity = 0.9

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The box at the left, its name and what is known beside it."""
        side, left = dp(SIDE), self.x + self.edge + dp(2)
        low, middle = self.center_y - side / 2, left + side / 2
        wanted = self.value if self.asked is None else self.asked
        done = bool(wanted) and self.asked is None  # what is only asked for is not filled
        live = done or self.pressed or self.asked is not None
        self._square(shapes, left, low, side, theme.accent if live else theme.muted)
        if not done:
            rim = dp(2.5 if self.pressed else 2)
            self._square(shapes, left + rim, low + rim, side - 2 * rim, theme.surface)
        ink = theme.ink_accent if done else theme.accent if wanted else theme.muted
        if wanted:
            points = [(left + side * 0.24, low + side * 0.5), (left + side * 0.43, low + side * 0.3)]
            shapes.line(np.array([*points, (left + side * 0.78, low + side * 0.7)]), dp(3.2), ink)
        elif wanted is None:
            reach = side * 0.22
            shapes.line(
                np.array([(middle - reach, self.center_y), (middle + reach, self.center_y)]), dp(3), ink
            )
        yield from self._names(left + side + dp(12), self.right - self.edge)

    def _square(self, shapes: Shapes, left: float, low: float, side: float, colour: Any) -> None:
        corners = rounded(left, low, side, side, dp(6))
        shapes.polygon([(float(x), float(y)) for x, y in corners], colour)

    def _names(self, left: float, right: float) -> Iterator[Word]:
        room, quiet = right - left, self.outcome == "" and self.asked is None and self.value is not None
        rise = 0.0 if quiet else sp(9)
        size = fitting_size([self.title], sp(16), room, bold=True)
        yield Word(self.title, left, self.center_y + rise, size, theme.text, bold=True, anchor=(0, 0.5))
        if not quiet:
            size = fitting_size([self.word], sp(13.5), room)
            yield Word(self.word, left, self.center_y - sp(11), size, theme.roles[self.role], anchor=(0, 0.5))


def samples() -> dict[str, Callable[[], Widget]]:
    """Ticked, empty, asked for, without an answer, every state."""

    def make(value: bool | None = None, **more: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            box = TickBox(size_hint=(None, None), size=(dp(240), dp(60)), title="Avoid obstacles", **more)
            if value is not None:
                box.show(Bool(value))
            return box

        return build

    def asked() -> Widget:
        box = TickBox(size_hint=(None, None), size=(dp(240), dp(60)), title="Avoid obstacles", value=False)
        box.ask(True)
        return box

    return {
        "never": make(state="never"),
        "ticked": make(True),
        "empty": make(False),
        "asked": asked,
        "no reply": make(False, outcome="no_reply"),
        "stale": make(True, state="stale", age=5.0),
        "alarm": make(True, state="alarm"),
        "disabled": make(True, state="disabled"),
        "pressed": make(False, pressed=True),
    }
