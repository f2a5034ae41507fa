"""Lamp for one bool of a robot: filled and named for true, hollow for false.

lamp = Lamp(title="Door open")
robot.on("/door/open", lamp.show)
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, ClassVar

from kivy.metrics import dp, sp
from kivy.properties import ObjectProperty, OptionProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs import Msg
from bridge.msgs.std_msgs import Bool
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, tint
from widgets.core.field_paths import value_at
from widgets.core.language import DASH, mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.fields.field_kinds import TRUTH
from widgets.parts.sensor_card import Gauge

__all__ = ["Lamp"]


class Lamp(Gauge):
    """A bool of any message: the shape and the word say it, the colour only helps."""

    accepts: ClassVar = (Msg,)
    shows_fields: ClassVar = (TRUTH,)
    grid_size: ClassVar = (2, 2)
    drawn_from: ClassVar = ("value", "role", "true_word", "false_word")

    path = StringProperty("data")
    """Field of the message, as in `limits.left`."""
    value: ObjectProperty[bool | None] = ObjectProperty(None, allownone=True)
    """What the robot said last; None before that."""
    role = OptionProperty("ok", options=["ok", "warn", "danger", "accent"])
    """Role of its colour while it is on."""
    true_word = StringProperty(mark("on"))
    """What is said of true."""
    false_word = StringProperty(mark("off"))
    """What is said of false."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.veil_radius = self.card_corner

    def show(self, msg: Msg) -> None:
        """Take the field at `path`; AttributeError when the message has no such field."""
        self.value = bool(value_at(msg, self.path))

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The lamp, its name, and what it says."""
        known = self.value if self.state != "never" else None
        radius = min(dp(15), self.height * 0.22)
        x, y = self.x + self.edge + radius + dp(2), self.center_y
        colour = theme.roles[self.role] if known else theme.muted
        if known:
            shapes.disc(x, y, radius * 1.35, tint(colour, 0.25))
            shapes.disc(x, y, radius * 0.86, colour)
        shapes.ring(x, y, radius, dp(2), colour, dashes=0 if known is not None else 10)
        left = x + radius + dp(12)
        room = self.right - self.edge - left - (dp(20) if self.alarmed else 0)
        word = DASH if known is None else tr(self.true_word if known else self.false_word)
        rise = sp(10) if self.title else 0.0
        yield Word(
            word,
            left,
            y - (sp(8) if self.title else 0),
            fitting_size([word], sp(19), room, bold=True),
            theme.text if known else theme.muted,
            bold=True,
            anchor=(0, 0.5),
        )
        size = fitting_size([self.title], sp(13), room)
        yield Word(self.title, left, y + rise + sp(3), size, theme.muted, anchor=(0, 0.5))


def samples() -> dict[str, Callable[[], Widget]]:
    """On in each colour, off, every state."""

    def make(value: bool | None = None, **more: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            lamp = Lamp(
                size_hint=(None, None), size=(dp(170), dp(72)), **{"title": "Door", "state": "live", **more}
            )
            if value is not None:
                lamp.show(Bool(value))
            return lamp

        return build

    return {
        "never": make(state="never"),
        "on": make(True),
        "off": make(False),
        "bad": make(True, role="danger", title="Water inside", true_word="leak", false_word="dry"),
        "warns": make(True, role="warn", title="Motors", true_word="hot", false_word="cool"),
        "stale": make(True, state="stale", age=12.0),
        "alarm": make(True, state="alarm"),
        "disabled": make(True, state="disabled"),
    }
