"""A lithium battery that empties with the work done."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import msgspec

from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.std_msgs import Header, Time

__all__ = ["Battery", "BatteryParameters"]

_DISCHARGING = 2
_LITHIUM_ION = 2
_SWING = 0.11
"""Open voltage above the nominal when full, and below it when empty, as a part of it."""

Positive = Annotated[float, msgspec.Meta(gt=0)]
Part = Annotated[float, msgspec.Meta(ge=0, le=1)]


class BatteryParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The `[battery]` table of a vehicle's file."""

    rate: Positive
    """[Hz]"""
    capacity: Positive
    """[A h]"""
    voltage: Positive
    """Nominal [V]."""
    idle: Positive
    """Power of computer and sensors [W]."""
    resistance: Positive
    """[ohm]"""
    charge: Part
    """At the beginning; 1 is full."""


class Battery:
    """Feeds the computer all the time and the motors as they work."""

    def __init__(self, parameters: BatteryParameters) -> None:
        """As full as the parameters say."""
        self._parameters = parameters
        self.charge = parameters.charge
        """0 empty to 1 full; may be set."""
        self.power = parameters.idle
        """That it gives [W]."""
        self.others: Callable[[], float] = lambda: 0.0
        """Power of other consumers than computer and motors [W]; may be set."""

    @property
    def empty(self) -> bool:
        """The motors get nothing any more."""
        return self.charge <= 0.0

    def feed(self, motors: float, period: float) -> None:
        """Feed computer and `motors` [W] for `period` [s]."""
        parameters = self._parameters
        self.power = parameters.idle + motors + self.others()
        energy = parameters.capacity * 3600 * parameters.voltage
        self.charge = max(0.0, self.charge - self.power * period / energy)

    def message(self, stamp: float) -> BatteryState:
        """The battery at `stamp` [s]."""
        parameters = self._parameters
        current = self.power / parameters.voltage
        open_voltage = parameters.voltage * (1 + _SWING * (2 * self.charge - 1))
        return BatteryState(
            header=Header(Time.at(stamp), "base_link"),
            voltage=open_voltage - current * parameters.resistance,
            current=-current,
            charge=self.charge * parameters.capacity,
            capacity=parameters.capacity,
            design_capacity=parameters.capacity,
            percentage=self.charge,
            power_supply_status=_DISCHARGING,
            power_supply_technology=_LITHIUM_ION,
        )
