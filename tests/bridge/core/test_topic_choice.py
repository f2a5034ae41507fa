"""Which topic of a strange robot is which of ours, for the handheld and the robot side alike."""

from __future__ import annotations

import math

import pytest

from app.link.capabilities import Capabilities
from bridge.core.topic_choice import CAMERA, Command, command, drive_message, source
from bridge.msgs import ros1_name
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.std_msgs import Header, Time
from robotside.foreign.foreign_topics import match

SCAN, MAP, PICTURE = "sensor_msgs/LaserScan", "nav_msgs/OccupancyGrid", "sensor_msgs/CompressedImage"
TWIST, STAMPED = "geometry_msgs/Twist", "geometry_msgs/TwistStamped"


def among(ours: str, kind: str, *names: str) -> str:
    return source(ours, kind, dict.fromkeys(names, kind))


@pytest.mark.parametrize(
    ("ours", "kind", "names", "chosen"),
    [
        ("/scan", SCAN, ("/front/laser", "/scan"), "/scan"),
        ("/scan", SCAN, ("/scan_front", "/base_scan"), "/base_scan"),
        ("/scan", SCAN, ("/scan_rear", "/scan_front"), "/scan_front"),
        ("/scan", SCAN, ("/lidar", "/a_long_scan"), "/a_long_scan"),
        ("/scan", SCAN, ("/rear/laser", "/front"), "/front"),
        ("/odom", "nav_msgs/Odometry", ("/ground_truth/odom", "/wheels/odom"), "/wheels/odom"),
        (CAMERA, PICTURE, ("/front/camera_depth/compressed",), ""),
        (CAMERA, PICTURE, ("/a/depth/compressed", "/much/longer/picture"), "/much/longer/picture"),
        ("/map", MAP, ("/local_costmap/costmap",), ""),
        ("/plan", "nav_msgs/Path", ("/move_base/local_plan",), ""),
        ("/pose", "geometry_msgs/PoseWithCovarianceStamped", ("/initialpose",), ""),
        ("/robot/info", "pilothouse_msgs/RobotInfo", ("/rex/robot/info",), ""),
        ("/range/front", "sensor_msgs/Range", ("/sonar",), "/sonar"),
        ("/range/left", "sensor_msgs/Range", ("/sonar",), ""),
    ],
)
def test_the_usual_name_then_the_type_and_what_the_name_says(
    ours: str, kind: str, names: tuple[str, ...], chosen: str
) -> None:
    assert among(ours, kind, *names) == chosen


def test_a_usual_name_of_another_type_is_not_taken() -> None:
    assert source("/scan", SCAN, {"/scan": "sensor_msgs/PointCloud2", "/lidar": SCAN}) == "/lidar"


def test_what_only_bears_a_usual_name_is_taken_for_what_it_is() -> None:
    assert source("/imu/data", "sensor_msgs/Imu", {"/scan": "sensor_msgs/Imu"}) == "/scan"


@pytest.mark.parametrize(
    ("topics", "chosen"),
    [
        ({"/cmd_vel": STAMPED}, Command("/cmd_vel", True)),
        ({"/cmd_vel": STAMPED, "/a/cmd_vel": TWIST}, Command("/cmd_vel", True)),
        ({"/a/cmd_vel": STAMPED, "/much/longer/cmd_vel": TWIST}, Command("/much/longer/cmd_vel", False)),
        ({"/robot/teleop": TWIST}, Command("/robot/teleop", False)),
        ({"/teleop": TWIST, "/base/cmd_vel": STAMPED}, Command("/base/cmd_vel", True)),
        ({"/cmd_vel": "std_msgs/String"}, None),
        ({"/measured_speed": TWIST, "/odom_vel": STAMPED}, None),
        ({}, None),
    ],
)
def test_it_is_driven_where_the_name_says_so(topics: dict[str, str], chosen: Command | None) -> None:
    assert command(topics) == chosen


def test_a_stamped_command_carries_the_robots_clock_where_it_is_known() -> None:
    twist = Twist.planar(0.3, 0.1)
    assert drive_message(twist, 12.5, stamped=False) == twist
    told = drive_message(twist, 12.5, stamped=True)
    assert told == TwistStamped(Header(Time.at(12.5), "base_link"), twist)
    assert drive_message(twist, math.nan, stamped=True) == TwistStamped(Header(Time(), "base_link"), twist)


CROWD = {
    "/local_costmap/costmap": "nav_msgs/msg/OccupancyGrid",
    "/front/camera_depth/compressed": "sensor_msgs/msg/CompressedImage",
    "/rear/laser": "sensor_msgs/msg/LaserScan",
    "/laser_front": "sensor_msgs/msg/LaserScan",
    "/ground_truth/odom": "nav_msgs/msg/Odometry",
    "/wheel_odom": "nav_msgs/msg/Odometry",
    "/robot/teleop": "geometry_msgs/msg/Twist",
    "/power": "sensor_msgs/msg/BatteryState",
}


def test_the_handheld_and_the_robot_side_choose_alike() -> None:
    types = {name: ros1_name(kind) for name, kind in CROWD.items()}
    offer, found = Capabilities.of(types, frozenset()), match(CROWD)
    assert (found.command, found.stamped) == (offer.drive, offer.stamped) == ("/robot/teleop", False)
    for ours in ("/odom", "/scan", "/map", CAMERA, "/battery_state", "/imu/data", "/fix", "/robot/info"):
        assert found.topics.get(ours, (None,))[0] == offer.source(ours), ours
    assert (offer.source("/map"), offer.source(CAMERA)) == (None, None)
    assert offer.source("/scan") == "/laser_front"
