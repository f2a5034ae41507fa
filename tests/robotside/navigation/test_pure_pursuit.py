"""Staying on a path and arriving."""

from __future__ import annotations

import math

import numpy as np
import pytest

from robotside.core.pose2 import Pose2
from robotside.navigation.planner import resampled
from robotside.navigation.pure_pursuit import GOAL_TOLERANCE, MIN_SPEED, PathFollower

STRAIGHT = resampled(np.array([[0.0, 0.0], [10.0, 0.0]]))
CORNER = resampled(np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]]))


def drive(follower: PathFollower, pose: Pose2, seconds: float = 60.0) -> tuple[Pose2, float, float]:
    """Drives exactly as told until it arrives: where it is then, how far it strayed, how fast it was."""
    astray = fastest = speed = 0.0
    for _ in range(int(seconds / 0.05)):
        if follower.arrived(pose):
            return pose, astray, fastest
        distance, bearing = follower.aim(pose, speed)
        speed = follower.speed(pose, bearing, distance)
        rate = speed * 2.0 * math.sin(bearing) / distance
        pose = pose.then(Pose2(speed * 0.05, 0.0, rate * 0.05))
        astray = max(astray, float(np.hypot(*(follower.path - pose[:2]).T).min()))
        fastest = max(fastest, speed)
    raise AssertionError("it never arrived")


def test_a_straight_path_is_followed_at_cruising_speed_to_its_end() -> None:
    pose, astray, fastest = drive(PathFollower(STRAIGHT, cruise=0.6), Pose2(0.0, 0.0, 0.0))
    assert pose.distance(10.0, 0.0) < GOAL_TOLERANCE + 0.02
    assert astray < 0.06
    assert fastest == pytest.approx(0.6)


def test_a_path_is_found_again_from_beside_it() -> None:
    pose, _, _ = drive(PathFollower(STRAIGHT, cruise=0.6), Pose2(0.0, 0.5, 0.3))
    assert pose.distance(10.0, 0.0) < GOAL_TOLERANCE + 0.02


def test_a_corner_is_cut_only_a_little_and_taken_more_slowly() -> None:
    follower = PathFollower(CORNER, cruise=0.6)
    pose, astray, _ = drive(follower, Pose2(0.0, 0.0, 0.0))
    assert pose.distance(4.0, 4.0) < GOAL_TOLERANCE + 0.02
    assert astray < 0.35
    assert PathFollower(CORNER, cruise=0.6).speed(Pose2(3.6, 0.0, 0.0), 0.8, 0.6) < 0.6


def test_it_slows_down_before_the_end() -> None:
    follower = PathFollower(STRAIGHT, cruise=0.6)
    for _ in range(100):
        follower.aim(Pose2(9.8, 0.0, 0.0), 0.0)
    assert MIN_SPEED <= follower.speed(Pose2(9.8, 0.0, 0.0), 0.0, 0.2) < 0.5


def test_the_way_left_shrinks_to_nothing() -> None:
    follower = PathFollower(CORNER, cruise=0.6)
    assert follower.remaining(Pose2(0.0, 0.0, 0.0)) == pytest.approx(8.0)
    for x in np.arange(0.0, 4.1, 0.5):
        follower.aim(Pose2(float(x), 0.0, 0.0), 0.3)
    assert follower.remaining(Pose2(4.0, 0.0, 0.0)) == pytest.approx(4.0, abs=0.11)


def test_a_goal_that_was_passed_closely_counts_as_reached() -> None:
    follower = PathFollower(STRAIGHT, cruise=0.6)
    assert not follower.arrived(Pose2(9.9, 0.15, 0.0))
    assert follower.arrived(Pose2(10.0, 0.21, 0.0)) is follower.arrived(Pose2(10.05, 0.21, 0.0))
    assert not PathFollower(STRAIGHT, cruise=0.6).arrived(Pose2(9.5, 0.0, 0.0))


def test_a_way_that_begins_far_behind_is_joined_beside_the_robot() -> None:
    path = resampled(np.array([[0.0, 0.0], [20.0, 0.0]]))
    follower = PathFollower(path, cruise=0.6)
    distance, bearing = follower.aim(Pose2(7.0, 0.0, 0.0), 0.0)
    assert bearing == pytest.approx(0.0)
    assert distance == pytest.approx(0.5, abs=0.11)
    assert follower.remaining(Pose2(7.0, 0.0, 0.0)) == pytest.approx(13.0, abs=0.1)
