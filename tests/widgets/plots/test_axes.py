from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.plots.axes import clock_text, nice_range, nice_step, tick_text, ticks, time_step


@pytest.mark.parametrize(
    ("span", "most", "step"), [(1.0, 5, 0.2), (10.0, 5, 2.0), (0.03, 4, 0.01), (1.0, 10, 0.1), (0.0, 5, 1.0)]
)
def test_a_step_is_round(span, most, step):
    assert nice_step(span, most) == pytest.approx(step)


@pytest.mark.parametrize(
    ("span", "step"), [(30.0, 10), (2.0, 0.5), (300.0, 60), (7200.0, 1800), (1e7, 86_400)]
)
def test_a_step_of_time_is_round_in_minutes_and_hours(span, step):
    assert time_step(span, 5) == pytest.approx(step)


@given(st.floats(-1e9, 1e9), st.floats(0, 1e9))
def test_a_range_has_room_for_all_and_little_more(low, size):
    least, greatest = nice_range(low, low + size)
    assert least <= low
    assert low + size <= greatest
    assert greatest > least


def test_a_range_of_one_value_is_round_it():
    assert nice_range(5.0, 5.0) == pytest.approx((4.4, 5.6))
    least, greatest = nice_range(0.0, 0.0)
    assert least < 0 < greatest
    assert nice_range(math.inf, -math.inf) == (0.0, 1.0)


def test_ticks_are_multiples_of_the_step():
    assert ticks(-0.5, 1.5, 0.5) == pytest.approx([-0.5, 0.0, 0.5, 1.0, 1.5])
    assert ticks(0.0, 1e9, 0.001) == []


@pytest.mark.parametrize(
    ("value", "step", "text"),
    [(0.5, 0.5, "0.5"), (1.0, 0.05, "1.00"), (-20.0, 10.0, "−20"), (1e-9, 0.5, "0"), (2e-5, 1e-5, "2e−5")],
)
def test_a_tick_has_as_many_decimals_as_its_step(value, step, text):
    assert tick_text(value, step) == text


def test_a_time_of_day_is_as_fine_as_the_scale(monkeypatch):
    monkeypatch.setenv("TZ", "UTC")
    import time

    time.tzset()
    try:
        assert clock_text(3661.5, 60.0) == "01:01"
        assert clock_text(3661.0, 5.0) == "01:01:01"
        assert clock_text(3661.25, 0.05) == "01:01:01.25"
    finally:
        monkeypatch.undo()
        time.tzset()
