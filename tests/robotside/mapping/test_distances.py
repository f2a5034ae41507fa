"""Distances on whole maps and between sweeps."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from robotside.mapping.distances import distance_from, within


@pytest.mark.parametrize("part", [0.01, 0.1, 0.6])
def test_the_distance_is_the_exact_one_to_the_nearest_full_cell(part: float) -> None:
    rng = np.random.default_rng(4)
    for _ in range(20):
        full = rng.random(rng.integers(1, 50, 2)) < part
        full[0, 0] = True
        assert distance_from(full) == pytest.approx(ndimage.distance_transform_edt(~full))


def test_one_full_cell_in_a_corner_is_found_from_everywhere() -> None:
    full = np.zeros((70, 40), dtype=np.bool_)
    full[69, 0] = True
    assert distance_from(full)[0, 39] == pytest.approx(np.hypot(69, 39))


def test_where_nothing_is_full_everything_is_far_and_still_a_number() -> None:
    assert (distance_from(np.zeros((3, 5), dtype=np.bool_)) == 16384).all()


def test_a_point_has_another_within_reach_as_if_each_were_compared_with_each() -> None:
    rng = np.random.default_rng(5)
    for _ in range(50):
        points, others = (rng.random((rng.integers(1, 60), 2)) * 2 - 1 for _ in range(2))
        gaps = np.linalg.norm(points[:, None] - others[None], axis=2)
        assert (within(points, others, 0.1) == (gaps < 0.1).any(axis=1)).all()


def test_without_others_nothing_is_within_reach() -> None:
    assert within(np.zeros((2, 2)), np.empty((0, 2)), 1.0).tolist() == [False, False]
    assert within(np.empty((0, 2)), np.zeros((2, 2)), 1.0).tolist() == []
