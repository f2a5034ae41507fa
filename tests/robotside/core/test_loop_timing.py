"""The timing of the loop."""

from __future__ import annotations

import pytest

from robotside.core.loop_timing import MIN_TICKS, WINDOW, LoopTiming


def ticks(timing: LoopTiming, start: float, count: int, *, took: float, done: float, lag: float) -> float:
    for _ in range(count):
        timing.on_tick(start, start + took, done=done, lag=lag)
        start += took
    return start


def test_nothing_is_known_before_some_ticks() -> None:
    timing = LoopTiming()
    ticks(timing, 0.0, MIN_TICKS - 1, took=1.0, done=0.1, lag=2.0)
    assert (timing.factor, timing.lag) == (1.0, 0.0)


def test_a_loop_that_is_late_each_time_lags() -> None:
    timing = LoopTiming()
    ticks(timing, 0.0, 20, took=0.4, done=0.4, lag=0.4)
    assert (timing.factor, timing.lag) == (pytest.approx(1.0), pytest.approx(0.4))


def test_the_longest_tick_does_not_count() -> None:
    timing = LoopTiming()
    at = ticks(timing, 0.0, 60, took=1 / 60, done=1 / 60, lag=0.01)
    timing.on_tick(at, at + 2.0, done=0.25, lag=1.8)
    assert (timing.factor, timing.lag) == (pytest.approx(1.0), pytest.approx(0.01))


def test_what_is_longer_ago_than_the_window_is_forgotten() -> None:
    timing = LoopTiming()
    at = ticks(timing, 0.0, 40, took=0.5, done=0.05, lag=1.0)
    ticks(timing, at, round((WINDOW + 1.0) * 10), took=0.1, done=0.1, lag=0.0)
    assert (timing.factor, timing.lag) == (pytest.approx(1.0), 0.0)
