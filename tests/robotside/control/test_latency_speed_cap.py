"""The speed follows the link."""

from __future__ import annotations

import math

import pytest

from robotside.control.latency_speed_cap import MIN_SHARE, LatencySpeedCap, share


@pytest.mark.parametrize(
    ("rtt", "expected"),
    [(math.nan, 1.0), (0.0, 1.0), (0.2, 1.0), (0.3, (1 + MIN_SHARE) / 2), (0.4, MIN_SHARE), (9.0, MIN_SHARE)],
)
def test_full_speed_to_200_ms_and_from_there_down_to_a_crawl_at_400_ms(rtt: float, expected: float) -> None:
    assert share(rtt) == pytest.approx(expected)


def test_it_falls_at_once_and_rises_slowly() -> None:
    pace = LatencySpeedCap()
    pace.update(0.05, 10.0)
    pace.update(0.5, 10.1)
    assert pace.share == MIN_SHARE
    pace.update(0.05, 10.6)
    assert MIN_SHARE < pace.share < 0.5
    pace.update(0.05, 13.0)
    assert pace.share == 1.0


def test_what_is_shown_changes_in_steps_and_is_never_more_than_it_is() -> None:
    pace = LatencySpeedCap()
    shown = set()
    for step in range(1000):
        pace.update(0.2 + step / 5000, step * 0.02)
        assert pace.shown <= pace.share + 1e-9
        shown.add(pace.shown)
    assert 10 < len(shown) < 20
    assert pace.shown >= MIN_SHARE


def test_set_free_it_follows_no_link() -> None:
    pace = LatencySpeedCap()
    pace.update(0.5, 10.0)
    pace.free()
    assert (pace.share, pace.shown) == (1.0, 1.0)
