from __future__ import annotations

import math

import pytest

from bridge.msgs.sensor_msgs import BatteryState
from widgets.instruments.battery import Battery, BatteryChip, charge_role, time_left_text


@pytest.mark.parametrize(
    ("share", "role"),
    [(1.0, "ok"), (0.4, "ok"), (0.39, "warn"), (0.2, "warn"), (0.19, "danger"), (math.nan, "muted")],
)
def test_the_charge_decides_the_role(share, role):
    assert charge_role(share) == role


@pytest.mark.parametrize(
    ("hours", "text"),
    [
        (2.1667, "about 2 h 10 min left"),
        (0.2, "about 12 min left"),
        (math.nan, ""),
        (math.inf, ""),
        (-1.0, ""),
    ],
)
def test_the_time_left_is_said_in_words(hours, text):
    assert time_left_text(hours) == text


def test_before_the_first_message_it_shows_a_dash():
    battery = Battery()
    assert (battery.text, battery.role, battery.sentence) == ("—", "muted", "no data yet")


def test_it_reckons_the_time_left_from_charge_and_current():
    battery = Battery(state="live")
    battery.show(BatteryState(percentage=0.87, charge=2.6, current=-1.2))
    assert (battery.text, battery.role) == ("87 %", "ok")
    assert battery.hours_left == pytest.approx(2.1667, abs=1e-3)


@pytest.mark.parametrize("current", [0.0, 1.5, math.nan])
def test_without_a_drain_it_promises_no_time(current):
    battery = Battery(state="live")
    battery.show(BatteryState(percentage=0.5, charge=2.0, current=current))
    assert battery.sentence == "battery"


def test_it_says_when_it_is_charging():
    battery = Battery(state="live")
    battery.show(BatteryState(percentage=0.5, current=2.0, power_supply_status=1))
    assert battery.sentence == "charging"


@pytest.mark.parametrize(("share", "text"), [(1.2, "100 %"), (-0.1, "0 %"), (math.nan, "—")])
def test_a_figure_out_of_range_stays_on_the_scale(share, text):
    battery = Battery(state="live")
    battery.show(BatteryState(percentage=share))
    assert battery.text == text


@pytest.mark.parametrize(
    ("power", "icon", "sentence"),
    [
        (1, "battery_charging_full", "charging"),
        (2, "battery_full", "battery"),
        (3, "battery_full", "at the charger, no current"),
        (4, "battery_charging_full", "full"),
    ],
)
def test_a_bolt_and_words_tell_that_it_charges_and_not_the_colour_alone(power, icon, sentence):
    chip, card = BatteryChip(state="live"), Battery(state="live")
    for widget in (chip, card):
        widget.show(BatteryState(percentage=0.6, power_supply_status=power))
    assert chip.children[0].icon == icon
    assert card.sentence == sentence


def test_the_chip_is_as_wide_as_its_words(stage):
    chip = stage.show(BatteryChip(state="live"))
    chip.show(BatteryState(percentage=0.08))
    stage.frames(3)
    inner = chip.children[0]
    assert inner.text == "8 %"
    assert inner.icon == "battery_alert"
    assert chip.width == inner.width > 40


def test_a_brief_chip_keeps_its_unit():
    chip = BatteryChip(state="live", brief=True)
    chip.show(BatteryState(percentage=0.87))
    assert chip.children[0].text == "87 %"


@pytest.mark.parametrize(("brief", "text"), [(False, "87 % · 12 s old"), (True, "87 %")])
def test_an_old_charge_fades_in_the_bar_and_says_how_old_it_is_where_there_is_room(stage, brief, text):
    chip = stage.show(BatteryChip(state="live", brief=brief))
    chip.show(BatteryState(percentage=0.87))
    chip.state, chip.age = "stale", 12.0
    inner = chip.children[0]
    assert (inner.text, inner.role, inner.tinted) == (text, "muted", True)
    chip.state = "live"
    assert (inner.text[:2], inner.tinted) == ("87", False)


@pytest.mark.parametrize("size", [(60, 34), (90, 52), (120, 76), (100, 140), (230, 150)])
def test_a_battery_keeps_to_its_card_however_small_that_is(stage, size):
    battery = stage.show(Battery(state="live", size_hint=(None, None)), size)
    battery.show(BatteryState(percentage=0.87))
    stage.frames(3)
    shown = [part for part in battery.children if part.opacity and part.height and hasattr(part, "text")]
    assert "87 %" in [part.text for part in shown]
    for part in shown:
        width, height = part.texture_size
        assert part.y >= battery.y - 1.5
        assert part.top <= battery.top + 1.5
        assert width <= battery.width
        assert height <= part.height + 1.5
    cell = next(part for part in battery.children if not hasattr(part, "text") and hasattr(part, "filled"))
    assert not cell.opacity or (cell.y >= battery.y and cell.top <= battery.top)
