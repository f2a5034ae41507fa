"""The pose that is sent when the operator points at where the robot is."""

from __future__ import annotations

import math

import pytest

from app.session.initial_pose import initial_pose
from bridge.msgs.std_msgs import Time


def test_it_carries_place_heading_frame_and_instant() -> None:
    message = initial_pose(1.5, -2.0, 0.5, 100.25)
    pose = message.pose.pose
    assert (pose.position.x, pose.position.y, pose.position.z) == (1.5, -2.0, 0.0)
    assert pose.orientation.yaw == pytest.approx(0.5)
    assert (message.header.frame_id, message.header.stamp.seconds) == ("map", 100.25)


def test_its_variance_is_that_of_a_finger() -> None:
    covariance = initial_pose(0.0, 0.0, 0.0, 1.0).pose.covariance
    assert len(covariance) == 36
    assert {index: value for index, value in enumerate(covariance) if value} == {0: 0.25, 7: 0.25, 35: 0.07}


def test_it_has_no_stamp_while_the_robots_clock_is_unknown() -> None:
    assert initial_pose(0.0, 0.0, 0.0, math.nan).header.stamp == Time()
