"""The wait at a dock for the battery to tell whether it takes charge."""

from __future__ import annotations

import math

from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.notice import Notice
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing import dock_outcomes

__all__ = ["CONTACT_TIMEOUT", "DockContact"]

CONTACT_TIMEOUT = 6.0
"""In contact, the battery tells within so long whether it takes charge [s]; usual ones tell once a second."""

SILENCE_TIMEOUT = 15.0
"""In contact with a battery that is silent, it waits for so long to hear from it [s]."""

DEAD_TIME = 3.0
"""A charger that gives nothing for so long, contact made, is dead [s]."""


class DockContact:
    """Of a robot that touches the dock of that `name`."""

    def __init__(self, name: str, situation: Situation, within: float = CONTACT_TIMEOUT) -> None:
        """`situation` has what the battery says; in contact it tells `within` so long whether it takes charge [s]."""
        self._name, self._situation, self._within = name, situation, within
        self._since, self._dead = 0.0, math.inf

    def begin(self) -> None:
        """It touches from now on."""
        self._since, self._dead = self._situation.worked, math.inf

    @property
    def meet(self) -> bool:
        """The contacts meet, but there is no current."""
        return self._situation.power == BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING

    def outcome(self, by: str) -> Notice | None:
        """Why there is no charge, None while there may still be one; call it often. `by` is what the robot went by.

        Another try makes sense for `Code.DOCK_MISSED` only.
        """
        now, spent = self._situation, self._situation.worked - self._since
        self._dead = min(self._dead, now.worked) if self.meet else math.inf
        if now.worked - self._dead > DEAD_TIME:
            return dock_outcomes.dead(self._name)
        heard = now.now - now.battery_heard
        if heard > CONTACT_TIMEOUT:
            return dock_outcomes.silent(self._name, heard) if spent > SILENCE_TIMEOUT else None
        if spent > self._within and not self.meet:
            return dock_outcomes.no_contact(self._name, by)
        return None
