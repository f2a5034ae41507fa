from __future__ import annotations

import math

import numpy as np
import pytest

from widgets.core.shapes import EDGES, FLOATS, LINE, RING_SIDES, Shapes

RED = (1.0, 0.0, 0.0, 1.0)


def vertices(shapes: Shapes) -> np.ndarray:
    return shapes.arrays()[0].reshape(-1, FLOATS)


def test_nothing_drawn_is_no_vertex():
    assert [len(array) for array in Shapes().arrays()] == [0, 0]


def test_indices_go_on_from_shape_to_shape():
    shapes = Shapes()
    shapes.disc(0, 0, 5, RED)
    shapes.ring(0, 0, 5, 1, RED)
    flat, indices = shapes.arrays()
    assert flat.dtype == np.float32
    assert indices.dtype == np.uint16
    assert indices.max() == 7
    assert indices[6:].min() == 4


def test_a_disc_has_room_for_its_soft_edge():
    shapes = Shapes()
    shapes.disc(10, 20, 5, RED)
    assert vertices(shapes)[:, :2].min(axis=0) == pytest.approx([4, 14])


def test_discs_may_each_have_their_colour():
    shapes = Shapes()
    shapes.discs(np.zeros((2, 2)), 2, np.array([[1, 0, 0, 1], [0, 1, 0, 1]], np.float32))
    assert vertices(shapes)[[0, 4], 8:10].tolist() == [[1, 0], [0, 1]]


def test_a_dashed_ring_has_a_whole_number_of_dashes():
    shapes = Shapes()
    shapes.ring(0, 0, 10, 2, RED, dashes=12)
    assert math.tau * 10 / vertices(shapes)[0, 6] == pytest.approx(12)


def test_dashes_go_on_from_one_stretch_to_the_next():
    shapes = Shapes()
    shapes.dashes(np.array([[0.0, 0], [3, 0], [3, 4]]), 2, RED, period=5, dash=2)
    made = vertices(shapes)
    assert made[:, 2].tolist() == [0, 3, 3, 0, 3, 7, 7, 3]
    assert set(made[:, 6]) == {5}
    assert set(made[:, 4]) == {LINE}


def test_a_line_may_change_its_colour_from_point_to_point():
    shapes = Shapes()
    colours = np.array([[1, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1]], np.float32)
    shapes.line(np.array([[0.0, 0], [0, 0], [5, 0]]), 2, colours)
    assert vertices(shapes)[:, 8].tolist() == [1, 1, 0, 0]


def test_a_lines_sharp_corner_does_not_grow_a_spike():
    shapes = Shapes()
    shapes.line(np.array([[0.0, 0], [100, 0], [0, 0.5]]), 4, RED)
    assert vertices(shapes)[:, 0].max() < 110


def test_points_that_repeat_do_not_break_a_line():
    shapes = Shapes()
    shapes.line(np.array([[0.0, 0], [0, 0], [5, 0]]), 2, RED)
    assert np.isfinite(vertices(shapes)).all()
    assert len(vertices(shapes)) == 4


def test_a_line_of_one_point_is_nothing():
    shapes = Shapes()
    shapes.line(np.array([[1.0, 1]]), 2, RED)
    assert len(vertices(shapes)) == 0


def test_a_triangle_knows_the_distance_to_each_edge():
    shapes = Shapes()
    shapes.polygon([(0, 0), (4, 0), (0, 3)], RED)
    made = vertices(shapes)
    assert set(made[:, 4]) == {EDGES}
    assert made[:, [2, 3, 5]] == pytest.approx(np.diag([2.4, 4, 3]), abs=1e-5)


def test_the_cut_between_two_triangles_of_a_shape_is_no_edge():
    shapes = Shapes()
    shapes.polygon([(0, 0), (4, 0), (4, 4), (0, 4)], RED)
    first, second = vertices(shapes).reshape(2, 3, FLOATS)
    assert (first[:, 3] == 1000).all()
    assert (second[:, 5] == 1000).all()
    assert first[:, 2].max() < 10


def test_no_more_is_drawn_than_indices_can_name():
    shapes = Shapes()
    shapes.discs(np.zeros((20_000, 2)), 2, RED)
    assert len(vertices(shapes)) == 0
    shapes.disc(0, 0, 1, RED)
    assert len(vertices(shapes)) == 4


