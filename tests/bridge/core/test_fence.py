"""A fence as a distance to the border of where a robot may be."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.fence import FenceGeometry as Fence
from bridge.core.fence import Ring


def box(west: float, south: float, east: float, north: float) -> Ring:
    return ((west, south), (east, south), (east, north), (west, north))


HALL = box(0.0, 0.0, 10.0, 6.0)
HOLE = box(4.0, 2.0, 6.0, 4.0)


def clearance(fence: Fence, x: float, y: float) -> float:
    return float(fence.clearance(np.array([[x, y]]))[0])


def test_without_areas_the_robot_may_be_anywhere() -> None:
    assert not Fence()
    assert clearance(Fence(), 1e6, -1e6) == math.inf


def test_within_an_area_the_distance_is_to_its_nearest_edge_and_outside_it_is_negative() -> None:
    fence = Fence([HALL])
    assert clearance(fence, 1.0, 3.0) == pytest.approx(1.0)
    assert clearance(fence, -2.0, 3.0) == pytest.approx(-2.0)
    assert clearance(fence, 13.0, 10.0) == pytest.approx(-5.0)


def test_an_area_to_keep_out_of_is_a_hole_in_the_other() -> None:
    fence = Fence([HALL], [HOLE])
    assert clearance(fence, 3.0, 3.0) == pytest.approx(1.0)
    assert clearance(fence, 5.0, 3.5) == pytest.approx(-0.5)


def test_the_direction_of_the_corners_does_not_matter() -> None:
    assert clearance(Fence([HALL[::-1]], [HOLE[::-1]]), 3.0, 3.0) == pytest.approx(1.0)


@pytest.mark.parametrize(
    "rooms",
    [
        (box(0.0, 0.0, 5.0, 6.0), box(4.0, 0.0, 10.0, 6.0)),
        (box(0.0, 0.0, 5.0, 6.0), box(5.0, 0.0, 10.0, 6.0)),
        (box(0.0, 0.0, 5.0, 6.0), box(5.0, 0.0, 10.0, 2.5), box(5.0, 2.5, 10.0, 6.0)),
    ],
    ids=["overlapping", "wall to wall", "of different length"],
)
def test_areas_that_meet_have_no_border_between_them(rooms: tuple[Ring, ...]) -> None:
    fence = Fence(rooms)
    assert clearance(fence, 5.0, 3.0) == pytest.approx(3.0)
    assert clearance(fence, 4.5, 3.0) == pytest.approx(3.0)


def test_areas_that_meet_askew_have_no_border_between_them_either() -> None:
    c, s = math.cos(0.3), math.sin(0.3)
    turned = [
        tuple((c * x - s * y, s * x + c * y) for x, y in ring)
        for ring in (
            box(0.0, 0.0, 5.0, 6.0),
            box(5.0, 0.0, 10.0, 1.7),
            box(5.0, 1.7, 10.0, 3.1),
            box(5.0, 3.1, 10.0, 6.0),
        )
    ]
    assert clearance(Fence(turned), 5 * c - 3 * s, 5 * s + 3 * c) == pytest.approx(3.0)


def test_a_hole_across_the_edge_moves_the_border_inwards() -> None:
    fence = Fence([HALL], [box(8.0, -1.0, 12.0, 7.0)])
    assert clearance(fence, 7.0, 3.0) == pytest.approx(1.0)
    assert clearance(fence, 9.0, 3.0) == pytest.approx(-1.0)
    assert clearance(fence, 9.0, 0.2) == pytest.approx(-1.0)
    assert clearance(fence, 11.0, 3.0) == pytest.approx(-3.0)


def test_inward_leads_away_from_the_border_on_either_side_of_it() -> None:
    fence = Fence([HALL])
    assert fence.inward(1.0, 3.0) == pytest.approx((1.0, 0.0))
    assert fence.inward(-1.0, 3.0) == pytest.approx((1.0, 0.0))
    assert fence.inward(0.0, 3.0) == (0.0, 0.0)
    assert Fence().inward(0.0, 3.0) == (0.0, 0.0)


PLACES = st.floats(-3.0, 13.0)


@given(PLACES, PLACES, PLACES, PLACES)
def test_the_distance_changes_no_faster_than_one_moves(x: float, y: float, u: float, v: float) -> None:
    fence = Fence([HALL, box(9.0, 5.0, 12.0, 9.0)], [HOLE, box(-1.0, 5.0, 3.0, 7.0)])
    change = abs(clearance(fence, x, y) - clearance(fence, u, v))
    assert change <= math.hypot(x - u, y - v) + 1e-9


@given(PLACES, PLACES)
def test_its_sign_says_whether_one_may_be_there(x: float, y: float) -> None:
    fence = Fence([HALL, box(9.0, 5.0, 12.0, 9.0)], [HOLE])
    within = (0 < x < 10 and 0 < y < 6) or (9 < x < 12 and 5 < y < 9)
    found = clearance(fence, x, y)
    if abs(found) > 1e-9:
        assert (found > 0) == (within and not (4 < x < 6 and 2 < y < 4))
