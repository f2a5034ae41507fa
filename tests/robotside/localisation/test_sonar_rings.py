"""Rings of sonars, laid together."""

from __future__ import annotations

import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.localisation.sonar_rings import SONAR_RINGS, SonarRings


def test_rings_of_a_drive_see_a_post_at_one_place() -> None:
    rings, post = SonarRings(), np.array([[5.0, 1.0]])
    for n in range(SONAR_RINGS):
        odom = Pose2(0.3 * n, 0.1 * n, 0.2 * n)
        seen = rings.add(odom.inverse().apply(post).reshape(1, 1, 2), odom)
        assert (seen is None) is (n + 1 < SONAR_RINGS)
    assert seen is not None
    assert seen.shape == (SONAR_RINGS, 1, 2)
    assert odom.apply(seen.reshape(-1, 2)) == pytest.approx(np.tile(post, (SONAR_RINGS, 1)))


def test_each_ring_is_laid_on_the_map_once() -> None:
    rings, odom = SonarRings(), Pose2(0.0, 0.0, 0.0)
    for _ in range(2):
        told = [rings.add(np.zeros((2, 3, 2)), odom) for _ in range(SONAR_RINGS)]
        assert [each is None for each in told] == [True] * (SONAR_RINGS - 1) + [False]


def test_after_it_was_cleared_it_begins_anew() -> None:
    rings, odom = SonarRings(), Pose2(0.0, 0.0, 0.0)
    for _ in range(SONAR_RINGS - 1):
        rings.add(np.zeros((2, 3, 2)), odom)
    rings.clear()
    assert rings.add(np.zeros((2, 3, 2)), odom) is None
