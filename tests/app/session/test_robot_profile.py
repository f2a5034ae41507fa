"""What one robot says of itself, and what holds before it said anything."""

from __future__ import annotations

import pytest

from app.link.capabilities import Capabilities
from app.link.feeds import Feeds, Post
from app.session.robot_profile import RobotProfile
from bridge.msgs.pilothouse_msgs import RobotInfo

OURS = {"/control/status": "pilothouse_msgs/ControlStatus"}


@pytest.fixture
def feeds() -> Feeds:
    return Feeds(lambda: 100.0)


@pytest.fixture
def robot(feeds: Feeds) -> RobotProfile:
    return RobotProfile(feeds, "ws://192.0.2.7:9090")


def test_it_goes_by_its_address_until_it_gives_a_name(robot: RobotProfile, feeds: Feeds) -> None:
    assert (robot.name, robot.introduced) == ("192.0.2.7", False)
    feeds.put("/robot/info", Post(RobotInfo(name="Scout-1"), 100.0, 1))
    assert (robot.name, robot.introduced) == ("Scout-1", True)


def test_before_its_services_are_known_it_may_have_any(robot: RobotProfile) -> None:
    assert robot.offers("/task/start")
    assert not robot.foreign
    assert not robot.lacks_tasks


def test_a_robot_without_our_topics_is_foreign_and_lacks_tasks(robot: RobotProfile) -> None:
    robot.capabilities = Capabilities({"/odom": "nav_msgs/Odometry"}, frozenset())
    assert robot.foreign
    assert robot.lacks_tasks
    assert not robot.offers("/task/start")


def test_one_of_ours_that_takes_missions_alone_does_not_lack_tasks(robot: RobotProfile) -> None:
    robot.capabilities = Capabilities(OURS, frozenset({"/stop", "/mission/set"}))
    assert not robot.foreign
    assert not robot.lacks_tasks


def test_it_knows_the_tasks_that_it_lists(robot: RobotProfile, feeds: Feeds) -> None:
    feeds.put("/robot/info", Post(RobotInfo(name="Aqua-1", tasks=["hold", "surface"]), 100.0, 1))
    assert robot.knows("hold")
    assert not robot.knows("patrol")
