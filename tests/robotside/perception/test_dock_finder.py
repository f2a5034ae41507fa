"""The dock in a laser sweep, against where it was put."""

from __future__ import annotations

import math

import msgspec
import numpy as np
import pytest

from bridge.core.units import wrap
from bridge.msgs.arrays import Float32Array
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.perception.dock_finder import DockFinder, DockSighting, Expected
from tests.robotside.perception.dock_scans import BRIGHT, Line, dock, leg, sweep

AT = Pose2(2.0, 0.0, 0.0)
WALL = Line(2.4, -4.0, 2.4, 4.0)


def expected(pose: Pose2 = AT, reach: float = 0.8, turn: float = 0.6) -> Expected:
    return Expected(pose, reach, turn)


def look(lines: list[Line], robot: Pose2 = ORIGIN, at: Pose2 = AT, **words: object) -> DockSighting | None:
    rng = np.random.default_rng(3)
    where = expected(at.since(robot))
    return DockFinder().find(sweep([*lines, WALL], robot, rng, **words), where)  # type: ignore[arg-type]


def off(seen: DockSighting | None, truth: Pose2) -> tuple[float, float]:
    """How far, and by how much turned."""
    assert seen is not None
    return seen.pose.distance(truth.x, truth.y), abs(wrap(seen.pose.yaw - truth.yaw))


def test_from_two_metres_its_place_and_direction_are_those_it_has_and_its_spread_is_honest() -> None:
    rng, errors, turns = np.random.default_rng(5), [], []
    for _ in range(200):
        x, y, yaw = -rng.uniform(0.0, 0.6), rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.3)
        robot = Pose2(x, y, yaw)
        truth = AT.since(robot)
        guess = Pose2(truth.x + rng.uniform(-0.2, 0.2), truth.y + rng.uniform(-0.2, 0.2), truth.yaw + 0.17)
        seen = DockFinder().find(sweep([*dock(AT), WALL], robot, rng), expected(guess))
        assert seen is not None
        assert seen.by == "reflectors"
        far, turned = off(seen, truth)
        errors.append((far / seen.spread) ** 2)
        turns.append((turned / seen.turn) ** 2)
        assert far < 0.05
        assert turned < 0.25
    # two axes, one angle: the mean of the normalised square is 2 and 1 where the spread is right
    assert 0.5 < np.mean(errors) < 3.0
    assert 0.3 < np.mean(turns) < 2.0


def test_without_an_error_of_the_laser_it_is_exact_but_for_the_distance_between_two_beams() -> None:
    for degrees in range(-40, 41, 8):
        at = Pose2(1.5, 0.2, math.radians(degrees))
        seen = DockFinder().find(sweep(dock(at), ORIGIN, beams=3600), expected(at))
        far, turned = off(seen, at)
        assert max(far, turned) < 0.005, degrees


def test_a_laser_before_the_axle_measures_from_where_it_is() -> None:
    mount = Pose2(0.8, 0.0, 0.0)
    seen = DockFinder(mount).find(sweep(dock(AT), mount), expected())
    assert off(seen, AT)[0] < 0.02


def test_a_laser_that_sweeps_clockwise_sees_the_same() -> None:
    scan = sweep(dock(AT), Pose2(0.0, 0.3, 0.0))
    ranges = np.frombuffer(scan.ranges, np.float32)[::-1]
    shine = np.frombuffer(scan.intensities, np.float32)[::-1]
    scan = msgspec.structs.replace(
        scan,
        ranges=Float32Array(ranges.tobytes()),
        intensities=Float32Array(shine.tobytes()),
        angle_min=scan.angle_max,
        angle_increment=-scan.angle_increment,
    )
    truth = AT.since(Pose2(0.0, 0.3, 0.0))
    assert off(DockFinder().find(scan, expected(truth)), truth)[0] < 0.02


@pytest.mark.parametrize("side", [-0.15, 0.15])
def test_one_strip_does_where_a_leg_hides_the_other(side: float) -> None:
    seen = look([*dock(AT), *leg(1.5, side * 0.75)])
    assert seen is not None
    assert seen.by == "one reflector"
    assert off(seen, AT)[0] < 0.08
    assert off(seen, AT)[1] < 0.25


def test_one_strip_alone_is_no_dock() -> None:
    assert look(dock(AT, strips=(0.15,))) is None


def test_no_strip_is_no_dock_for_a_laser_that_would_see_them() -> None:
    assert look([*dock(AT, strips=()), Line(-3.0, -1.0, -3.0, 1.0, BRIGHT)]) is None


def test_two_reflecting_legs_are_no_dock_since_the_laser_looks_through_between_them() -> None:
    assert look([*leg(2.0, -0.15, 0.03, BRIGHT), *leg(2.0, 0.15, 0.03, BRIGHT)]) is None


def test_strips_at_another_distance_are_no_dock() -> None:
    assert look(dock(AT, width=0.8, strips=(-0.25, 0.25))) is None
    assert look(dock(AT, strips=(-0.08, 0.08))) is None


def test_a_vest_that_reflects_is_too_broad_for_a_strip() -> None:
    vest = [Line(1.6, 0.5, 1.6, 0.9, BRIGHT)]
    seen = look([*dock(AT), *vest])
    assert off(seen, AT)[0] < 0.05
    assert look(vest) is None


def test_of_two_docks_it_is_the_one_that_is_meant() -> None:
    other = Pose2(2.0, 1.2, 0.0)
    for at in (AT, other):
        guess = Pose2(at.x, at.y + 0.3, 0.17)
        scan = sweep([*dock(AT), *dock(other)], ORIGIN, np.random.default_rng(1))
        assert off(DockFinder().find(scan, expected(guess)), at)[0] < 0.05


def test_a_dock_elsewhere_than_expected_is_another_one() -> None:
    assert look(dock(Pose2(2.0, 1.5, 0.0))) is None


def test_people_round_it_change_nothing() -> None:
    people = [*leg(1.2, 0.6), *leg(1.4, 0.7), *leg(1.0, -0.7), *leg(1.1, -0.9)]
    seen = look([*dock(AT), *people])
    assert seen is not None
    assert seen.by == "reflectors"
    assert off(seen, AT)[0] < 0.05


def test_a_laser_without_intensities_goes_by_the_shape_and_says_so() -> None:
    seen = look(dock(AT), intensities=False)
    assert seen is not None
    assert seen.by == "shape"
    assert off(seen, AT)[0] < 0.06
    assert off(seen, AT)[1] < 0.2


def test_by_shape_two_faces_that_fit_are_none() -> None:
    twin = Pose2(2.0, 0.6, 0.0)
    assert look([*dock(AT), *dock(twin)], intensities=False) is None


def test_by_shape_a_wall_and_a_round_bin_are_no_dock() -> None:
    assert look([], intensities=False) is None
    assert look(leg(2.0, 0.0, 0.25), intensities=False) is None


def test_an_empty_sweep_shows_nothing() -> None:
    assert DockFinder().find(sweep([], ORIGIN), expected()) is None
    assert DockFinder().find(sweep([], ORIGIN, intensities=False), expected()) is None
    assert DockFinder().find(sweep([], ORIGIN, beams=2), expected()) is None
