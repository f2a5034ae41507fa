"""Charts of methods: each bar has its own line, and every figure is written."""

from __future__ import annotations

import math

import pytest
from kivy.metrics import dp

from widgets.study.bar_rows import nice_step
from widgets.study.response_chart import ResponseChart
from widgets.study.success_bars import SuccessBars

TIMES = [
    ("STOP", "mic", "Voice", 0.52, 0.41, 0.77, 10),
    ("STOP", "mobile_vibrate", "Shake", 1.2, 1.0, 1.6, 9),
    ("Pause", "mic", "Voice", 0.6, 0.5, 0.9, 8),
]


def drawn(widget):
    widget.draw()
    return widget


def test_the_bars_of_one_command_stand_under_its_name():
    chart = drawn(ResponseChart(times=TIMES, state="live", size_hint=(None, None), width=600))
    assert [group.name for group in chart.groups()] == ["STOP", "Pause"]
    words = [text for text in chart.texts if text in ("STOP", "Voice", "Shake", "Pause")]
    assert words == ["STOP", "Voice", "Shake", "Pause", "Voice"]


def test_each_bar_says_its_median_and_how_many_it_is_of():
    chart = drawn(ResponseChart(times=TIMES, state="live", size_hint=(None, None), width=600))
    assert {"0.52 s · 10", "1.20 s · 9", "0.60 s · 8"} <= set(chart.texts)


def test_a_narrow_chart_leaves_the_names_to_the_icons_and_keeps_the_figures():
    chart = drawn(ResponseChart(times=TIMES, state="live", size_hint=(None, None), width=280))
    assert "Voice" not in chart.texts
    assert "0.52 s · 10" in chart.texts


@pytest.mark.parametrize("width", [360, 388, 412, 600])
def test_it_says_what_the_line_on_a_bar_is_on_a_phone_too(width):
    chart = drawn(ResponseChart(times=TIMES, state="live", size_hint=(None, None), width=width))
    assert any("middle half" in text for text in chart.texts)


@pytest.mark.parametrize(("rows", "scales"), [(3, 1), (9, 2)])
def test_a_long_chart_has_its_scale_at_both_ends(rows, scales):
    times = (TIMES * 3)[:rows]
    chart = drawn(ResponseChart(times=times, state="live", size_hint=(None, None), width=388))
    assert chart.texts.count("0 s") == scales


def test_it_grows_with_what_it_shows():
    chart = ResponseChart(size_hint=(None, None), width=600)
    empty = chart.height
    chart.times = TIMES
    assert chart.height == chart.wanted > empty


def test_nothing_timed_is_said():
    assert "No response times yet." in drawn(ResponseChart(size_hint=(None, None), width=600)).texts


def test_a_quick_answer_is_not_drawn_as_a_slow_one():
    chart = ResponseChart(times=[("STOP", "mic", "Voice", 0.05, 0.04, 0.06, 3)])
    assert chart.scale()[0] >= 0.5


@pytest.mark.parametrize(("full", "step"), [(0.2, 0.05), (0.51, 0.2), (2.5, 0.5), (9.0, 2.0), (500.0, 20.0)])
def test_the_scale_has_round_steps_and_not_too_many(full, step):
    assert nice_step(full) == step


RATES = [
    ("mic", "Voice", 46, 50, 0.812, 0.968, 0.775),
    ("radio_button_checked", "Switches", 0, 0, 0.0, 1.0, math.nan),
]


def test_a_share_is_said_with_its_counts_and_none_is_a_dash():
    bars = drawn(SuccessBars(rates=RATES, state="live", size_hint=(None, None), width=600))
    assert {"92 % · 46/50", "—", "in the paper"} <= set(bars.texts)


def test_there_is_no_legend_where_there_is_nothing_to_compare_with():
    rates = [(*RATES[0][:6], math.nan)]
    bars = drawn(SuccessBars(rates=rates, state="live", size_hint=(None, None), width=600))
    assert "in the paper" not in bars.texts


def test_bars_of_success_have_no_heading():
    one = SuccessBars(rates=RATES[:1], size_hint=(None, None), width=600)
    two = SuccessBars(rates=RATES, size_hint=(None, None), width=600)
    assert two.height - one.height == dp(30)
