"""The speed follows the robot's own loop."""

from __future__ import annotations

import math

import pytest

from robotside.control.loop_speed_cap import (
    FULL_SPEED_FACTOR,
    FULL_SPEED_LAG,
    MAX_LATENESS,
    MIN_FACTOR,
    share_by_factor,
    share_by_lag,
)


@pytest.mark.parametrize(
    ("factor", "share"),
    [
        (math.nan, 0.0),
        (0.0, 0.0),
        (0.14, 0.0),
        (MIN_FACTOR - 1e-6, 0.0),
        (MIN_FACTOR, MIN_FACTOR),
        (0.5, 0.5),
        (FULL_SPEED_FACTOR, 1.0),
        (4.0, 1.0),
    ],
)
def test_a_simulated_robot_goes_by_the_real_time_factor_and_rests_below_a_fifth(
    factor: float, share: float
) -> None:
    assert share_by_factor(factor) == pytest.approx(share)


@pytest.mark.parametrize(
    ("lag", "share"),
    [
        (0.0, 1.0),
        (FULL_SPEED_LAG, 1.0),
        ((FULL_SPEED_LAG + MAX_LATENESS) / 2, 0.5),
        (MAX_LATENESS, 0.0),
        (9.0, 0.0),
        (math.nan, 0.0),
    ],
)
def test_a_real_robot_goes_by_how_late_its_loop_is_and_rests_from_a_second_on(
    lag: float, share: float
) -> None:
    assert share_by_lag(lag) == pytest.approx(share)
