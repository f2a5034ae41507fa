"""Knowing where it is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Points, Pose2
from robotside.localisation import scan_matching
from robotside.localisation.field import Field
from robotside.localisation.scan_matching import DISTRUSTED_SWEEPS, UNSURE_AFTER, Localiser
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from tests.fakes import Box, FakeRobot, Pillar

EAST, NORTH = 4.0, 3.0
HALL = Grid(np.pad(np.zeros((60, 80), dtype=np.bool_), 10, constant_values=True), 0.1, -5.0, -4.0)
"""From -EAST to EAST and from -NORTH to NORTH, and nothing in it."""

BOXES = [Box(-4.0, 2.0, -2.0, 4.0), Box(3.0, -4.0, 4.0, -2.0), Box(5.0, 3.0, 7.0, 3.5)]


def sweep(robot: FakeRobot, now: float = 0.0) -> Points:
    return next(LaserProjection().points(msg) for _, msg in robot.read(now) if isinstance(msg, LaserScan))


def off(localiser: Localiser, truth: tuple[float, float, float]) -> tuple[float, float]:
    pose = localiser.pose
    assert pose is not None
    return pose.distance(truth[0], truth[1]), abs(math.remainder(pose.yaw - truth[2], math.tau))


def test_a_wrong_guess_is_corrected_by_one_search_and_a_few_sweeps() -> None:
    robot = FakeRobot(start=(1.0, -1.0, 0.7), boxes=BOXES)
    localiser = Localiser(Field(Grid.from_msg(robot.map())))
    points = sweep(robot)
    localiser.search(points, Pose2(1.8, -1.7, 0.4), reach=1.2, turn=0.5)
    for _ in range(5):
        localiser.correct(points)
    distance, turn = off(localiser, robot.pose)
    assert distance < 0.06
    assert turn < 0.01
    assert localiser.fit > 0.9


def test_a_search_at_the_end_of_a_large_map_takes_what_lies_beyond_it_for_its_last_cells() -> None:
    cells = np.zeros((400, 300), dtype=np.bool_)
    cells[::7, ::9] = cells[-1, :] = True
    field = Field(Grid(cells, 0.1, -15.0, -20.0))
    centre, reach, width = Pose2(13.0, -18.5, 0.0), 6.0, 0.5
    x, y = np.random.default_rng(1).uniform(-reach, reach, (2, 50, 1)) / math.sqrt(2)
    found = field.closeness(centre, reach, width).of(centre.x + x, centre.y + y)
    for row, column in np.ndindex(50, 50):
        at = np.array([[centre.x + x[column, 0], centre.y + y[row, 0]]])
        cell = np.floor((at - (-15.0, -20.0)) / 0.1).clip((0, 0), (299, 399)) * 0.1 + (-14.95, -19.95)
        distance = field.read(cell)[0, 0]
        assert found[row, column, 0] == pytest.approx(math.exp(-((distance / width) ** 2)), abs=0.02)


def test_a_sweep_that_claims_to_have_met_something_in_another_world_ends_a_search_as_any_other() -> None:
    localiser = Localiser(Field(HALL))
    points = np.array([[1e30, 1.0], [3.0, -1e30], [4.0, 0.0], [0.0, 3.0], [0.0, -3.0], [-4.0, 0.0]])
    localiser.search(points, Pose2(0.3, -0.3, 0.0), reach=0.6, turn=0.1)
    assert off(localiser, (0.0, 0.0, 0.0))[0] < 0.2


@pytest.mark.slow
@pytest.mark.parametrize("drift", [-0.04, 0.04])
def test_over_a_hundred_metres_of_drifting_odometry_the_error_stays_below_a_tenth(drift: float) -> None:
    pillars = [Pillar(0.0, 3.0), Pillar(-7.0, -4.0), Pillar(7.0, 0.0)]
    robot = FakeRobot(start=(0.0, 0.0, 0.0), boxes=BOXES, pillars=pillars, drift=drift, beams=120)
    localiser = Localiser(Field(Grid.from_msg(robot.map())))
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.1, turn=0.05)
    laser, worst, now = LaserProjection(), 0.0, 0.0
    robot.drive(Twist.planar(0.5, 0.25))
    while now < 200.0:
        now += 0.1
        for _, msg in robot.read(now):
            if isinstance(msg, Odometry):
                localiser.predict(Pose2.from_msg(msg.pose.pose))
            elif isinstance(msg, LaserScan):
                before = robot.pose
                localiser.correct(laser.points(msg))
                worst = max(worst, off(localiser, before)[0])
    assert worst < 0.1
    assert localiser.sure


def test_the_spread_grows_on_the_way_and_shrinks_with_a_sweep() -> None:
    robot = FakeRobot(boxes=BOXES)
    localiser = Localiser(Field(Grid.from_msg(robot.map())))
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.02, turn=0.01)
    localiser.predict(Pose2(0.0, 0.0, 0.0))
    before = np.trace(localiser.covariance)
    localiser.predict(Pose2(0.5, 0.0, 0.0))
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.02, turn=0.01)
    localiser.predict(Pose2(1.0, 0.0, 0.0))
    grown = np.trace(localiser.covariance)
    assert grown > before
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.2, turn=0.1)
    localiser.correct(sweep(robot))
    assert np.trace(localiser.covariance) < 0.01


def test_sweeps_that_do_not_fit_the_map_make_it_unsure_and_good_ones_sure_again() -> None:
    robot = FakeRobot(boxes=BOXES)
    localiser = Localiser(Field(Grid.from_msg(robot.map())))
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.1, turn=0.05)
    points = sweep(robot)
    localiser.correct(points)
    assert localiser.sure
    nonsense = np.random.default_rng(1).uniform(-3.0, 3.0, (100, 2))
    for _ in range(UNSURE_AFTER):
        localiser.correct(nonsense)
    assert not localiser.sure
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.1, turn=0.05)
    localiser.correct(points)
    assert localiser.sure


def test_an_empty_sweep_changes_no_pose() -> None:
    robot = FakeRobot()
    localiser = Localiser(Field(Grid.from_msg(robot.map())))
    localiser.place(Pose2(1.0, 2.0, 0.3), spread=0.1, turn=0.05)
    localiser.correct(np.empty((0, 2)))
    assert localiser.pose == Pose2(1.0, 2.0, 0.3)


def test_before_the_first_guess_there_is_no_pose() -> None:
    localiser = Localiser(Field(Grid.from_msg(FakeRobot().map())))
    localiser.predict(Pose2(0.0, 0.0, 0.0))
    localiser.correct(sweep(FakeRobot()))
    assert localiser.pose is None
    assert not localiser.sure


def test_a_compass_turns_it_little_by_little_and_by_no_more_than_it_is_trusted() -> None:
    localiser = Localiser(Field(HALL))
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.1, turn=0.2)
    localiser.correct_yaw(0.3, 0.2)
    assert localiser.pose is not None
    assert localiser.pose.yaw == pytest.approx(0.15)
    for _ in range(200):
        localiser.correct_yaw(0.3, 0.2)
    assert localiser.pose.yaw == pytest.approx(0.3, abs=0.01)


def test_echoes_put_it_right_by_the_place_on_each_arc_that_meets_a_surface() -> None:
    localiser, true = Localiser(Field(HALL)), Pose2(1.0, -0.5, 0.1)
    localiser.place(Pose2(1.12, -0.6, 0.05), spread=0.3, turn=0.1)
    for _ in range(4):
        localiser.correct_by_echoes(arcs(true))
    assert localiser.pose is not None
    assert localiser.pose.distance(true.x, true.y) < 0.06
    assert localiser.pose.yaw == pytest.approx(true.yaw, abs=0.03)


def test_echoes_from_within_their_cones_tell_nothing_of_the_yaw() -> None:
    localiser = Localiser(Field(HALL))
    localiser.place(Pose2(0.0, 0.0, 0.05), spread=0.3, turn=0.1)
    straight = arcs(Pose2(0.0, 0.0, 0.0))
    reach = np.hypot(straight[:, 0, 0], straight[:, 0, 1])
    facing = straight[(reach < NORTH + 0.02) | (np.abs(reach - EAST) < 0.02)]  # each wall lies across a cone
    localiser.correct_by_echoes(np.concatenate([facing] * 3))
    assert localiser.spread < 0.1
    assert math.sqrt(localiser.covariance[2, 2]) > 0.08


def test_where_echoes_came_from_is_asked_anew_from_the_place_that_they_tell() -> None:
    localiser, true = Localiser(Field(HALL)), Pose2(1.0, -0.5, 0.0)
    localiser.place(Pose2(1.2, -0.7, 0.12), spread=0.3, turn=0.1)
    localiser.correct_by_echoes(arcs(true))
    assert off(localiser, true)[0] < 0.05


def test_what_the_wheels_are_off_by_does_not_go_by_how_often_they_tell() -> None:
    grown = []
    for steps in (10, 1000):
        localiser = Localiser(Field(HALL))
        localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.0, turn=0.0)
        for n in range(steps + 1):
            localiser.predict(Pose2(2.0 * n / steps, 0.0, 1.5 * n / steps))
        grown.append(np.sqrt(np.diag(localiser.covariance)))
    assert grown[0] == pytest.approx(grown[1], rel=0.05)
    assert 0.01 < grown[0][2] < 0.05


def test_echoes_of_what_the_map_does_not_know_and_too_few_change_nothing() -> None:
    localiser, start = Localiser(Field(HALL)), Pose2(0.0, 0.0, 0.0)
    localiser.place(start, spread=0.3, turn=0.1)
    localiser.correct_by_echoes(np.full((30, 3, 2), 0.8))
    localiser.correct_by_echoes(arcs(Pose2(0.3, 0.0, 0.01))[:5])
    assert localiser.pose == start


def test_a_way_into_what_is_touched_is_doubted_and_not_believed() -> None:
    localiser = Localiser(Field(HALL))
    localiser.place(Pose2(0.0, 0.0, math.pi / 2), spread=0.02, turn=0.01)
    localiser.predict(Pose2(0.0, 0.0, 0.0))
    assert localiser.predict(Pose2(0.4, 0.3, 0.0), 0.0) == pytest.approx(0.4)
    assert localiser.pose is not None
    assert (localiser.pose.x, localiser.pose.y) == (pytest.approx(-0.3), pytest.approx(0.0))
    assert math.sqrt(localiser.covariance[0, 0]) > 0.4
    assert localiser.predict(Pose2(0.2, 0.3, 0.0), 0.0) == 0.0  # away from it
    assert localiser.pose.y == pytest.approx(-0.2)


def test_who_is_distrusted_is_sure_again_after_echoes_that_fit_for_a_while() -> None:
    localiser, true = Localiser(Field(HALL)), Pose2(1.0, -0.5, 0.1)
    localiser.place(true, spread=0.1, turn=0.1)
    localiser.distrust()
    localiser.correct_by_echoes(arcs(true))
    assert not localiser.sure
    for _ in range(DISTRUSTED_SWEEPS):
        localiser.correct_by_echoes(arcs(true))
    assert localiser.sure


def test_echoes_of_what_the_map_does_not_know_make_it_unsure_after_a_while() -> None:
    localiser = Localiser(Field(HALL))
    localiser.place(Pose2(0.0, 0.0, 0.0), spread=0.1, turn=0.1)
    for _ in range(UNSURE_AFTER - 1):
        localiser.correct_by_echoes(np.full((30, 3, 2), 0.8))
    assert localiser.sure
    localiser.correct_by_echoes(np.full((30, 3, 2), 0.8))
    assert not localiser.sure


def arcs(pose: Pose2, count: int = 24) -> NDArray[np.float64]:
    """Ends of cones all round, each as far as the nearest wall of the hall in it, in the frame of `pose`."""
    ends = []
    for bearing in np.linspace(-3.1, 3.1, count):
        angles = bearing + np.linspace(-0.2, 0.2, 8)
        c, s = np.cos(angles + pose.yaw), np.sin(angles + pose.yaw)
        to_x = np.where(c > 0, EAST - pose.x, -EAST - pose.x) / c
        to_y = np.where(s > 0, NORTH - pose.y, -NORTH - pose.y) / s
        reach = np.minimum(to_x, to_y).min()
        ends.append(np.column_stack([reach * np.cos(angles), reach * np.sin(angles)]))
    return np.array(ends)


@pytest.mark.parametrize("seed", range(8))
def test_the_worst_direction_is_the_larger_axis_of_the_ellipse_however_it_lies(seed: int) -> None:
    root = np.random.default_rng(seed).normal(size=(3, 3)) * 10.0 ** (seed - 4)
    covariance = root @ root.T
    axes = np.linalg.eigvalsh(covariance[:2, :2])
    assert scan_matching._worst(covariance) == pytest.approx(axes[-1], rel=1e-12)


def test_a_place_known_for_sure_has_no_spread_and_one_known_across_has_that_of_it() -> None:
    assert scan_matching._worst(np.zeros((3, 3))) == 0.0
    assert scan_matching._worst(np.diag([0.01, 0.09, 4.0])) == pytest.approx(0.09)
