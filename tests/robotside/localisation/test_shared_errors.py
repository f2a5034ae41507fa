"""Sweeps whose errors are alike do not make a place surer and surer."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Pose2
from robotside.localisation.field import Field
from robotside.localisation.scan_matching import Localiser
from robotside.localisation.shared_errors import freshness, fused, pooled
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from tests.fakes import Box, FakeRobot


def spread_matrix(seed: int) -> np.ndarray:
    root = np.random.default_rng(seed).normal(size=(3, 3))
    return np.asarray(root @ root.T + 0.1 * np.eye(3))


@pytest.mark.parametrize("seed", range(5))
def test_a_sweep_that_is_all_new_is_taken_as_a_kalman_filter_takes_it(seed: int) -> None:
    prior, sweep = spread_matrix(seed), spread_matrix(seed + 10)
    covariance, part = fused(prior, sweep, 1.0)
    gains = np.linalg.eigvals(prior @ sweep)
    if (gains < 1.0).all():
        assert np.linalg.inv(covariance) == pytest.approx(np.linalg.inv(prior) + sweep)
        assert part == pytest.approx(np.eye(3))
    assert (np.linalg.eigvalsh(covariance) > 0.0).all()


@pytest.mark.parametrize("seed", range(5))
def test_the_same_sweep_again_changes_nothing_and_no_order_of_them_makes_more_of_it(seed: int) -> None:
    prior, sweep = spread_matrix(seed), 4.0 * spread_matrix(seed + 10)
    once, _ = fused(prior, sweep, 0.0)
    again, part = fused(once, sweep, 0.0)
    assert again == pytest.approx(once)
    assert part == pytest.approx(np.zeros((3, 3)), abs=1e-6)
    better_of_both = np.linalg.inv(prior) + sweep
    assert (np.linalg.eigvalsh(better_of_both - np.linalg.inv(once)) > -1e-9).all()


def test_along_a_wall_that_tells_nothing_of_it_the_prior_is_kept() -> None:
    covariance, part = fused(np.diag([0.01, 0.01, 0.01]), np.diag([0.0, 1e4, 0.0]), 0.0)
    assert np.diag(covariance) == pytest.approx([0.01, 1e-4, 0.01], rel=1e-6)
    assert part[1, 1] == pytest.approx(1.0, abs=0.02)


def test_of_alike_measurements_each_tells_what_theory_says_and_far_ones_all() -> None:
    assert freshness(0.0) == 0.0
    assert freshness(math.inf) == 1.0
    # the mean of n values that are alike by r from one to the next has the variance (1 + r) / (1 - r) / n, for many
    r, n = math.exp(-0.05), 4000
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    variance = float((r**apart).mean())
    assert freshness(0.1) == pytest.approx(1.0 / (n * variance), rel=0.02)


def test_a_robot_that_stands_is_no_surer_after_a_hundred_sweeps_than_its_map_is_fine() -> None:
    robot = FakeRobot(
        start=(1.03, -1.02, 0.7), boxes=[Box(3.0, -4.0, 4.0, -2.0), Box(-4.03, 2.03, -2.0, 4.0)]
    )
    points = next(LaserProjection().points(msg) for _, msg in robot.read(0.0) if isinstance(msg, LaserScan))
    localiser = Localiser(Field(Grid.from_msg(robot.map())))
    localiser.place(Pose2(1.1, -1.1, 0.65), spread=0.1, turn=0.05)
    rng = np.random.default_rng(1)
    for _ in range(100):
        localiser.correct(points + rng.normal(0.0, 0.01, points.shape))
    pose = localiser.pose
    assert pose is not None
    off = np.array([pose.x - 1.03, pose.y + 1.02, pose.yaw - 0.7])
    assert math.sqrt(localiser.covariance[0, 0]) > 0.01
    assert off @ np.linalg.solve(localiser.covariance, off) < 11.3  # chi square of 3, 99 %
    assert np.hypot(off[0], off[1]) < 0.03  # though all walls are drawn half a cell behind where they are


def test_a_hundred_points_of_one_wall_tell_no_better_than_the_wall_is_drawn() -> None:
    jacobian = np.column_stack([np.ones(100), np.zeros((100, 2)), -np.ones(100)])
    _, information = pooled(jacobian, np.full(100, 0.02), np.full(100, 1e4), np.zeros(100), 0.03)
    assert information[0, 0] ** -0.5 == pytest.approx(0.03, rel=0.01)


def test_opposite_walls_are_drawn_off_each_for_itself_and_their_points_still_tell_the_yaw() -> None:
    lever = np.linspace(-2.0, 2.0, 100)
    facing = np.repeat([0.0, math.pi], 50)
    side = np.cos(facing)
    jacobian = np.column_stack([side, np.zeros(100), side * lever, -np.ones(100)])
    gradient, information = pooled(jacobian, 0.02 * side, np.full(100, 1e4), facing, 0.03)
    assert information[0, 0] ** -0.5 == pytest.approx(0.03 / math.sqrt(2.0), rel=0.01)
    assert information[2, 2] ** -0.5 < 0.005
    assert gradient[0] > 0.0
