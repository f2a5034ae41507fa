from __future__ import annotations

import math

import numpy as np
import pytest

from widgets.core.shapes import EDGES, FLOATS, LINE, Shapes

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
