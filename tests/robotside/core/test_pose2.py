"""Poses in the plane."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Point, Pose, Quaternion
from robotside.core.pose2 import Pose2


def test_poses_are_carried_between_frames_and_back() -> None:
    robot, seen = Pose2(1.0, 2.0, math.pi / 2), Pose2(3.0, 0.0, 0.1)
    there = robot.then(seen)
    assert there == pytest.approx((1.0, 5.0, math.pi / 2 + 0.1))
    assert there.since(robot) == pytest.approx(seen)
    assert Pose2.from_msg(there.to_msg()) == pytest.approx(there)
    assert robot.bearing(1.0, 5.0) == pytest.approx(0.0)


@pytest.mark.parametrize("yaw", [0.0, 0.7, 2.9, -2.2])
@pytest.mark.parametrize("roll", [-math.pi / 6, 0.0, math.pi / 6])
@pytest.mark.parametrize("pitch", [-math.pi / 6, math.pi / 6])
def test_a_pose_in_space_is_seen_from_above_by_where_its_nose_points(
    roll: float, pitch: float, yaw: float
) -> None:
    turned = Quaternion.from_rpy(roll, pitch, yaw)
    seen = Pose2.from_msg(Pose(Point(1.0, 2.0, 3.0), turned))
    x, y, z, w = turned.x, turned.y, turned.z, turned.w
    nose = (1 - 2 * (y * y + z * z), 2 * (x * y + w * z))
    assert seen == pytest.approx((1.0, 2.0, math.atan2(nose[1], nose[0])))
    assert seen.yaw == pytest.approx(yaw)
