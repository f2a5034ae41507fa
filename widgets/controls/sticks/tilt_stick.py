"""Stick that tilts what flies: pushed by a finger, or led by the tablet's own tilt while a finger holds it.

class TiltCircle(TiltStick, Gauge): ...
"""

from __future__ import annotations

import math
from typing import Any

from kivy.properties import AliasProperty, BooleanProperty, NumericProperty

from bridge.msgs.pilothouse_msgs import Manoeuvre
from widgets.controls.sticks.stick import Stick
from widgets.core.language import tr

__all__ = ["NEUTRAL_ZONE", "TiltStick"]

NEUTRAL_ZONE = 0.1
"""Of the way to the rim, round the middle: a hand that is not quite still commands nothing."""


class TiltStick(Stick):
    """Dispatches `on_command(manoeuvre)` of the kind `tilt` at every change. Up is nose down, which is ahead for what flies.

    Where it `needs_hold` the tablet leads it, by `steer`, and the finger is the clutch; `on_let_go` is dispatched when it is put to rest.
    """

    __events__ = ("on_let_go",)

    sends = (Manoeuvre,)
    max_tilt = NumericProperty(math.radians(20.0))
    """Roll and pitch together at the rim [rad], above 0."""
    aside = NumericProperty(0.0)
    """How far the circle is to the right, -1 to 1 at the rim; in the ring it commands nothing of that."""
    ahead = NumericProperty(0.0)
    """How far it is up, -1 to 1 at the rim."""
    needs_hold = BooleanProperty(False)
    """The tablet tilts it only while a finger is on it: the finger then says when, and not where to."""
    clutched = BooleanProperty(False)
    """A key or a switch holds it as a finger would."""
    held = BooleanProperty(False)
    """A finger, a key or a switch holds it."""
    dead = NumericProperty(NEUTRAL_ZONE)
    """Within that share of the way to the rim nothing is commanded; drawn as the green ring."""

    def _roll(self) -> float:
        # + 0.0 turns the minus zero of a circle at rest into zero
        return -self.left * self.max_tilt + 0.0

    def _pitch(self) -> float:
        return self.forward * self.max_tilt

    roll = AliasProperty(_roll, bind=["left", "max_tilt"])
    """That it commands [rad], positive right side down."""
    pitch = AliasProperty(_pitch, bind=["forward", "max_tilt"])
    """That it commands [rad], positive nose down."""

    def __init__(self, **kwargs: Any) -> None:
        self._wanted = (0.0, 0.0)
        self._as_is = False
        super().__init__(**kwargs)
        self.fbind("clutched", self._hold)
        self._hold()

    @property
    def order(self) -> Manoeuvre:
        """What it commands now; climb and turn are others' to add."""
        return Manoeuvre(kind="tilt", roll=self._roll(), pitch=self._pitch())

    def shaped(self, forward: float, left: float) -> tuple[float, float]:
        """Nothing in the ring, never beyond the rim."""
        length = math.hypot(forward, left)
        scale = 0.0 if length < self.dead and not self._as_is else 1.0 / max(1.0, length)
        return forward * scale, left * scale

    def tilt(self, roll: float, pitch: float) -> bool:
        """Show that the tablet is tilted by `roll` and `pitch` [rad] from level, and command the same, no farther than the rim.

        False, and nothing is commanded, while it is disabled, while a finger leads it, and, where it `needs_hold`, while none
        holds it; nor is anything shown while a gamepad or a key pushes it. ValueError for what is not finite.
        """
        if not math.isfinite(roll + pitch):
            raise ValueError(
                tr("A tilt is a finite number of radians, not {roll}, {pitch}.").format(
                    roll=roll, pitch=pitch
                )
            )
        at = roll / self.max_tilt, pitch / self.max_tilt
        ahead, left = self.shaped(at[1], -at[0])
        return self.steer(at, (-left, ahead))

    def steer(self, at: tuple[float, float], command: tuple[float, float]) -> bool:
        """Show the circle `at` so far to the right and up, and command `command`, both shares of the way to the rim.

        The dead zone and the curve of `command` are its giver's. Returns and raises as `tilt` does.
        """
        if not math.isfinite(sum(at) + sum(command)):
            raise ValueError(
                tr("A circle is steered by finite shares, not by {at}, {command}.").format(
                    at=at, command=command
                )
            )
        if self.disabled or (self.finger is not None and not self.needs_hold):
            return False
        holds = not self.needs_hold or self.clutched or self.finger is not None
        self._wanted = command
        if not holds and (self.forward or self.left):
            return False  # another input commands, and what is commanded is what is shown
        self._at(at[1], -at[0])
        if holds:
            self._command()
        return holds

    def _command(self) -> None:
        """What the tablet's tilt comes to, as it is."""
        right, ahead = self._wanted
        self._as_is = True
        try:
            super()._push(ahead, -right)
        finally:
            self._as_is = False

    def _hold(self, *_: object) -> None:
        self.held = self.clutched or self.finger is not None

    def follow(self, touch: Any) -> None:
        """Go to where the finger is; where that only says when, command how the tablet is tilted."""
        self._hold()
        if self.needs_hold:
            self._command()
        else:
            super().follow(touch)

    def rest(self) -> None:
        """Let go of the finger, and have a key or a switch let go as well."""
        super().rest()
        self._hold()
        self.dispatch("on_let_go")

    def on_let_go(self) -> None:
        """It was released: the finger was lifted, or control was lost."""

    def spring(self) -> None:
        """Command level; where the tablet tilts it the circle stays where that is."""
        if self.needs_hold and not self.disabled:
            self._wanted = (0.0, 0.0)
            self._command()
        else:
            super().spring()

    def _push(self, forward: float, left: float) -> None:
        self._at(forward, left)
        super()._push(forward, left)

    def _at(self, forward: float, left: float) -> None:
        scale = max(1.0, math.hypot(forward, left))
        self.ahead, self.aside = forward / scale, -left / scale + 0.0
