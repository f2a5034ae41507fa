"""A lithium battery that empties with the work done, and fills while a charger feeds it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated

import msgspec

from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.std_msgs import Header, Time

__all__ = ["FULL_CURRENT", "RESUME_CHARGE", "Battery", "BatteryParameters"]

_CHARGING = BatteryState.POWER_SUPPLY_STATUS_CHARGING
_DISCHARGING = BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
_NOT_CHARGING = BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING
_FULL = BatteryState.POWER_SUPPLY_STATUS_FULL
_LITHIUM_ION = BatteryState.POWER_SUPPLY_TECHNOLOGY_LION
_SWING = 0.11
"""Open voltage above the nominal when full, and below it when empty, as a part of it."""
FULL_CURRENT = 0.02
"""It counts as full when it takes less current at the highest voltage than would fill it in 1 / this [h]."""
RESUME_CHARGE = 0.95
"""One that was full and is held at the charger counts as charging again below this, 0 to 1."""

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
    """Feeds the computer all the time and the motors as they work.

    A charger gives constant current until the battery's voltage is the highest, then constant voltage, so that the current
    falls; it feeds the consumers first, and gives no more power than it has.
    """

    def __init__(self, parameters: BatteryParameters, charging_current: float = math.inf) -> None:
        """As full as the parameters say; it takes at most the `charging_current` [A]."""
        self._parameters = parameters
        self._limit = charging_current
        self.charge = parameters.charge
        """0 empty to 1 full; may be set."""
        self.power = parameters.idle
        """That all consumers take [W]."""
        self.others: Callable[[], float] = lambda: 0.0
        """Power of other consumers than computer and motors [W]; may be set."""
        self.current = -parameters.idle / parameters.voltage
        """Into it [A]; below 0 out of it."""
        self.status = _DISCHARGING
        """One of BatteryState's POWER_SUPPLY_STATUS_…."""
        self._supply: float | None = None
        self._told = _DISCHARGING

    @property
    def empty(self) -> bool:
        """The motors get nothing any more."""
        return self.charge <= 0.0

    @property
    def changed(self) -> bool:
        """Its status is another than that of its last message."""
        return self.status != self._told

    @property
    def open_voltage(self) -> float:
        """Without any current [V]."""
        return self._parameters.voltage * (1 + _SWING * (2 * self.charge - 1))

    def connect(self, supply: float | None) -> None:
        """A charger that has `supply` [W] to give touches its contacts from now on; 0 for one without current, None for none."""
        if supply != self._supply:
            self._supply = supply
            self._take()

    def feed(self, motors: float, period: float) -> None:
        """Feed computer and `motors` [W] for `period` [s], and fill it from the charger, if there is one."""
        parameters = self._parameters
        self.power = parameters.idle + motors + self.others()
        self._take()
        self.charge += self.current * period / (3600 * parameters.capacity)
        self.charge = min(1.0, max(0.0, self.charge))

    def message(self, stamp: float) -> BatteryState:
        """The battery at `stamp` [s]."""
        parameters = self._parameters
        self._told = self.status
        return BatteryState(
            header=Header(Time.at(stamp), "base_link"),
            voltage=self.open_voltage + self.current * parameters.resistance,
            current=self.current,
            charge=self.charge * parameters.capacity,
            capacity=parameters.capacity,
            design_capacity=parameters.capacity,
            percentage=self.charge,
            power_supply_status=self.status,
            power_supply_technology=_LITHIUM_ION,
        )

    def _take(self) -> None:
        """Current and status from what the consumers take and the charger has."""
        spare = (self._supply or 0.0) - self.power
        if self._supply is None or spare <= 0.0:
            self.current = spare / self._parameters.voltage
            self.status = _DISCHARGING if self._supply is None else _NOT_CHARGING
            return
        self.current, falling = self._taken(spare)
        done = falling and self.current < FULL_CURRENT * self._parameters.capacity
        full = done or (self.status == _FULL and self.charge > RESUME_CHARGE)
        self.status = _FULL if full else _CHARGING

    def _taken(self, spare: float) -> tuple[float, bool]:
        """Current that it takes from `spare` power [W], in [A], and whether the highest voltage is what limits it."""
        parameters, now = self._parameters, self.open_voltage
        highest = parameters.voltage * (1 + _SWING)
        of_voltage = max(0.0, highest - now) / parameters.resistance
        of_power = (math.sqrt(now * now + 4 * parameters.resistance * spare) - now) / (
            2 * parameters.resistance
        )
        taken = min(self._limit, of_power, of_voltage)
        return taken, taken == of_voltage
