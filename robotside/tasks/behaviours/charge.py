"""Charging: the robot stays at its dock until the battery has enough, then goes on."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.notice import Notice
from robotside.navigation.navigator import Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.situation import Situation

__all__ = ["MIN_CHARGE", "Charge", "too_little"]

MIN_CHARGE = 0.2
"""With less than this it does not go on, whoever asks for it, 0 to 1: it would come back at once."""

LOST_TIMEOUT = 10.0
"""Without charge for so long it has lost the dock [s]."""

QUIET_TIME, SILENCE_TIMEOUT = 10.0, 30.0
"""A battery that was not heard for so long is said to be silent; after so long nobody knows whether it charges [s]."""

MIN_GAIN = 0.005
"""From so much more charge on it is known how long the rest takes, 0 to 1."""


def too_little(charge: float) -> Notice | None:
    """Why a robot with that charge, 0 to 1, does not go on; None where it does, NaN included: nobody knows better than who asks."""
    if not charge < MIN_CHARGE:
        return None
    said = f"Charging goes on: {charge:.0%} is too little to go on with; {MIN_CHARGE:.0%} is needed."
    return Notice(Code.CHARGE_NEEDED, said, charge=charge, needed=MIN_CHARGE)


class Charge(Behaviour):
    """Succeeds with the charge that is wanted, or when an operator has it go on; fails when the dock gives none any more, or the battery is silent."""

    def __init__(
        self,
        until: float,
        place: str,
        navigator: Navigator,
        situation: Situation,
        say: Say,
        lean: float = math.nan,
    ) -> None:
        """`until` is the charge that it goes on with, 0 to 1; `place` is the dock's name.

        `lean` is the push [m/s] by which one that nothing holds stays at its contacts, at its depth; NaN for one that stands.
        """
        super().__init__("charge")
        self._until, self._place = until, place
        self._navigator, self._situation, self._say = navigator, situation, say
        self._began = self._charged = self._heard = 0.0
        self._first = self._height = math.nan
        self._lean = lean

    def initialise(self) -> None:
        """Stand there."""
        self._navigator.rest()
        self._situation.forget_confirmation()
        self._began = self._charged = self._situation.worked
        self._first, self._heard = self._situation.charge, self._situation.now
        self._height = self._navigator.height

    def update(self) -> Status:
        """Wait."""
        now = self._situation
        if not math.isnan(self._lean):
            self._navigator.command(Manoeuvre(kind="course", speed=self._lean, height=self._height))
        full = now.power == BatteryState.POWER_SUPPLY_STATUS_FULL
        if full or now.charge >= self._until - 1e-6 or self._sent_on():
            return Status.SUCCESS
        silent = now.now - max(self._heard, now.battery_heard)
        if silent > QUIET_TIME:
            return self._silent(silent)
        if now.charging:
            self._charged = now.worked
        if now.worked - self._charged > LOST_TIMEOUT:
            said = f"{self._place} charges no more at {now.charge:.0%}; the robot stands there."
            self._navigator.reason = Notice(Code.CHARGE_LOST, said, place=self._place, charge=now.charge)
            return Status.FAILURE
        left = self.left
        about = f" in about {max(1, round(left / 60))} min" if math.isfinite(left) else ""
        text = f"Charging at {self._place}, {now.charge:.0%}, goes on at {self._until:.0%}{about}."
        if math.isnan(now.charge):
            text = f"Charging at {self._place}, until it is full."
        told = Notice(Code.CHARGING, text, place=self._place, charge=now.charge, until=self._until)
        now.report("charging", told, place=self._place, still=left, touches=True)
        return Status.RUNNING

    def _silent(self, seconds: float) -> Status:
        """The battery was not heard for `seconds` [s]: what it said before is no longer so."""
        now, place = self._situation, self._place
        said = f"{place}: the battery has been silent for {seconds:.0f} s, so nobody knows whether it charges"
        if seconds > SILENCE_TIMEOUT:
            stands = f"{said}; the robot stands there."
            self._navigator.reason = Notice(Code.CHARGE_UNKNOWN, stands, place=place, seconds=seconds)
            return Status.FAILURE
        told = Notice(Code.CHARGE_UNKNOWN, f"{said}.", place=place, seconds=seconds)
        now.report("charging", told, place=place, still=math.nan, touches=True)
        return Status.RUNNING

    @property
    def left(self) -> float:
        """How long it still charges at the pace up to now [s]; NaN while that is not known."""
        now = self._situation
        gained, spent = now.charge - self._first, now.worked - self._began
        if not (gained >= MIN_GAIN and spent > 0):
            return math.nan
        return max(0.0, self._until - now.charge) * spent / gained

    def _sent_on(self) -> bool:
        """An operator has it go on, and there is charge for it."""
        now = self._situation
        if not now.confirmed_by:
            return False
        if short := too_little(now.charge):
            self._say("battery", short, "warn")
            return False
        said = f"{now.confirmed_by} had it go on at {now.charge:.0%}."
        self._say("battery", Notice(Code.CHARGE_CUT, said, name=now.confirmed_by, charge=now.charge), "info")
        return True
