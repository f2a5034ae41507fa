"""A loss is judged by what the robot's port was told after it, and every way in words is one that can be done."""

from __future__ import annotations

import math

import pytest

from bench.inputs import FIGURES, KINDS, rested

MOVES, RESTS = True, False


def test_it_counts_until_the_first_rest_that_nothing_follows() -> None:
    told = [(9.9, MOVES), (10.05, RESTS), (10.1, MOVES), (10.15, RESTS), (10.2, RESTS)]
    assert rested(told, 10.0) == pytest.approx(0.15)


def test_one_that_is_told_to_move_on_never_rests() -> None:
    assert rested([(10.05, RESTS), (10.9, MOVES)], 10.0) == math.inf


def test_one_that_rested_before_rests_at_once() -> None:
    assert rested([(9.9, MOVES), (9.95, RESTS)], 10.0) == 0.0


def test_each_way_can_be_done_and_has_its_row() -> None:
    from bench.support.losses import LOSSES

    for kind, ways in KINDS.items():
        assert ways.keys() <= LOSSES.keys()
        assert {f"{kind}_{way}" for way in ways} <= {figure.name for figure in FIGURES}
