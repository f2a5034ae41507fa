"""A long run is judged by the slopes of what it holds."""

from __future__ import annotations

import math
import random
from pathlib import Path

import pytest

from bench.soak import Row, draw, figures
from bench.support.soak.trend import trend

HOURS = [number / 360 for number in range(360)]


def noisy(slope: float, spread: float = 1.0) -> list[float]:
    rng = random.Random(4)
    return [200 + slope * hour + rng.gauss(0, spread) for hour in HOURS]


def row(seconds: float, memory: float) -> Row:
    names = ("blocks", "fds", "threads", "tasks", "late", "cpu", "gap", "poses", "pictures", "visits", "slow")
    return {"seconds": seconds, "memory": memory, **dict.fromkeys(names, 5.0)}


def test_a_slope_is_found_in_the_noise_with_its_doubt() -> None:
    found = trend(HOURS, noisy(7.0))
    assert found.slope == pytest.approx(7.0, abs=4 * found.doubt)
    assert 0 < found.doubt < 1.0
    assert found.grows == pytest.approx(found.slope - 2 * found.doubt)


def test_noise_alone_does_not_grow() -> None:
    assert trend(HOURS, noisy(0.0)).grows == 0.0


def test_what_falls_does_not_grow() -> None:
    assert trend(HOURS, noisy(-3.0)).grows == 0.0


def test_of_a_short_series_nothing_is_said() -> None:
    assert math.isnan(trend(HOURS[:20], HOURS[:20]).grows)


def test_what_is_taken_at_the_start_is_no_growth() -> None:
    """The first half hour is left out, of a shorter run the first half."""
    rows = [row(number * 10.0, 100.0 if number < 170 else 200.0) for number in range(360)]
    found = figures(rows)
    assert (found["memory_first"], found["memory_last"]) == (100.0, 200.0)
    assert found["memory_grows"] == 0.0


def test_a_leak_is_seen() -> None:
    found = figures([row(number * 10.0, 100.0 + number * 0.1) for number in range(360)])
    assert found["memory_grows"] == pytest.approx(36.0)
    assert found["fds_grows"] == 0.0


def test_a_run_that_was_ended_at_once_has_no_figures() -> None:
    assert figures([]) == {}


def test_the_curves_are_drawn(tmp_path: Path) -> None:
    draw([row(number * 10.0, 100.0 + number) for number in range(50)], tmp_path / "soak.png")
    assert (tmp_path / "soak.png").read_bytes().startswith(b"\x89PNG")
