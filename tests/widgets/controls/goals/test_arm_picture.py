from __future__ import annotations

import math

import numpy as np
import pytest

from widgets.controls.goals.arm_picture import Links, draw_arm, draw_deck, side_points
from widgets.core.shapes import Shapes


def test_stretched_out_the_tip_is_as_far_as_its_links_are_long():
    links = Links()
    rise = math.atan2(links.upper[1], links.upper[0])
    tip = side_points((0.0, rise, -rise, 0.0), links)[-1]
    reach = math.hypot(*links.upper) + links.fore + links.hand
    assert tip == pytest.approx([links.foot[0] + reach, links.foot[1]])


def test_a_hand_that_is_bent_down_points_down():
    points = side_points((0.0, 0.0, 0.0, math.pi / 2), Links())
    assert points[-1] - points[-2] == pytest.approx([0.0, -Links().hand], abs=1e-9)


@pytest.mark.parametrize("opening", [0.0, 0.075, math.nan])
def test_it_is_drawn_whatever_is_known_of_the_gripper(opening):
    shapes, points = Shapes(), side_points((0.0, -1.05, 0.35, 0.70), Links()) * 200.0
    draw_deck(shapes, (0.0, 0.0), (-50.0, 100.0), 200.0, Links())
    draw_arm(shapes, points, 200.0, opening=opening, touching=False)
    vertices, _ = shapes.arrays()
    assert len(vertices)
    assert np.isfinite(vertices).all()
