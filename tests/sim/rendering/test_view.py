from __future__ import annotations

import math

import numpy as np
import pytest

from sim.core.shapes import from_yaw
from sim.rendering.view import View


def seen(view, point):
    """Where `point` is drawn: column and row, -1 to 1, row -1 the top."""
    clip = view.matrix() @ np.array([*point, 1.0])
    return clip[:2] / clip[3]


def test_what_is_straight_ahead_is_in_the_middle():
    view = View((1.0, 2.0, 0.5), from_yaw(math.pi / 2), (640, 480), 1.2)
    assert seen(view, (1.0, 9.0, 0.5)) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_left_is_left_and_up_is_the_first_row():
    view = View((0.0, 0.0, 0.0), from_yaw(0.0), (640, 480), 1.2)
    column, row = seen(view, (5.0, 1.0, 1.0))
    assert column < 0
    assert row < 0


def test_the_edge_of_the_picture_lies_at_half_the_field_of_view():
    view = View((0.0, 0.0, 0.0), from_yaw(0.0), (640, 480), 1.2)
    assert seen(view, (10.0, -10.0 * math.tan(0.6), 0.0))[0] == pytest.approx(1.0)
    assert seen(view, (10.0, 0.0, -10.0 * math.tan(0.6) * 0.75))[1] == pytest.approx(1.0)


def test_from_above_a_metre_is_a_metre_everywhere_and_north_is_up():
    view = View.from_above(40.0, 30.0, 400)
    assert view.size == (400, 300)
    assert seen(view, (20.0, 15.0, 0.0)) == pytest.approx((1.0, -1.0))
    assert seen(view, (-10.0, -7.5, 3.0)) == pytest.approx((-0.5, 0.5))
