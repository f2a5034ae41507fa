"""Visible tags, read by the detector of the family's authors."""

from __future__ import annotations

import numpy as np
import pytest

from robotside.perception import tag_reader
from sim.world.tag_pattern import CODES, TAG_SIZE, cells, tag_plate


@pytest.fixture(scope="module")
def detector():
    return tag_reader.detector()


@pytest.mark.parametrize("tag", range(len(CODES)))
def test_the_cells_of_each_tag_are_read_as_its_number(detector, tag):
    picture = np.pad(np.kron(np.array(cells(tag)), np.ones((12, 12))), 24, constant_values=1)
    found = detector.detect((picture * 220 + 20).astype(np.uint8))
    assert [(each.tag_id, each.hamming) for each in found] == [(tag, 0)]


def seen_from_the_front(shapes, pixels=160):
    """The colour that one sees of each place of a plate from in front, from its upper left, 0.2 m wide."""
    picture = np.full((pixels, pixels), np.nan)
    for shape in sorted(shapes, key=lambda each: -(each.position[0] - each.size[0] / 2)):
        half_y, half_z = shape.size[1] / 2, shape.size[2] / 2
        left, right = ((0.10 - shape.position[1] + side * half_y) / 0.20 * pixels for side in (-1, 1))
        top, low = ((0.10 - shape.position[2] + side * half_z) / 0.20 * pixels for side in (-1, 1))
        picture[round(top) : round(low), round(left) : round(right)] = shape.colour[0]
    return picture


@pytest.mark.parametrize("tag", [0, 1, 7, 29])
def test_the_plate_shows_it_upright_and_not_mirrored_in_a_white_border(detector, tag):
    picture = seen_from_the_front(tag_plate(tag))
    assert not np.isnan(picture).any()
    (found,) = detector.detect(np.pad((picture * 255).astype(np.uint8), 20, constant_values=128))
    assert (found.tag_id, found.hamming) == (tag, 0)
    assert np.ptp(found.corners[:, 0]) == pytest.approx(TAG_SIZE / 0.20 * 160, abs=1.5)
    lower_left, lower_right, upper_right, upper_left = found.corners
    assert lower_left[1] > upper_left[1]
    assert lower_right[0] > lower_left[0]
    assert upper_right[0] > upper_left[0]
