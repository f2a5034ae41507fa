"""Half cycles to and fro, counted with hysteresis."""

from __future__ import annotations

import pytest

from app.inputs.motion.shake.half_cycles import HalfCycles


@pytest.fixture
def halves() -> HalfCycles:
    return HalfCycles(threshold=3.0, gap=0.7, cap=1.7)


def feed(halves: HalfCycles, *values: float, since: float = 0.0) -> float:
    """One each 0.1 s; gives when the next one would come."""
    for index, value in enumerate(values):
        halves.feed(since + 0.1 * index, value)
    return since + 0.1 * len(values)


def test_each_goes_over_the_threshold_on_the_other_side(halves: HalfCycles) -> None:
    feed(halves, 4.0, 5.0, 2.0, -2.9, 3.5, -3.5, -4.0, 6.0)
    assert halves.count == 3
    assert halves.mean == pytest.approx((5.0 + 4.0 + 6.0) / 3)


def test_a_strong_one_is_evidence_for_no_more_than_the_cap(halves: HalfCycles) -> None:
    feed(halves, 30.0, -3.0, -6.0)
    assert halves.evidence == pytest.approx(1.7 + 1.7)


def test_one_that_comes_too_late_begins_a_new_run(halves: HalfCycles) -> None:
    feed(halves, 4.0, -4.0)
    feed(halves, 4.0, since=1.5)
    assert (halves.count, halves.since) == (1, 1.5)


def test_a_run_is_over_once_no_other_comes(halves: HalfCycles) -> None:
    feed(halves, 4.0, -4.0)
    halves.feed(1.0, 0.0)
    assert (halves.count, halves.evidence, halves.mean) == (0, 0.0, 0.0)


def test_of_what_ran_before_a_burst_only_the_last_counts(halves: HalfCycles) -> None:
    """Steps go over the threshold too, and a shake is not the longer for them."""
    now = feed(halves, 4.0, -4.0, 4.0, -5.0)
    halves.begin(now)
    assert (halves.count, halves.since, halves.mean) == (1, now, 5.0)


def test_a_run_that_has_just_begun_belongs_to_the_burst(halves: HalfCycles) -> None:
    feed(halves, 4.0, -4.0)
    halves.begin(0.2)
    assert halves.count == 2
