"""What the situation knows of the ground below."""

from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Quaternion
from bridge.msgs.sensor_msgs import CompressedImage, Imu, Range
from bridge.msgs.std_msgs import Header, Time
from robotside.autonomy.ground_sight import GroundSight
from robotside.core.pose2 import Pose2
from robotside.core.topic_demand import Demand
from robotside.localisation.odometry_track import OdometryTrack
from robotside.tasks.behaviours.situation import Situation

TOPIC = "/camera/down/image/compressed"


class Below:
    def __init__(self, *cameras: str) -> None:
        self.situation, self.wheels, self.asked = Situation(), OdometryTrack(), list[tuple[str, bool]]()
        demand = Demand(lambda topic, wanted: self.asked.append((topic, wanted)))
        self.sight = GroundSight(cameras, self.situation, self.wheels, demand)

    def picture(self, stamp: float) -> None:
        self.sight.on_message(TOPIC, CompressedImage(Header(Time.at(stamp)), "jpeg", b"picture"))


def test_a_picture_has_the_place_and_the_tilt_of_when_it_was_taken() -> None:
    below = Below("front", "down")
    for stamp, tilt in ((1.0, 0.1), (1.1, 0.2), (1.2, 0.3)):
        below.wheels.add(stamp, Pose2(stamp, 0.0, 0.0))
        turned = Quaternion.from_rpy(tilt, -tilt, 0.5)
        below.sight.on_message("/imu/data", Imu(Header(Time.at(stamp)), turned))
    below.sight.on_message("/range/down", Range(range=1.5))
    below.picture(1.1)
    ground = below.situation.ground
    assert (ground.picture, ground.below) == (b"picture", 1.5)
    assert (ground.roll, ground.pitch) == pytest.approx((0.2, -0.2))
    assert ground.wheels.x == pytest.approx(1.1)
    assert below.situation.below == 1.5


def test_pictures_are_asked_for_only_while_they_are_wanted() -> None:
    below = Below("front", "down")
    for wanted in (False, True, True, False):
        below.situation.looks_down = wanted
        below.sight.update()
    assert below.asked == [(TOPIC, True), (TOPIC, False)]


def test_a_robot_without_such_a_camera_is_asked_for_nothing() -> None:
    below = Below("front")
    below.situation.looks_down = True
    below.sight.update()
    below.picture(1.0)
    assert not below.asked
    assert not below.situation.ground.picture
