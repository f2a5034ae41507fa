"""What sonars tell of where something stands."""

from __future__ import annotations

import math

import numpy as np

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.pilothouse_msgs import SonarRing
from robotside.mapping.sonar_points import MAX_OBSTACLE_RANGE, SonarProjection


def ring(*ranges: float) -> SonarRing:
    bearings = [i * math.pi / 2 for i in range(len(ranges))]
    data = np.array(ranges, dtype="<f4").tobytes()
    return SonarRing(
        bearings=Float64Array(bearings),
        field_of_view=0.4,
        radius=0.2,
        range_min=0.15,
        range_max=6.0,
        ranges=Float32Array(data),
    )


def test_a_near_thing_stands_somewhere_across_the_end_of_its_cone() -> None:
    points = SonarProjection().points(ring(1.0, math.inf))
    assert np.hypot(*points.T).tolist() == [1.2] * 3
    angles = np.arctan2(points[:, 1], points[:, 0])
    assert 0.1 < angles.max() < 0.2
    assert angles.sum() == 0.0


def test_what_is_too_close_stands_right_before_its_sonar() -> None:
    points = SonarProjection().points(ring(math.inf, -math.inf))
    assert (np.hypot(*points.T) < 0.2 + 0.15).all()
    assert np.allclose(points[1], (0.0, np.hypot(*points[1])))


def test_far_echoes_and_those_that_are_no_numbers_say_nothing() -> None:
    assert len(SonarProjection().points(ring(MAX_OBSTACLE_RANGE + 0.1, math.nan, math.inf, 5.9))) == 0
