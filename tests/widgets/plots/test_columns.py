from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from widgets.plots.columns import LINE, Columns
from widgets.plots.history import History

WIDE = 0.1
"""Of a column [s]."""


def filled(samples, *, left=0.0, right=5.0, gap=1.0) -> tuple[History, Columns]:
    history, columns = History(), Columns()
    for time, value in samples:
        history.add(time, value)
    columns.resize(50)
    columns.gap = gap
    columns.rebuild(history, left, right, origin=left - 2 * WIDE, base=0.0, wide=WIDE)
    return history, columns


def grown(samples, *, left=0.0, gap=1.0) -> Columns:
    columns = Columns()
    columns.resize(50)
    columns.gap = gap
    columns.rebuild(History(), left, left + 5.0, origin=left - 2 * WIDE, base=0.0, wide=WIDE)
    for time, value in samples:
        columns.add(time, value)
    return columns


def bars(columns: Columns) -> list[tuple[float, float]]:
    """Least and greatest value of each column that is drawn, from left to right."""
    drawn = columns.quads[: columns.count, 0]
    drawn = drawn[drawn[:, 6] == LINE]
    return [(float(one[1]), float(one[3])) for one in drawn[np.argsort(drawn[:, 0])]]


def lines(columns: Columns) -> list[tuple[float, float]]:
    """From and to value of each line between two columns, from left to right."""
    drawn = columns.quads[columns.count : 2 * columns.count, 0]
    drawn = drawn[drawn[:, 6] == LINE]
    return [(float(one[1]), float(one[3])) for one in drawn[np.argsort(drawn[:, 0])]]


def test_neighbours_are_joined():
    _, columns = filled([(1.0, 1.0), (1.5, 2.0), (2.0, 1.5)])
    assert bars(columns) == [(1.0, 1.0), (2.0, 2.0), (1.5, 1.5)]
    assert lines(columns) == [(1.0, 2.0), (2.0, 1.5)]


@pytest.mark.parametrize("hole", [[(1.5, math.nan)], [(1.3, math.nan), (1.7, math.nan)]])
def test_no_line_crosses_a_value_that_is_not_known(hole):
    samples = [(1.0, 1.0), *hole, (2.0, 3.0), (2.5, 4.0)]
    assert lines(filled(samples)[1]) == lines(grown(samples)) == [(3.0, 4.0)]


def test_no_line_crosses_a_time_without_messages():
    samples = [(0.5, 1.0), (1.0, 2.0), (2.1, 3.0), (2.5, 4.0)]
    assert lines(filled(samples)[1]) == lines(grown(samples)) == [(1.0, 2.0), (3.0, 4.0)]


def test_a_spike_of_one_sample_is_in_its_column():
    samples = [(number / 1000, 0.0 if number != 2345 else 9.0) for number in range(5000)]
    _, columns = filled(samples)
    assert max(high for _, high in bars(columns)) == 9.0
    assert len(bars(columns)) <= 51


@given(st.lists(st.tuples(st.floats(0.0, 0.4), st.floats(-100, 100) | st.just(math.nan)), max_size=60))
def test_what_grows_sample_by_sample_is_what_is_drawn_at_once(steps):
    time, samples = 0.0, []
    for step, value in steps:
        time += step
        if time < 4.9:
            samples.append((time, value))
    _, whole = filled(samples, gap=0.3)
    growing = grown(samples, gap=0.3)
    assert bars(growing) == bars(whole)
    assert lines(growing) == lines(whole)


def test_columns_that_scroll_out_make_room_for_new_ones():
    columns = grown([(number * 0.1, float(number)) for number in range(500)])
    assert len(bars(columns)) <= columns.count
    assert columns.extent(45.0, 49.95) == (450.0, 499.0)


def test_a_pause_longer_than_the_picture_leaves_nothing_of_before():
    columns = grown([(0.5, 7.0), (0.6, 8.0), (100.0, 1.0)])
    assert bars(columns) == [(1.0, 1.0)]
    assert lines(columns) == []


def test_the_extent_is_of_what_is_in_sight():
    _, columns = filled([(1.0, -5.0), (2.0, 1.0), (3.0, 2.0)])
    assert columns.extent(1.5, 5.0) == (1.0, 2.0)
    assert columns.extent(4.0, 5.0) == (math.inf, -math.inf)
    assert Columns().extent(0.0, 1.0) == (math.inf, -math.inf)


def test_what_lies_before_the_left_edge_leads_into_the_picture_but_has_no_extent():
    _, columns = filled([(0.0, 90.0), (2.0, 1.0), (3.0, 2.0)], left=1.5, right=6.5, gap=5.0)
    assert lines(columns) == [(90.0, 1.0), (1.0, 2.0)]
    assert columns.extent(1.5, 6.5) == (1.0, 2.0)


def test_values_far_from_zero_keep_their_differences():
    history, columns = History(), Columns()
    for number in range(3):
        history.add(number, 48.1234567 + number * 1e-6)
    columns.resize(50)
    columns.rebuild(history, 0.0, 5.0, origin=-0.2, base=48.1234567, wide=WIDE)
    assert [low for low, _ in bars(columns)] == pytest.approx([0.0, 1e-6, 2e-6], abs=1e-9)


def test_a_value_beyond_what_the_card_can_count_is_drawn_far_away():
    assert bars(filled([(1.0, 1e300), (2.0, -1e300)])[1]) == [
        (pytest.approx(1e30), pytest.approx(1e30)),
        (pytest.approx(-1e30), pytest.approx(-1e30)),
    ]


def test_marks_stand_on_samples_as_often_as_told():
    history, columns = History(), Columns()
    for number in range(50):
        history.add(number * 0.1, float(number))
    columns.resize(50)
    columns.mark(3, 1.0, 0.25)
    columns.rebuild(history, 0.0, 4.9, origin=0.0, base=0.0, wide=WIDE)
    marks = columns.quads[2 * columns.count :, 0]
    assert marks[marks[:, 6] == 3][:, 1].tolist() == [3.0, 13.0, 23.0, 33.0, 43.0]
    for number in range(50, 60):
        columns.add(number * 0.1, float(number))
    marks = columns.quads[2 * columns.count :, 0]
    assert max(marks[marks[:, 6] == 3][:, 1]) == 53.0
