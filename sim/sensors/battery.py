"""A lithium battery that empties with the work done."""

from __future__ import annotations

import msgspec

from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.std_msgs import Header, Time
from sim.backend_bullet import GRAVITY

__all__ = ["Battery", "BatteryParameters"]

_DISCHARGING = 2
_LITHIUM_ION = 2
_SWING = 0.11
"""How far the open voltage is above the nominal when full, and below when empty, as a part of it."""


class BatteryParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[battery]` table of a vehicle's file."""

    rate: float
    capacity: float
    voltage: float
    idle: float
    rolling: float
    efficiency: float
    resistance: float
    charge: float


class Battery:
    """Feeds the computer all the time and the motors as they work."""

    def __init__(self, parameters: BatteryParameters, mass: float) -> None:
        """The battery of a vehicle of `mass` [kg]."""
        self._parameters, self._mass = parameters, mass
        self.charge = parameters.charge
        """0 empty to 1 full; may be set."""
        self._power = parameters.idle
        self._speed = 0.0

    @property
    def empty(self) -> bool:
        """The motors get nothing any more."""
        return self.charge <= 0.0

    def work(self, speed: float, period: float) -> None:
        """Feed `period` [s] of driving that ends at `speed` [m/s]."""
        parameters = self._parameters
        pull = (abs(speed) - abs(self._speed)) / period * self._mass
        resist = parameters.rolling * self._mass * GRAVITY
        motors = max(0.0, resist + pull) * abs(speed) / parameters.efficiency
        self._speed, self._power = speed, parameters.idle + motors
        energy = parameters.capacity * 3600 * parameters.voltage
        self.charge = max(0.0, self.charge - self._power * period / energy)

    def message(self, stamp: float) -> BatteryState:
        """The battery at `stamp` [s]."""
        parameters = self._parameters
        current = self._power / parameters.voltage
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
