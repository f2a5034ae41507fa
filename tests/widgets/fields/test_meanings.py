from __future__ import annotations

from bridge.msgs.diagnostic_msgs import DiagnosticStatus
from bridge.msgs.geometry_msgs import Vector3
from bridge.msgs.sensor_msgs import BatteryState
from widgets.fields.meanings import meaning_of
from widgets.fields.message_fields import describe, rows


def test_a_constant_is_of_the_field_whose_name_it_begins_with():
    assert meaning_of(BatteryState, "power_supply_status", 2) == "DISCHARGING"
    assert meaning_of(BatteryState, "power_supply_health", 1) == "GOOD"
    assert meaning_of(BatteryState, "power_supply_health", 99) == ""


def test_constants_without_a_field_are_of_the_only_whole_number():
    assert meaning_of(DiagnosticStatus, "level", 1) == "WARN"
    assert meaning_of(Vector3, "x", 1) == ""


def test_the_tree_says_number_and_name():
    told = {row.name: describe(row)[0] for row in rows(BatteryState(power_supply_status=1), {})}
    assert told["power_supply_status"] == "1 · CHARGING"
    assert "·" not in told["voltage"]
