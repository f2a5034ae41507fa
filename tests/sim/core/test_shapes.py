from __future__ import annotations

import math

import pytest
from scipy.spatial.transform import Rotation

from sim.core.shapes import Shape, compose, from_yaw, place, rotate, rotate_back, yaw_of


def test_a_quarter_turn_carries_east_to_north():
    assert rotate(from_yaw(math.pi / 2), (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))


def test_turning_back_undoes_turning():
    q = compose(from_yaw(0.7), (math.sin(0.2), 0.0, 0.0, math.cos(0.2)))
    assert rotate_back(q, rotate(q, (1.0, 2.0, 3.0))) == pytest.approx((1.0, 2.0, 3.0))


def test_composing_turns_adds_their_yaws():
    assert yaw_of(compose(from_yaw(0.5), from_yaw(0.9))) == pytest.approx(1.4)


def test_a_carried_shape_turns_round_the_frame_it_is_carried_in():
    shape = Shape("box", (1, 1, 1), (2.0, 0.0, 0.5)).at((10.0, 0.0, 0.0), from_yaw(math.pi / 2))
    assert shape.position == pytest.approx((10.0, 2.0, 0.5))
    assert yaw_of(shape.rotation) == pytest.approx(math.pi / 2)


def test_a_tapered_box_is_smaller_at_its_top():
    corners = Shape("box", (2.0, 2.0, 1.0), taper=(0.5, 0.25)).corners()
    top = [corner for corner in corners if corner[2] > 0]
    assert max(x for x, _, _ in top) == pytest.approx(0.5)
    assert max(y for _, y, _ in top) == pytest.approx(0.25)


def test_a_place_is_turned_before_it_is_moved():
    assert place((1.0, 0.0, 0.0), (5.0, 5.0, 0.0), from_yaw(math.pi)) == pytest.approx((4.0, 5.0, 0.0))


@pytest.mark.parametrize("seed", range(4))
def test_turns_in_space_are_those_of_scipy(seed):
    outer, inner = Rotation.random(2, random_state=seed)
    q, r = (tuple(turn.as_quat().tolist()) for turn in (outer, inner))
    point = (1.0, -2.0, 3.0)
    assert rotate(q, point) == pytest.approx(tuple(outer.apply(point)))
    assert rotate_back(q, point) == pytest.approx(tuple(outer.inv().apply(point)))
    both = Rotation.from_quat(compose(q, r))
    assert (both * (outer * inner).inv()).magnitude() == pytest.approx(0.0, abs=1e-7)
    assert yaw_of(q) == pytest.approx(outer.as_euler("ZYX")[0])
