from __future__ import annotations

import math

import pytest

from app.maps.robot_place import MAX_DRIFT, PLACE_PERIOD, RobotPlace
from bridge.core.geo import Datum
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import NavSatFix, NavSatStatus

HERE = Datum(45.5, -73.5)


def fix(east: float, north: float, status: int = 0) -> NavSatFix:
    latitude, longitude = HERE.to_geographic(east, north)
    return NavSatFix(latitude=latitude, longitude=longitude, status=NavSatStatus(status=status))


def pose(x: float, y: float) -> PoseWithCovarianceStamped:
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, y))))


def test_a_robot_that_tells_its_maps_origin_is_believed_more_than_its_fix():
    place = RobotPlace()
    assert place.look(RobotInfo(latitude=45.5, longitude=-73.5), fix(500, 0), pose(0, 0))
    assert (place.datum.latitude, place.datum.longitude) == (45.5, -73.5)
    assert not place.look(RobotInfo(latitude=45.5, longitude=-73.5), fix(900, 0), pose(0, 0))


def test_without_that_a_fix_and_the_pose_of_that_moment_tell_it():
    place = RobotPlace()
    assert not place.look(RobotInfo(latitude=math.nan, longitude=math.nan), fix(30, 20), None)
    assert place.look(None, fix(30, 20), pose(30, 20))
    assert place.datum.to_local(45.5, -73.5) == pytest.approx((0, 0), abs=0.01)


def test_the_noise_of_a_fix_does_not_shift_the_map_and_a_robot_carried_elsewhere_does():
    now = [0.0]
    place = RobotPlace(lambda: now[0])
    place.look(None, fix(0, 0), pose(0, 0))
    now[0] = PLACE_PERIOD
    assert not place.look(None, fix(MAX_DRIFT - 1, 0), pose(0, 0))
    assert place.look(None, fix(4000, 0), pose(0, 0))
    assert place.datum.to_local(*HERE.to_geographic(4000, 0)) == pytest.approx((0, 0), abs=0.01)


def test_a_place_that_jumps_with_every_message_moves_the_map_only_now_and_then():
    now = [0.0]
    place = RobotPlace(lambda: now[0])
    moved = 0
    for number in range(101):  # ten seconds of a robot that tells ten places a second
        now[0] = number / 10
        moved += place.look(RobotInfo(latitude=45.0 + number % 2, longitude=-73.5), None, None)
    assert moved <= 1 + 10 / PLACE_PERIOD
    now[0] += PLACE_PERIOD
    place.look(RobotInfo(latitude=47.0, longitude=8.0), None, None)
    assert (place.datum.latitude, place.datum.longitude) == (47.0, 8.0), "where it comes to rest is believed"


@pytest.mark.parametrize(
    ("told", "at"),
    [
        (fix(0, 0, status=-1), pose(0, 0)),
        (NavSatFix(latitude=math.nan, longitude=0.0), pose(0, 0)),
        (NavSatFix(latitude=91.0, longitude=0.0), pose(0, 0)),
        (fix(0, 0), pose(math.nan, 0)),
    ],
)
def test_what_is_no_place_tells_nothing(told, at):
    place = RobotPlace()
    assert not place.look(None, told, at)
    assert place.datum is None
