"""Boxes in a picture are red where the robot counts an intruder, on every screen that has the camera's picture."""

from __future__ import annotations

import math
from typing import Any

import pytest

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray, RobotInfo
from bridge.msgs.std_msgs import Header, Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

INFO = RobotInfo(name="Fake-1", kind="wheels", max_speed=0.8, camera_fov=1.2)
FOUND = IntruderArray(
    intruders=[
        Intruder(1, "cone", Point(3.0, 3.0), Time.at(90.0)),
        Intruder(2, "person", Point(0.0, 4.0), Time.at(95.0)),
        Intruder(3, "person", Point(math.nan, 4.0), Time.at(96.0)),
    ]
)


def at(yaw: float = 0.0) -> PoseWithCovarianceStamped:
    pose = Pose(Point(), Quaternion.from_yaw(yaw))
    return PoseWithCovarianceStamped(Header(Time.at(100.0)), PoseWithCovariance(pose))


@pytest.mark.parametrize("name", ["drive", "mission"])
def test_the_picture_is_told_where_each_intruder_is_that_the_robot_counts(
    driving: Glass, robot: FakeRobot, name: str
) -> None:
    driving.app.show(name)
    screen: Any = driving.app.screens[name]
    robot.publish("/robot/info", INFO)
    robot.publish("/intruders", FOUND)
    driving.until(lambda: robot.publish("/pose", at()) or screen.video.counted, "nothing is counted")
    assert list(screen.video.counted) == [pytest.approx(math.pi / 4), pytest.approx(math.pi / 2)]
    assert screen.video.field_of_view == pytest.approx(1.2)
    driving.until(
        lambda: robot.publish("/pose", at(math.pi / 2)) or screen.video.counted[0] < 0,
        "does not turn with it",
    )
    robot.publish("/intruders", IntruderArray())
    driving.until(lambda: robot.publish("/pose", at()) or not screen.video.counted, "counted still")


def test_by_a_place_of_the_robot_that_is_old_no_box_is_said_to_be_an_intruder(
    driving: Glass, robot: FakeRobot
) -> None:
    driving.app.show("mission")
    screen: Any = driving.app.screens["mission"]
    robot.publish("/robot/info", INFO)
    robot.publish("/intruders", FOUND)
    driving.until(lambda: robot.publish("/pose", at()) or screen.video.counted, "nothing is counted")
    driving.until(lambda: not screen.video.counted, "an old place is believed")
