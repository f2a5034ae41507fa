"""Charging against the closed forms of a battery with a linear open voltage: constant current, then constant voltage."""

from __future__ import annotations

import itertools
import math

import pytest

from bridge.msgs.sensor_msgs import BatteryState
from sim.sensors.battery import FULL_CURRENT, Battery, BatteryParameters

CAPACITY, VOLTAGE, RESISTANCE, IDLE, LIMIT = 4.4, 14.8, 0.15, 9.0, 2.2
HIGHEST, SLOPE = 1.11 * VOLTAGE, 0.22 * VOLTAGE
"""The highest voltage, and by how much the open one rises from empty to full [V]."""
PERIOD = 0.05
CHARGING, DISCHARGING, NOT_CHARGING, FULL = (
    BatteryState.POWER_SUPPLY_STATUS_CHARGING,
    BatteryState.POWER_SUPPLY_STATUS_DISCHARGING,
    BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING,
    BatteryState.POWER_SUPPLY_STATUS_FULL,
)


def battery(charge, limit=LIMIT):
    own = BatteryParameters(
        rate=1.0, capacity=CAPACITY, voltage=VOLTAGE, idle=IDLE, resistance=RESISTANCE, charge=charge
    )
    return Battery(own, limit)


def time_to(charge, start, limit=LIMIT):
    """Closed form of the time that charging from `start` to `charge` takes with power enough [s]."""
    knee = 1 - limit * RESISTANCE / SLOPE
    """Where the battery's voltage is the highest with all of the current."""
    even = max(0.0, min(charge, knee) - start) * 3600 * CAPACITY / limit
    after = max(start, knee)
    falling = (
        RESISTANCE * 3600 * CAPACITY / SLOPE * math.log((1 - after) / (1 - charge)) if charge > after else 0.0
    )
    return even + falling


def charge_until(cell, done, longest=20 * 3600):
    steps = 0
    while not done() and steps * PERIOD < longest:
        cell.feed(0.0, PERIOD)
        steps += 1
    return steps * PERIOD


@pytest.mark.parametrize("start", [0.0, 0.1, 0.5])
def test_it_takes_the_time_of_the_closed_form_to_80_percent(start):
    cell = battery(start)
    cell.connect(300.0)
    assert charge_until(cell, lambda: cell.charge >= 0.8) == pytest.approx(time_to(0.8, start), rel=0.01)


@pytest.mark.parametrize(("start", "limit"), [(0.2, 2.2), (0.92, 2.2), (0.5, 6.0)])
def test_it_takes_the_time_of_the_closed_form_until_it_is_full(start, limit):
    cell = battery(start, limit)
    cell.connect(300.0)
    taken = charge_until(cell, lambda: cell.status == FULL)
    last = 1 - FULL_CURRENT * CAPACITY * RESISTANCE / SLOPE
    assert taken == pytest.approx(time_to(last, start, limit), rel=0.01)
    assert cell.charge == pytest.approx(last, abs=1e-4)
    assert f"{cell.charge:.0%}" == "100%"


def test_current_is_even_first_and_falls_when_the_voltage_is_the_highest():
    cell = battery(0.5)
    cell.connect(300.0)
    told = []
    while cell.status != FULL:
        for _ in range(1200):
            cell.feed(0.0, PERIOD)
        told.append(cell.message(0.0))
    assert told[0].current == pytest.approx(LIMIT)
    assert all(a.current >= b.current - 1e-9 for a, b in itertools.pairwise(told))
    assert max(message.voltage for message in told) == pytest.approx(HIGHEST, rel=1e-5)
    assert told[-1].current < 0.05 * LIMIT
    assert [message.percentage for message in told] == sorted(message.percentage for message in told)


def test_what_the_charger_gives_is_stored_lost_in_the_resistance_or_used():
    """The stored energy is the integral of the open voltage over the charge, which is linear."""
    cell, given, lost = battery(0.15), 0.0, 0.0
    cell.connect(300.0)
    while cell.status != FULL:
        cell.feed(0.0, PERIOD)
        current = cell.current
        given += (cell.open_voltage + current * RESISTANCE) * current * PERIOD
        lost += current * current * RESISTANCE * PERIOD
    mean = VOLTAGE * (1 + 0.11 * (0.15 + cell.charge - 1))
    stored = (cell.charge - 0.15) * 3600 * CAPACITY * mean
    assert stored + lost == pytest.approx(given, rel=0.01)
    assert lost > 0.005 * given


@pytest.mark.parametrize("motors", [0.0, 15.0])
def test_a_weak_charger_feeds_the_consumers_first_and_gives_no_more_than_it_has(motors):
    cell = battery(0.4)
    cell.connect(30.0)
    cell.feed(motors, PERIOD)
    told = cell.message(0.0)
    assert told.voltage * told.current + IDLE + motors == pytest.approx(30.0)
    assert told.power_supply_status == CHARGING


def test_one_that_needs_more_than_the_charger_has_gives_the_rest_itself():
    cell = battery(0.4)
    cell.connect(20.0)
    cell.feed(40.0, PERIOD)
    told = cell.message(0.0)
    assert told.current == pytest.approx(-(IDLE + 40.0 - 20.0) / VOLTAGE)
    assert told.power_supply_status == NOT_CHARGING


def test_a_charger_without_current_does_not_charge_and_says_so():
    cell = battery(0.4)
    cell.connect(0.0)
    cell.feed(0.0, PERIOD)
    told = cell.message(0.0)
    assert (told.power_supply_status, told.current) == (NOT_CHARGING, pytest.approx(-IDLE / VOLTAGE))
    assert cell.charge < 0.4


def test_contact_and_loss_of_it_are_told_at_once():
    cell = battery(0.4)
    assert (cell.status, cell.changed) == (DISCHARGING, False)
    cell.connect(300.0)
    assert (cell.status, cell.changed) == (CHARGING, True)
    assert cell.message(0.0).current > 0
    assert not cell.changed
    cell.connect(None)
    assert (cell.status, cell.changed) == (DISCHARGING, True)
    assert cell.message(0.0).current < 0


def test_a_full_one_stays_full_at_the_charger_and_is_not_full_away_from_it():
    cell = battery(0.999)
    cell.connect(300.0)
    for _ in range(200):
        cell.feed(0.0, PERIOD)
    assert cell.status == FULL
    cell.feed(60.0, PERIOD)
    assert cell.status == FULL, "the charger feeds the motors, too"
    cell.connect(None)
    assert cell.status == DISCHARGING
    cell.connect(300.0)
    assert cell.status == FULL
