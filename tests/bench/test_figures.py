"""The arithmetic of figures: median, range, spread, percentile, verdict, ratio."""

from __future__ import annotations

import math
import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bench.support.figures import Figure, Outcome, Samples, Stated, percentile

finite = st.floats(-1e6, 1e6)


def test_a_percentile_between_two_values_is_linear():
    assert percentile([4, 1, 3, 2, 5], 0.5) == 3
    assert percentile([0, 10], 0.25) == 2.5
    assert percentile([7], 0.99) == 7
    assert math.isnan(percentile([], 0.5))
    assert percentile([1, 2, math.inf], 0.5) == 2
    assert percentile([1, math.inf, math.inf], 0.9) == math.inf


@given(st.lists(finite, min_size=1, max_size=40), st.floats(0, 1))
def test_a_percentile_lies_within_the_values(values, share):
    slack = 1e-9 * max(map(abs, values))
    assert min(values) - slack <= percentile(values, share) <= max(values) + slack


@given(st.lists(finite, min_size=1, max_size=40))
def test_half_of_the_values_lie_below_the_median(values):
    assert percentile(values, 0.5) == pytest.approx(statistics.median(values), abs=1e-6)


def test_samples_say_their_median_range_and_spread():
    samples = Samples((8.0, 12.0, 10.0))
    assert (samples.median, samples.low, samples.high, samples.spread) == (10.0, 8.0, 12.0, 0.4)


def test_no_samples_say_nan():
    none = Samples(())
    assert all(math.isnan(value) for value in (none.median, none.low, none.high, none.spread))


def test_a_share_of_the_peers_value_is_a_target_that_holds_on_any_machine():
    cost = Figure("cost", "ms", "", target=30.0, against="the old way", share=0.5)
    assert cost.verdict(20.0, 40.0) == "reached"
    assert cost.verdict(20.1, 40.0) == "MISSED"
    assert cost.verdict(30.1, 100.0) == "MISSED", "what a person feels holds too"
    assert cost.verdict(20.0) == "MISSED", "nothing was measured beside it"
    speed = Figure("speed", "1/s", "", better="more", against="the old way", share=2.0)
    assert Outcome(speed, Samples((8.0,)), Samples((4.0,))).verdict == "reached"
    assert Outcome(speed, Samples((7.9,)), Samples((4.0,))).verdict == "MISSED"


def test_what_needs_recordings_is_not_missed_without_them():
    walkers = Figure("walkers", "", "", target=0.02, needs_data=True)
    assert Outcome(walkers, Samples(())).verdict == "not measured"
    assert Outcome(walkers, Samples((0.03,))).verdict == "MISSED"
    assert Outcome(walkers, Samples((math.nan,))).verdict == "MISSED"
    assert Outcome(Figure("all", "", "", target=0.02), Samples(())).verdict == "MISSED"
    assert Outcome(Figure("told", "", "", needs_data=True), Samples(())).verdict == ""


@pytest.mark.parametrize(
    ("better", "value", "verdict"),
    [
        ("less", 12.0, "reached"),
        ("less", 12.1, "MISSED"),
        ("more", 12.0, "reached"),
        ("more", 11.9, "MISSED"),
        ("less", math.nan, "MISSED"),
        ("more", math.nan, "MISSED"),
    ],
)
def test_a_target_is_reached_when_met_exactly_and_never_by_nan(better, value, verdict):
    assert Figure("delay", "ms", "", target=12.0, better=better).verdict(value) == verdict


def test_without_a_target_there_is_no_verdict():
    assert Figure("delay", "ms", "").verdict(1e9) == ""


@pytest.mark.parametrize(("better", "ratio"), [("less", 4.0), ("more", 0.25)])
def test_the_ratio_says_how_many_times_better_than_the_peer(better, ratio):
    outcome = Outcome(Figure("x", "s", "", better=better), Samples((1.0, 2.0, 3.0)), Samples((8.0,)))
    assert outcome.ratio == ratio


def test_without_a_peer_there_is_no_ratio():
    assert math.isnan(Outcome(Figure("x", "s", ""), Samples((1.0,))).ratio)


def test_against_nothing_there_is_no_ratio():
    assert math.isnan(Outcome(Figure("x", "s", ""), Samples((0.0,)), Samples((8.0,))).ratio)


@pytest.mark.parametrize(("better", "ratio"), [("less", 5.0), ("more", 0.2)])
def test_what_was_stated_of_another_program_is_compared_as_a_peer_is(better, ratio):
    figure = Figure("x", "s", "", better=better, stated=Stated("another", 10.0))
    outcome = Outcome(figure, Samples((1.0, 2.0, 3.0)))
    assert outcome.stated_ratio == ratio
    assert math.isnan(outcome.ratio)


def test_where_nothing_was_stated_there_is_no_ratio_to_it():
    assert math.isnan(Outcome(Figure("x", "s", ""), Samples((1.0,)), Samples((8.0,))).stated_ratio)