def area(shapes: Shapes) -> float:
    """Of all triangles [px²]."""
    places, (_, indices) = vertices(shapes)[:, :2], shapes.arrays()
    one, two, three = (places[indices[corner::3]].astype(float) for corner in range(3))
    across = two - one, three - one
    return float(np.abs(across[0][:, 0] * across[1][:, 1] - across[0][:, 1] * across[1][:, 0]).sum() / 2)


@pytest.mark.parametrize(("radius", "width"), [(100, 2), (40, 6), (300, 1)])
def test_of_a_large_ring_only_the_rim_is_shaded(radius, width):
    shapes = Shapes()
    shapes.ring(7, 9, radius, width, RED)
    made = vertices(shapes)
    away = np.hypot(made[:, 2], made[:, 3])
    middles = np.hypot(*((made[:RING_SIDES, 2:4] + np.roll(made[:RING_SIDES, 2:4], -1, 0)) / 2).T)
    outer = np.hypot(*((made[RING_SIDES:, 2:4] + np.roll(made[RING_SIDES:, 2:4], -1, 0)) / 2).T)
    assert away[:RING_SIDES].max() <= radius - width / 2 - 0.5, "no soft edge is cut off within"
    assert middles.max() < away.max()
    assert outer.min() >= radius + width / 2 + 0.5, "nor at the sides of the outer corners"
    assert np.allclose(made[:, :2] - made[:, 2:4], (7, 9), atol=1e-3)
    rim = math.tau * radius * (width + 2)
    assert area(shapes) == pytest.approx(rim, rel=0.6)
    assert area(shapes) < 0.35 * (2 * radius) ** 2


def test_a_small_ring_is_a_square():
    shapes = Shapes()
    shapes.ring(0, 0, 8, 2, RED)
    assert area(shapes) == pytest.approx((2 * (8 + 1 + 1)) ** 2)


@pytest.mark.parametrize("half_angle", [0.01, 0.28, 1.0, 1.5])
def test_a_sector_has_room_for_all_of_it_and_for_little_else(half_angle):
    shapes, radius = Shapes(), 50.0
    shapes.sector(3, 4, radius, yaw=0.7, half_angle=half_angle, colour=RED)
    made = vertices(shapes)
    left, low = made[:, 2:4].min(0)
    right, high = made[:, 2:4].max(0)
    for turn in np.linspace(-half_angle, half_angle, 9):
        rim = (radius + 0.5) * math.cos(turn), (radius + 0.5) * math.sin(turn)
        assert low - 1e-3 <= rim[1] <= high + 1e-3
        assert rim[0] <= right
    assert left <= -0.5
    assert area(shapes) <= (2 * (radius + 1)) ** 2 * max(0.06, math.sin(half_angle)) * 1.01


@pytest.mark.parametrize(
    "ends", [((1.0, 2), (31, 2)), ((3, 9), (3, -40)), ((0.5, 0.25), (7, 11)), ((4, 4), (4, 4))]
)
def test_a_line_from_point_to_point_is_like_one_with_corners(ends):
    """Its arithmetic is its own: the way by numpy, which a colour for each point takes, is the measure."""
    quick, slow = Shapes(), Shapes()
    quick.line(np.array(ends, float), 3, RED)
    slow.line(np.array(ends, float), 3, np.array([RED, RED], np.float32))
    assert vertices(quick) == pytest.approx(vertices(slow), abs=1e-5)
    assert quick.arrays()[1].tolist() == slow.arrays()[1].tolist()


def test_what_is_stamped_is_like_what_is_made_there():
    mark, stamped, made = Shapes(), Shapes(), Shapes()
    mark.disc(0, 0, 5, RED)
    for shapes in (stamped, made):
        shapes.disc(9, 9, 2, RED)
    stamped.stamp(mark.arrays(), 30, -7)
    made.disc(30, -7, 5, RED)
    assert vertices(stamped).tolist() == vertices(made).tolist()
    assert stamped.arrays()[1].tolist() == made.arrays()[1].tolist()
    assert vertices(mark)[:, :2].mean(axis=0).tolist() == [0, 0]  # the stamp itself has not moved


@pytest.mark.parametrize("angle", [math.nan, math.inf, -math.inf])
def test_a_sector_whose_angles_are_none_is_not_drawn(angle):
    shapes = Shapes()
    shapes.sector(3, 4, 10, yaw=angle, half_angle=0.5, colour=RED)
    shapes.sector(3, 4, 10, yaw=0.5, half_angle=angle, colour=RED)
    assert len(shapes.arrays()[0]) == 0
