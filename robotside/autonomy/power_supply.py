"""What a battery says of its charger, for as long as it is heard."""

from __future__ import annotations

import math

from bridge.msgs.sensor_msgs import BatteryState

__all__ = ["POWER_TIMEOUT", "PowerSupply"]

POWER_TIMEOUT = 10.0
"""A battery that was silent for longer tells nothing of a charge any more [s]; usual ones tell once a second."""

_CHARGING = (BatteryState.POWER_SUPPLY_STATUS_CHARGING, BatteryState.POWER_SUPPLY_STATUS_FULL)


class PowerSupply:
    """Takes what the battery says; times are of the robot's clock [s]."""

    def __init__(self) -> None:
        self._status, self._heard = BatteryState.POWER_SUPPLY_STATUS_UNKNOWN, -math.inf

    def on_battery(self, msg: BatteryState, now: float) -> None:
        """The battery was heard."""
        self._status, self._heard = msg.power_supply_status, now

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing could be heard."""
        self._heard += seconds

    def status(self, now: float) -> int:
        """As `power_supply_status` of `sensor_msgs/BatteryState`; unknown once the battery is silent."""
        silent = now - self._heard > POWER_TIMEOUT
        return BatteryState.POWER_SUPPLY_STATUS_UNKNOWN if silent else self._status

    def charging(self, now: float) -> bool:
        """It takes charge, or is full at the charger."""
        return self.status(now) in _CHARGING
