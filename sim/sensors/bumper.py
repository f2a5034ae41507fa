"""A bumper ring, and the count of the bumps."""

from __future__ import annotations

import math

from bridge.msgs.pilothouse_msgs import Bumper
from bridge.msgs.std_msgs import Header, Time
from sim.core.constants import STEPS_PER_SECOND
from sim.core.shapes import rotate_back
from sim.physics.backend_bullet import Contact, State

__all__ = ["BumperRing"]

HOLD_STEPS = STEPS_PER_SECOND // 10
"""Steps that the ring stays pressed after the last contact: a body pushed against a wall chatters."""
MIN_OFFSET = 0.05
"""Contacts that are in the mean nearer to its middle than this are above or below it and have no bearing [m]."""
SEPARATE_STEPS = STEPS_PER_SECOND // 2
"""Steps without contact after which touching the same thing again is another bump."""


class BumperRing:
    """Contacts of a vehicle's shell, updated after every step."""

    def __init__(self) -> None:
        """A ring that touches nothing."""
        self.bumps = 0
        """Distinct bumps so far."""
        self.changed = False
        """Pressed or released since `message` was last called."""
        self._pressed = False
        self._bearing = math.nan
        self._last = -SEPARATE_STEPS
        self._touched: dict[int, int] = {}

    def update(self, step: int, contacts: list[Contact], state: State | None) -> None:
        """Update with the contacts after `step`; `state` may be None when there are none."""
        if contacts and state is not None:
            self._press(step, contacts, state)
        elif self._pressed and step - self._last > HOLD_STEPS:
            self._pressed, self._bearing, self.changed = False, math.nan, True

    def message(self, stamp: float) -> Bumper:
        """The ring at `stamp` [s]."""
        self.changed = False
        return Bumper(Header(Time.at(stamp), "base_link"), self._pressed, self._bearing)

    def _press(self, step: int, contacts: list[Contact], state: State) -> None:
        for contact in contacts:
            if step - self._touched.get(contact.body, -SEPARATE_STEPS) >= SEPARATE_STEPS:
                self.bumps += 1
            self._touched[contact.body] = step
        self._last = step
        middle = (sum(places) / len(contacts) for places in zip(*(c.position for c in contacts), strict=True))
        x, y, z = (there - here for there, here in zip(middle, state.position, strict=True))
        ahead, left, _ = rotate_back(state.rotation, (x, y, z))
        self._bearing = math.atan2(left, ahead) if math.hypot(ahead, left) > MIN_OFFSET else math.nan
        if not self._pressed:
            self._pressed, self.changed = True, True
