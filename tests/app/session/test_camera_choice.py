"""The camera that is watched, of a robot with several, with none, and of one that nothing is known of yet."""

from __future__ import annotations

import pytest

from app.link.capabilities import Capabilities
from app.link.feeds import Feeds, Post
from app.session.camera_choice import CameraChoice
from app.session.robot_profile import RobotProfile
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.vision_msgs import Detection2D, Detection2DArray


class Robot:
    def __init__(self) -> None:
        self.feeds = Feeds(lambda: 100.0)
        self.profile = RobotProfile(self.feeds, "ws://127.0.0.1:9090")
        self.cameras = CameraChoice(self.profile)

    def has(self, *cameras: str) -> None:
        self.feeds.put("/robot/info", Post(RobotInfo(name="Scout-1", cameras=list(cameras)), 100.0, 1))


@pytest.fixture
def robot() -> Robot:
    return Robot()


def test_what_is_watched_stays_until_the_robot_says_which_cameras_it_has(robot: Robot) -> None:
    assert robot.cameras.wanted("front") == "front"
    robot.has("left", "right")
    assert robot.cameras.wanted("front") == "left"


def test_a_robot_without_a_camera_has_none_to_watch(robot: Robot) -> None:
    robot.has()
    robot.cameras.choose_next()
    assert robot.cameras.wanted("front") is None


def test_after_the_last_camera_comes_the_first(robot: Robot) -> None:
    robot.has("front", "rear")
    seen = []
    for _ in range(3):
        seen.append((robot.cameras.wanted(None), robot.cameras.shows_first))
        robot.cameras.choose_next()
    assert seen == [("front", True), ("rear", False), ("front", True)]


def test_a_chosen_camera_that_is_gone_gives_way_to_the_first(robot: Robot) -> None:
    robot.has("front", "rear")
    robot.cameras.choose_next()
    robot.has("front")
    assert robot.cameras.wanted(None) == "front"


def test_detections_belong_to_the_first_camera_alone(robot: Robot) -> None:
    robot.has("front", "rear")
    found = Detection2DArray(detections=[Detection2D()])
    assert robot.cameras.detections_shown(found) is found
    robot.cameras.choose_next()
    assert robot.cameras.detections_shown(found).detections == []


@pytest.mark.parametrize(
    ("topics", "watched"),
    [
        ({"/camera/image_raw/compressed": "sensor_msgs/CompressedImage"}, ""),
        ({"/odom": "nav_msgs/Odometry"}, None),
    ],
)
def test_a_foreign_robots_picture_is_watched_by_its_topic(
    robot: Robot, topics: dict[str, str], watched: str | None
) -> None:
    robot.profile.capabilities = Capabilities.of(topics, frozenset())
    assert robot.cameras.wanted("front") == watched
    assert robot.cameras.topic == next((name for name in topics if name.endswith("/compressed")), "")


def test_the_topic_that_is_watched_is_known_by_the_robots_name_of_it(robot: Robot) -> None:
    assert robot.cameras.topic == "", "before anything is known of the robot"
    robot.has("front", "down")
    assert robot.cameras.topic == "/camera/image/compressed"
    robot.cameras.choose_next()
    assert robot.cameras.topic == "/camera/down/image/compressed"
    robot.has()
    assert robot.cameras.topic == ""
