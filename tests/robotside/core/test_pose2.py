"""Poses in the plane."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import Pose2


def test_poses_are_carried_between_frames_and_back() -> None:
    robot, seen = Pose2(1.0, 2.0, math.pi / 2), Pose2(3.0, 0.0, 0.1)
    there = robot.then(seen)
    assert there == pytest.approx((1.0, 5.0, math.pi / 2 + 0.1))
    assert there.since(robot) == pytest.approx(seen)
    assert Pose2.from_msg(there.to_msg()) == pytest.approx(there)
    assert robot.bearing(1.0, 5.0) == pytest.approx(0.0)
