"""What hangs together in a mask."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from robotside.mapping.connected_components import boxes


def test_pixels_that_touch_at_a_corner_are_one_patch() -> None:
    mask = np.array([[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 0, 0]], dtype=np.bool_)
    assert list(boxes(mask)) == [(slice(0, 2), slice(0, 2)), (slice(0, 2), slice(3, 4))]


def test_arms_that_meet_far_below_are_one_patch() -> None:
    mask = np.zeros((9, 9), dtype=np.bool_)
    mask[:, ::2] = True
    mask[8] = True
    assert list(boxes(mask)) == [(slice(0, 9), slice(0, 9))]


def test_nothing_has_no_patch() -> None:
    assert list(boxes(np.zeros((4, 4), dtype=np.bool_))) == []


@pytest.mark.parametrize("part", [0.05, 0.35, 0.6])
def test_the_patches_are_all_there_is_in_the_order_of_their_first_pixels(part: float) -> None:
    rng = np.random.default_rng(6)
    for _ in range(40):
        mask = rng.random(rng.integers(1, 40, 2)) < part
        labels, _ = ndimage.label(mask, np.ones((3, 3)))
        assert list(boxes(mask)) == ndimage.find_objects(labels)
