"""What a robot says of how well it knows its place."""

from __future__ import annotations

import numpy as np
import pytest

from robotside.localisation import pose_estimator


@pytest.mark.parametrize("seed", range(8))
def test_the_worst_direction_is_the_larger_axis_of_the_ellipse_however_it_lies(seed: int) -> None:
    root = np.random.default_rng(seed).normal(size=(3, 3)) * 10.0 ** (seed - 4)
    covariance = root @ root.T
    axes = np.linalg.eigvalsh(covariance[:2, :2])
    assert pose_estimator._worst(covariance) == pytest.approx(axes[-1], rel=1e-12)


def test_a_place_known_for_sure_has_no_spread_and_one_known_across_has_that_of_it() -> None:
    assert pose_estimator._worst(np.zeros((3, 3))) == 0.0
    assert pose_estimator._worst(np.diag([0.01, 0.09, 4.0])) == pytest.approx(0.09)
