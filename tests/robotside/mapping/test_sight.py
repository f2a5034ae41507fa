"""What a sweep saw through, against geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.pilothouse_msgs import SonarRing
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.sight import (
    HEADING_ERROR,
    MAX_NEAR_ANGLE,
    POSE_ERROR,
    THING_RADIUS,
    BeamSight,
    ConeSight,
)
from robotside.mapping.sonar_points import SonarProjection

BEAMS = 360
STEP = math.tau / BEAMS
ANGLES = -math.pi + STEP * np.arange(BEAMS)


def sight(free: np.ndarray | float = 10.0, *, place: Pose2 = ORIGIN, doubt: float = 0.0) -> BeamSight:
    return BeamSight(place, -math.pi, STEP, np.broadcast_to(free, (BEAMS,)).astype(float), doubt)


def round_thing(x: float, y: float, radius: float, behind: float = 10.0) -> np.ndarray:
    """Ranges from the origin to a round thing, by the closed form, and `behind` beside it."""
    along, aside = x * np.cos(ANGLES) + y * np.sin(ANGLES), x * np.sin(ANGLES) - y * np.cos(ANGLES)
    hit = (np.abs(aside) < radius) & (along > 0)
    return np.where(hit, along - np.sqrt(np.clip(radius**2 - aside**2, 0.0, None)), behind)


def wall(distance: float) -> np.ndarray:
    """Ranges to a wall along x at y = `distance`."""
    return np.where(np.sin(ANGLES) > 1e-6, distance / np.maximum(np.sin(ANGLES), 1e-6), 10.0).clip(max=10.0)


def one(x: float, y: float) -> np.ndarray:
    return np.array([[x, y]])


@pytest.mark.parametrize("bearing", np.arange(-3.1, 3.2, 0.31).tolist())
@pytest.mark.parametrize("far", [0.5, 2.0, 5.0, 9.0])
def test_where_every_beam_goes_on_behind_a_place_nothing_stands(bearing: float, far: float) -> None:
    place = one(far * math.cos(bearing), far * math.sin(bearing))
    assert sight().through(place).tolist() == [True]


@pytest.mark.parametrize("radius", [0.03, 0.06, 0.2])
@pytest.mark.parametrize("far", [0.6, 1.5, 2.5])
def test_what_stands_is_not_seen_through_wherever_it_was_remembered_on_its_face(
    far: float, radius: float
) -> None:
    for bearing in np.arange(-3.1, 3.2, 0.1).tolist():
        x, y = far * math.cos(bearing), far * math.sin(bearing)
        ranges = round_thing(x, y, radius)
        met = ranges < 9.0
        face = np.column_stack([ranges * np.cos(ANGLES), ranges * np.sin(ANGLES)])[met]
        # as a pose that is off by 3 cm remembers it
        for off in ((0.0, 0.0), (0.03, 0.0), (0.0, 0.03), (-0.02, -0.02)):
            assert not sight(ranges).through(face + off).any()


def test_a_wall_seen_at_a_grazing_angle_stays_though_beams_pass_close_by() -> None:
    along = np.column_stack([np.arange(0.5, 8.0, 0.1), np.full(75, 0.3)])
    assert not sight(wall(0.3)).through(along).any()


def test_a_beam_that_ends_right_behind_a_place_tells_nothing() -> None:
    assert sight(2.1).through(one(2.0, 0.0)).tolist() == [False]
    assert sight(2.2).through(one(2.0, 0.0)).tolist() == [True]


def test_what_stands_in_between_hides_the_place() -> None:
    assert not sight(round_thing(1.0, 0.0, 0.1)).through(one(3.0, 0.0)).any()
    assert sight(round_thing(1.0, 0.0, 0.1)).through(one(3.0, 1.5)).all()


def test_the_less_sure_the_place_the_more_has_to_be_free_beside() -> None:
    pillar = round_thing(2.0, 0.5, 0.1)
    assert sight(pillar).through(one(2.0, 0.0)).all()
    assert not sight(pillar, doubt=0.3).through(one(2.0, 0.0)).any()


def test_so_near_that_it_would_fill_half_the_sweep_nothing_is_said() -> None:
    nearest = (THING_RADIUS + POSE_ERROR) / (math.sin(MAX_NEAR_ANGLE) - HEADING_ERROR)
    places = np.array([[nearest - 0.005, 0.0], [nearest + 0.005, 0.0]])
    assert sight().through(places).tolist() == [False, True]
    # the nearer one is not judged by the beams that point away from it either
    assert not sight(np.where(np.cos(ANGLES) > 0.3, 10.0, 0.2)).through(places[:1]).any()


def test_where_beams_are_too_far_apart_to_meet_a_thin_thing_nothing_is_said() -> None:
    coarse = BeamSight(ORIGIN, -math.pi, math.tau / 90, np.full(90, 10.0))
    assert coarse.through(np.array([[2.0, 0.0], [4.0, 0.0]])).tolist() == [True, False]


def test_outside_the_sweep_nothing_is_seen_through() -> None:
    half = BeamSight(ORIGIN, -1.0, STEP, np.full(115, 10.0))
    places = [[2.0 * math.cos(a), 2.0 * math.sin(a)] for a in (-1.5, -0.98, -0.8, 0.0, 0.8, 0.98, 1.5, 3.1)]
    assert half.through(np.array(places)).tolist() == [False, False, True, True, True, False, False, False]


def test_it_is_seen_from_where_the_robot_was() -> None:
    turned = BeamSight(Pose2(3.0, 1.0, math.pi / 2), -0.5, STEP, np.full(58, 4.0))
    assert turned.through(np.array([[3.0, 4.0], [6.0, 1.0], [3.0, 5.2]])).tolist() == [True, False, False]


def test_a_scan_that_met_nothing_is_free_as_far_as_the_laser_reaches_and_what_is_no_number_is_not() -> None:
    ranges = np.full(BEAMS, np.inf, dtype=np.float32)
    ranges[:90], ranges[90:120], ranges[120] = np.nan, -np.inf, 0.05
    scan = LaserScan(
        angle_min=-math.pi,
        angle_increment=STEP,
        range_min=0.1,
        range_max=6.0,
        ranges=Float32Array(ranges.tobytes()),
    )
    seen = LaserProjection(Pose2(0.2, 0.0, 0.0)).sight(scan, Pose2(1.0, 0.0, 0.0))
    assert seen is not None
    assert seen.place == Pose2(1.2, 0.0, 0.0)
    assert seen.free.tolist() == [0.0] * 121 + [6.0] * 239


def test_a_laser_upside_down_sees_through_the_same() -> None:
    ranges = round_thing(2.0, 1.0, 0.2).astype(np.float32)
    upright = LaserScan(
        angle_min=-math.pi,
        angle_increment=STEP,
        range_min=0.1,
        range_max=12.0,
        ranges=Float32Array(ranges.tobytes()),
    )
    turned = LaserScan(
        angle_min=-math.pi + STEP * (BEAMS - 1),
        angle_increment=-STEP,
        range_min=0.1,
        range_max=12.0,
        ranges=Float32Array(ranges[::-1].tobytes()),
    )
    places = np.random.default_rng(1).uniform(-4.0, 4.0, (200, 2))
    laser = LaserProjection()
    first, second = laser.sight(upright, ORIGIN), laser.sight(turned, ORIGIN)
    assert first is not None
    assert second is not None
    assert first.through(places).tolist() == second.through(places).tolist()


def test_a_cone_clears_what_lies_about_its_middle_when_it_sees_well_behind() -> None:
    ring = ConeSight(ORIGIN, np.array([0.0, math.pi / 2]), 0.4, 0.2, np.array([2.0, 1.0]))
    places = np.array([[1.0, 0.0], [1.95, 0.0], [1.0, 0.3], [0.0, 0.8], [0.0, 1.1], [-1.0, 0.0]])
    assert ring.through(places).tolist() == [True, False, False, True, False, False]


def test_a_cone_with_an_echo_before_the_place_outvotes_its_neighbour() -> None:
    near = ConeSight(ORIGIN, np.array([0.0, 0.1]), 0.4, 0.2, np.array([4.0, 1.0]))
    assert near.through(one(2.0, 0.0)).tolist() == [False]


def test_a_ring_that_measured_nothing_clears_nothing() -> None:
    ring = SonarRing(
        bearings=Float64Array([0.0, 1.5, -1.5]),
        ranges=Float32Array(np.array([np.inf, np.nan, -np.inf], dtype=np.float32).tobytes()),
        field_of_view=0.4,
        radius=0.2,
        range_min=0.15,
        range_max=6.0,
    )
    assert SonarProjection().sight(ring, ORIGIN).free.tolist() == [6.0, 0.0, 0.0]
