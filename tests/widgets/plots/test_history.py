from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.plots.history import MIN_GAP, History, thinned


def test_samples_come_back_in_their_order():
    history = History()
    for number in range(5):
        history.add(number / 10, number)
    assert history.times.tolist() == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.4])
    assert history.values.tolist() == [0, 1, 2, 3, 4]
    assert (history.newest, history.last) == (0.4, 4)


@given(st.integers(1, 60), st.integers(0, 300))
def test_the_newest_are_kept_and_no_more_than_there_is_room_for(most, told):
    history = History(most)
    for number in range(told):
        history.add(number, number)
    kept = list(range(max(0, told - most), told))
    assert history.times.tolist() == history.values.tolist() == kept


def test_it_grows_as_it_fills_and_then_no_more():
    history = History(2000)
    for number in range(100_000):
        history.add(number, number)
    assert len(history) == 2000
    assert history._times.nbytes + history._values.nbytes == 2 * 2 * 2000 * 8
    assert history.values[0] == 98_000


def test_a_time_a_little_before_the_newest_counts_as_that():
    history = History()
    history.add(10.0, 1.0)
    assert history.add(9.6, 2.0) == 10.0
    assert history.values.tolist() == [1.0, 2.0]


def test_a_time_far_before_the_newest_is_that_of_another_run():
    history = History()
    history.add(10.0, 1.0)
    history.add(3.0, 2.0)
    assert history.times.tolist() == [3.0]


def test_a_usual_gap_is_some_pauses_long():
    history = History()
    for number in range(50):
        history.add(number * 2.0, 0.0)
    assert history.usual_gap() == pytest.approx(10.0)


def test_bursts_break_no_line():
    history = History()
    for number in range(50):
        history.add(number * 0.01, 0.0)
    assert history.usual_gap() == MIN_GAP


def test_two_samples_tell_no_usual_gap():
    history = History()
    history.add(0.0, 1.0)
    history.add(100.0, 1.0)
    assert history.usual_gap() == math.inf


def test_what_is_asked_for_has_a_neighbour_at_each_end():
    history = History()
    for number in range(10):
        history.add(number, number)
    assert history.within(3.5, 6.5) == (3, 8)
    assert history.within(-5.0, 50.0) == (0, 10)


def test_the_value_at_a_time_is_that_of_the_nearest_sample():
    history = History()
    for number in range(10):
        history.add(number, number * 10)
    assert history.at(3.4, 1.0) == 30
    assert history.at(3.6, 1.0) == 40
    assert math.isnan(history.at(12.0, 1.0))
    assert math.isnan(History().at(0.0, 1.0))


def test_a_recording_takes_the_place_of_what_was_there():
    history = History()
    history.add(1.0, 1.0)
    history.load(np.array([5.0, 6.0]), np.array([7.0, 8.0]))
    assert history.times.tolist() == [5.0, 6.0]
    history.add(7.0, 9.0)
    assert history.values.tolist() == [7.0, 8.0, 9.0]


@given(st.lists(st.floats(-1e6, 1e6) | st.just(math.nan), min_size=1, max_size=400), st.integers(6, 60))
def test_of_many_samples_the_extremes_and_the_holes_stay(values, most):
    told = np.array(values)
    times, kept = thinned(np.arange(float(len(told))), told, most)
    assert len(kept) <= most + 3
    assert np.all(np.diff(times) > 0)
    if np.isfinite(told).any():
        assert np.nanmin(kept) == np.nanmin(told)
        assert np.nanmax(kept) == np.nanmax(told)
    assert np.isnan(kept).any() == np.isnan(told).any()
