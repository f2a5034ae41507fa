"""What a battery said of its charger, and for how long that holds."""

from __future__ import annotations

import pytest

from bridge.msgs.sensor_msgs import BatteryState
from robotside.autonomy.power_supply import POWER_TIMEOUT, PowerSupply

UNKNOWN = BatteryState.POWER_SUPPLY_STATUS_UNKNOWN
CHARGING = BatteryState.POWER_SUPPLY_STATUS_CHARGING


def said(status: int) -> PowerSupply:
    supply = PowerSupply()
    supply.on_battery(BatteryState(power_supply_status=status), 100.0)
    return supply


def test_a_battery_that_was_never_heard_does_not_charge() -> None:
    assert PowerSupply().status(0.0) == UNKNOWN
    assert not PowerSupply().charging(0.0)


@pytest.mark.parametrize(
    ("status", "charges"),
    [
        (CHARGING, True),
        (BatteryState.POWER_SUPPLY_STATUS_FULL, True),
        (BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING, False),
        (BatteryState.POWER_SUPPLY_STATUS_DISCHARGING, False),
        (UNKNOWN, False),
    ],
)
def test_it_charges_while_it_takes_charge_and_when_it_is_full(status: int, charges: bool) -> None:
    assert said(status).charging(100.0 + POWER_TIMEOUT) is charges


def test_a_battery_that_is_silent_for_long_says_nothing_any_more() -> None:
    supply = said(CHARGING)
    assert supply.status(100.1 + POWER_TIMEOUT) == UNKNOWN
    assert not supply.charging(100.1 + POWER_TIMEOUT)
    supply.on_battery(BatteryState(power_supply_status=CHARGING), 200.0)
    assert supply.charging(201.0)


def test_a_jump_of_the_clock_is_no_silence() -> None:
    supply = said(CHARGING)
    supply.skip(50.0)
    assert supply.charging(150.0 + POWER_TIMEOUT)
