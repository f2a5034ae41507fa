"""How far off a believed place may be for what its filter cannot see."""

from __future__ import annotations

import math

import pytest

from robotside.localisation.position_uncertainty import PositionUncertainty


def test_reckoning_adds_up_from_the_last_time_that_the_place_was_known() -> None:
    doubt = PositionUncertainty()
    doubt.reckon(0.1)
    doubt.settle()
    assert doubt.variance == 0.0
    doubt.reckon(0.6)
    assert doubt.variance == pytest.approx(0.5)
    doubt.reckon(math.nan)
    assert doubt.variance == pytest.approx(0.5)


def test_many_fixes_are_no_better_than_one_for_they_err_together() -> None:
    doubt = PositionUncertainty()
    doubt.reckon(2.0)
    for _ in range(100):
        doubt.fix(0.7)
    assert doubt.variance == pytest.approx(0.7)
    doubt.reckon(2.5)
    assert doubt.variance == pytest.approx(1.2)


def test_odometry_that_begins_anew_takes_no_doubt_away() -> None:
    doubt = PositionUncertainty()
    doubt.reckon(1.0)
    doubt.reckon(0.0)
    assert doubt.variance == pytest.approx(1.0)
    doubt.reckon(0.2)
    assert doubt.variance == pytest.approx(1.2)


def test_what_sees_walls_has_none() -> None:
    doubt = PositionUncertainty()
    doubt.reckon(1.0)
    doubt.on_walls_seen()
    assert doubt.variance == 0.0
