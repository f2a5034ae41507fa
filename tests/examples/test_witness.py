"""How the demo judges what the robot reported."""

from __future__ import annotations

from examples.demo.ground import PATROL, cones
from examples.demo.witness import matches

CONES = [(0.0, 0.0), (10.0, 0.0)]


def test_a_find_counts_for_the_cone_that_it_is_near():
    assert matches([(0.5, 0.5), (10.0, 0.9)], CONES, within=1.0) == [1, 1]


def test_a_cone_reported_twice_counts_twice():
    assert matches([(0.1, 0.0), (-0.1, 0.0)], CONES, within=1.0) == [2, 0]


def test_a_find_far_from_all_counts_for_none():
    assert matches([(5.0, 5.0)], CONES, within=1.0) == [0, 0]


def test_the_parking_lot_has_six_cones_beside_the_patrol():
    assert len(cones()) == 6
    assert len(PATROL) == 6
