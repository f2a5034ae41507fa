"""What a robot offers, and which of its topics take the place of the usual ones."""

from __future__ import annotations

from typing import Any

import pytest

from app.link.capabilities import CAMERA, Capabilities, ask_capabilities
from bridge.core.errors import NoReply, NotConnected, ProtocolError, Refused
from bridge.core.topics import TOPICS
from tests.app import virtual

OURS = {entry.name: entry.type.MSGTYPE for entry in TOPICS}
BOT = {
    "/odom": "nav_msgs/Odometry",
    "/imu": "sensor_msgs/Imu",
    "/scan_rear": "sensor_msgs/LaserScan",
    "/scan_front": "sensor_msgs/LaserScan",
    "/amcl_pose": "geometry_msgs/PoseWithCovarianceStamped",
    "/initialpose": "geometry_msgs/PoseWithCovarianceStamped",
    "/map": "nav_msgs/OccupancyGrid",
    "/camera/depth/image/compressed": "sensor_msgs/CompressedImage",
    "/camera/rgb/image_raw/compressed": "sensor_msgs/CompressedImage",
    "/cmd_vel": "geometry_msgs/Twist",
}


def strange(**topics: str) -> Capabilities:
    return Capabilities.of({f"/{name}": kind for name, kind in topics.items()}, frozenset())


def test_a_robot_of_ours_has_the_usual_names_and_lacks_nothing() -> None:
    offer = Capabilities.of(OURS, frozenset({"/stop", "/task/start"}))
    assert offer.ours
    assert offer.sentence == ""
    assert (offer.source("/scan"), offer.drive) == ("/scan", "/cmd_vel")
    assert offer.serves("/task/start")
    assert not offer.serves("/mission/set")


def test_a_stop_without_a_status_that_confirms_it_is_none_of_ours() -> None:
    assert not Capabilities.of(BOT, frozenset({"/stop"})).ours
    assert not Capabilities.of(OURS, frozenset()).ours


def test_the_type_decides_where_the_usual_name_is_missing() -> None:
    offer = Capabilities.of(BOT, frozenset())
    assert offer.source("/imu/data") == "/imu"
    assert offer.source("/scan") == "/scan_front"
    assert offer.source("/pose") == "/amcl_pose"
    assert offer.source(CAMERA) == "/camera/rgb/image_raw/compressed"
    assert offer.source("/fix") is None
    assert offer.source("/mission") is None
    assert "no Pilothouse services" in offer.sentence


def test_the_usual_name_with_another_type_is_not_taken() -> None:
    offer = strange(scan="sensor_msgs/PointCloud2", lidar="sensor_msgs/LaserScan")
    assert offer.source("/scan") == "/lidar"


def test_what_is_told_to_the_robot_is_no_measurement() -> None:
    assert strange(initialpose="geometry_msgs/PoseWithCovarianceStamped").source("/pose") is None


@pytest.mark.parametrize(
    ("ours", "kind", "name"),
    [
        (CAMERA, "sensor_msgs/CompressedImage", "/camera/depth/compressed"),
        ("/map", "nav_msgs/OccupancyGrid", "/move_base/global_costmap/costmap"),
        ("/plan", "nav_msgs/Path", "/move_base/local_plan"),
    ],
)
def test_what_only_looks_alike_is_not_shown(ours: str, kind: str, name: str) -> None:
    assert Capabilities.of({name: kind}, frozenset()).source(ours) is None


@pytest.mark.parametrize(
    ("twists", "drive"),
    [
        (["/turtle1/vel_est", "/turtle1/cmd_vel"], "/turtle1/cmd_vel"),
        (["/mux/teleop", "/cmd_vel", "/a/cmd_vel"], "/cmd_vel"),
        (["/joy_vel", "/b/cmd_vel", "/robot/long/cmd_vel"], "/b/cmd_vel"),
        (["/measured_speed"], None),
        ([], None),
    ],
)
def test_it_is_driven_by_a_topic_that_says_so_and_by_no_measurement(
    twists: list[str], drive: str | None
) -> None:
    assert Capabilities.of(dict.fromkeys(twists, "geometry_msgs/Twist"), frozenset()).drive == drive


def test_what_was_chosen_is_kept_though_our_own_wishes_appear_in_the_list() -> None:
    before = Capabilities.of({"/imu": "sensor_msgs/Imu", "/b/cmd_vel": "geometry_msgs/Twist"}, frozenset())
    later = {**before.topics, "/imu/data": "sensor_msgs/Imu", "/cmd_vel": "geometry_msgs/Twist"}
    kept = Capabilities.of(later, frozenset(), before)
    assert (kept.source("/imu/data"), kept.drive) == ("/imu", "/b/cmd_vel")
    gone = Capabilities.of(
        {"/imu/data": "sensor_msgs/Imu", "/cmd_vel": "geometry_msgs/Twist"}, frozenset(), before
    )
    assert (gone.source("/imu/data"), gone.drive) == ("/imu/data", "/cmd_vel")


def test_odometry_tells_the_place_only_where_no_map_could_be_wrong_about_it() -> None:
    assert strange(odom="nav_msgs/Odometry").pose_by_odometry
    assert not strange(odom="nav_msgs/Odometry", map="nav_msgs/OccupancyGrid").pose_by_odometry
    assert not Capabilities.of(BOT, frozenset()).pose_by_odometry
    assert not Capabilities.of(OURS, frozenset({"/stop"})).pose_by_odometry


def asked(topics: Any, services: Any) -> Capabilities:
    async def call(service: str, request: None, response: Any, *, timeout: float) -> Any:
        found = topics if service == "/rosapi/topics" else services
        if isinstance(found, Exception):
            raise found
        return response(**found)

    return virtual.run(ask_capabilities(call))


def test_both_spellings_of_a_type_are_one() -> None:
    offer = asked({"topics": ["/imu"], "types": ["sensor_msgs/msg/Imu"]}, {"services": ["/beep"]})
    assert offer.topics == {"/imu": "sensor_msgs/Imu"}
    assert offer.services == {"/beep"}


@pytest.mark.parametrize("no", [Refused("Service does not exist"), ProtocolError("That is no list.")])
def test_a_robot_without_rosapi_is_tried_by_the_usual_names(no: Exception) -> None:
    offer = asked(no, no)
    assert not offer.rosapi
    assert not offer.ours
    assert (offer.source("/scan"), offer.drive) == ("/scan", "/cmd_vel")
    assert "lists no services" in offer.sentence


def test_a_robot_that_tells_its_topics_alone_has_no_services() -> None:
    offer = asked({"topics": ["/imu"], "types": ["sensor_msgs/Imu"]}, Refused("no"))
    assert (offer.rosapi, offer.services) == (True, frozenset())


@pytest.mark.parametrize("trouble", [NoReply("too late"), NotConnected("cut"), RuntimeError("a fault")])
def test_no_answer_is_no_knowledge(trouble: Exception) -> None:
    with pytest.raises(type(trouble)):
        asked({"topics": [], "types": []}, trouble)
