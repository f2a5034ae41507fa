"""Base of controls that send a `std_msgs/Bool`: what the robot says of it, what was asked for, and what became of that.

class Lamp(BoolControl):
    def marks(self, shapes): ...
"""

from __future__ import annotations

from typing import Any, ClassVar

from kivy.clock import Clock
from kivy.properties import BooleanProperty, ObjectProperty

from bridge.msgs.std_msgs import Bool
from widgets.controls.dead_man import DeadMan
from widgets.core.language import DASH, mark, tr
from widgets.parts.sensor_card import Gauge

__all__ = ["REPLY_TIMEOUT", "BoolControl", "Switchable"]

REPLY_TIMEOUT = 3.0
"""How long the robot has to say that it did what was asked [s]."""
ON, OFF = mark("on"), mark("off")


class BoolControl(DeadMan, Gauge):
    """A named bool of the robot under a finger. `show` takes what the robot says of it, `on_command` carries what is asked."""

    sends = (Bool,)
    to_topic: ClassVar = True
    at_rest: ClassVar[Bool | None] = None
    """What ends that which it sends while it is held; None for one that asks once."""
    grid_size: ClassVar = (3, 2)
    drawn_from: ClassVar[tuple[str, ...]] = ("value", "pressed")

    value: ObjectProperty[bool | None] = ObjectProperty(None, allownone=True)
    """What the robot said last; None before that."""
    pressed = BooleanProperty(False)
    """A finger is on it."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.veil_radius = self.card_corner

    def holds(self, x: float, y: float) -> bool:
        """Anywhere on it."""
        return bool(self.collide_point(x, y))

    def follow(self, touch: Any) -> None:
        """It is pressed."""
        self.pressed = True

    def spring(self) -> None:
        """It is pressed no longer."""
        self.pressed = False


class Switchable(BoolControl):
    """Asks for the other value when a finger is lifted on it; slid off it, or let go of otherwise, asks for nothing.

    It shows as done only what the robot says. `confirmed=False` is for a robot that says nothing of it: then what was sent is
    shown.
    """

    accepts: ClassVar = (Bool,)
    drawn_from: ClassVar = (*BoolControl.drawn_from, "asked", "outcome", "confirmed")

    confirmed = BooleanProperty(True)
    """The robot says by `show` what became of it."""
    asked: ObjectProperty[bool | None] = ObjectProperty(None, allownone=True)
    """What was asked for and not seen yet; None for nothing."""
    outcome = ObjectProperty("")
    """`sent`, `no_reply`, `unsent` or empty."""

    def __init__(self, **kwargs: Any) -> None:
        self._give_up = Clock.create_trigger(self._no_reply, REPLY_TIMEOUT)
        super().__init__(**kwargs)

    def show(self, msg: Bool) -> None:
        """The robot says how it is."""
        self.value = bool(msg.data)
        if self.asked is not None and self.value == self.asked:
            self._settle("")

    def show_unsent(self) -> None:
        """What was asked for never left."""
        if self.asked is not None:
            self._settle("unsent")

    def on_touch_up(self, touch: Any) -> bool:
        """Ask for the other value where the finger is lifted on it."""
        meant = touch.grab_current is self and touch is self.finger and self.holds(*touch.pos)
        meant = meant and not self.disabled and self.visible_to_finger and not self.occluded
        taken = super().on_touch_up(touch)
        if meant:
            self.ask(not self.value)
        return taken

    def ask(self, value: bool) -> None:
        """Ask the robot for `value`."""
        if self.confirmed:
            self.asked, self.outcome = value, "sent"
            self._give_up()
        else:
            self.value = value
        self.dispatch("on_command", Bool(value))

    def _no_reply(self, *_: object) -> None:
        self._settle("no_reply")

    def _settle(self, outcome: str) -> None:
        self._give_up.cancel()
        self.asked, self.outcome = None, outcome

    @property
    def word(self) -> str:
        """What is known of it, in a word or two."""
        if self.asked is not None:
            return tr("asked for {value}").format(value=tr(ON if self.asked else OFF))
        if self.outcome == "no_reply":
            return tr("no reply")
        if self.outcome == "unsent":
            return tr("not sent")
        if self.value is None:
            return DASH
        return tr(ON if self.value else OFF)

    @property
    def role(self) -> str:
        """Role of the word's colour."""
        if self.outcome in ("no_reply", "unsent"):
            return "warn"
        return "accent" if self.asked is not None else "text" if self.value else "muted"
