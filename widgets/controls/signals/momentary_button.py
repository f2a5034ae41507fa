"""Button that is true for as long as a finger is on it, such as a horn or a winch.

horn = MomentaryButton(title="Horn")
horn.bind(on_command=lambda _, msg: robot.publish("/horn", msg))
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.metrics import dp, sp
from kivy.properties import NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.std_msgs import Bool
from widgets.controls.signals.bool_control import BoolControl
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word
from widgets.core.geometry import rounded
from widgets.core.icons import icon
from widgets.core.language import tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["SEND_PERIOD", "MomentaryButton"]

SEND_PERIOD = 0.1
"""Between two messages while it is held [s]."""


class MomentaryButton(BoolControl):
    """Dispatches `on_command(Bool(True))` when a finger comes down and every `period` while it stays, `Bool(False)` once after.

    False follows when the finger is lifted or slides off, and when the button is disabled, moved, hidden, covered or removed
    under it. A False that is lost on the way is not said again: what listens takes a silence of 0.5 s for false, and so does
    a robot whose link is cut.
    """

    accepts: ClassVar = (Bool,)
    at_rest: ClassVar = Bool(False)
    specificity: ClassVar = 0.8
    drawn_from: ClassVar = (*BoolControl.drawn_from, "icon")

    icon = StringProperty("touch_app")
    """Name of its icon."""
    period = NumericProperty(SEND_PERIOD)
    """Between two messages while it is held [s]."""

    def __init__(self, **kwargs: Any) -> None:
        self._again = Clock.schedule_interval(self._send, SEND_PERIOD)
        self._again.cancel()
        super().__init__(**kwargs)
        self.fbind("pressed", self._on_pressed)
        self.fbind("period", self._on_period)
        self._on_period()

    def show(self, msg: Bool) -> None:
        """The robot says whether it does it."""
        self.value = bool(msg.data)

    def follow(self, touch: Any) -> None:
        """Pressed for as long as the finger is on it; slid off it, it stays released until a finger comes down anew."""
        if self.holds(*touch.pos):
            self.pressed = True
        else:
            self.rest()

    def _on_pressed(self, *_: object) -> None:
        if self.pressed:
            self._again()
        else:
            self._again.cancel()
        self.dispatch("on_command", Bool(self.pressed))

    def _on_period(self, *_: object) -> None:
        self._again.timeout = self.period

    def _send(self, _: float) -> None:
        self._look()
        if self.pressed:
            self.dispatch("on_command", Bool(True))

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The button, filled while it is held; its icon, its name, and that it wants to be held."""
        inset = dp(6)
        corners = rounded(
            self.x + inset, self.y + inset, self.width - 2 * inset, self.height - 2 * inset, dp(12)
        )
        shapes.polygon(
            [(float(x), float(y)) for x, y in corners], theme.accent if self.pressed else theme.raised
        )
        ink = theme.ink_accent if self.pressed else theme.text
        at, y = self.x + inset + dp(28), self.center_y
        sign = ink if self.pressed else theme.muted if self.state == "never" else theme.accent
        yield Word(icon(self.icon), at, y, sp(26), sign, font=theme.icons)
        left, right = at + dp(24), self.right - inset - dp(26)
        room = right - left
        size = fitting_size([self.title], sp(17), room, bold=True)
        yield Word(self.title, left, y + sp(9), size, ink, bold=True, anchor=(0, 0.5))
        said = tr("sending") if self.pressed else tr("not heard yet") if self.state == "never" else tr("hold")
        yield Word(said, left, y - sp(11), sp(13), ink if self.pressed else theme.muted, anchor=(0, 0.5))
        if self.value is not None:  # what the robot says of it: filled for true
            x, radius = self.right - inset - dp(16), dp(6)
            shapes.ring(x, y, radius, dp(1.5), ink)
            if self.value:
                shapes.disc(x, y, radius, ink)


def samples() -> dict[str, Callable[[], Widget]]:
    """At rest, held, every state."""

    def make(value: bool | None = None, **more: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            button = MomentaryButton(
                size_hint=(None, None), size=(dp(220), dp(76)), title="Horn", icon="volume_up", **more
            )
            if value is not None:
                button.show(Bool(value))
            return button

        return build

    return {
        "never": make(state="never"),
        "at rest": make(),
        "held": make(True, pressed=True),
        "robot says off": make(False),
        "stale": make(False, state="stale", age=5.0),
        "alarm": make(True, state="alarm"),
        "disabled": make(state="disabled"),
    }
