"""The list of topics and the one that is open, as the operator reads them."""

from __future__ import annotations

import math
from types import SimpleNamespace

import pytest

from app.link.capabilities import Capabilities
from app.link.channels import CAPABILITIES, LINK, SEEN
from app.link.feeds import Feeds, Post
from app.link.subscriptions import Seen
from app.session.topic_list import TopicListing
from bridge.core.topics import TOPICS
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.sensor_msgs import Imu, LaserScan

FOREIGN = Capabilities.of(
    {
        "/scan_front": "sensor_msgs/LaserScan",
        "/imu": "sensor_msgs/Imu",
        "/cmd_vel": "geometry_msgs/Twist",
        "/gripper": "acme_msgs/Gripper",
    },
    frozenset({"/beep"}),
)
OURS = Capabilities.of({entry.name: entry.type.MSGTYPE for entry in TOPICS}, frozenset({"/stop"}))


class Robot:
    """A session without a link: the test says what was offered and what came."""

    def __init__(self, offer: Capabilities | None = FOREIGN) -> None:
        self.time = 10.0
        self.asked: list[tuple[str, ...]] = []
        self.robot, self.connected = SimpleNamespace(capabilities=offer), True
        self.feeds = Feeds(self.now)
        self.feeds.link(True)
        self.link = SimpleNamespace(
            inspect=lambda *what: self.asked.append(("look", *what)),
            end_inspection=lambda: self.asked.append(("look away",)),
            ask_offer=lambda: self.asked.append(("offer",)),
        )
        self.topics = TopicListing(self)  # type: ignore[arg-type]

    def now(self) -> float:
        return self.time

    def say(self, seen: Seen, count: int = 1) -> bool:
        return self.topics.on_post(SEEN, Post(seen, self.time, count))


def test_the_list_tells_names_types_and_uses_in_their_order() -> None:
    lines = Robot().topics.lines()
    assert [(line.name, line.type, line.use) for line in lines] == [
        ("/cmd_vel", "geometry_msgs/Twist", "drives it"),
        ("/gripper", "acme_msgs/Gripper", ""),
        ("/imu", "sensor_msgs/Imu", "horizon"),
        ("/scan_front", "sensor_msgs/LaserScan", "laser"),
    ]


def test_rate_and_age_are_told_of_what_is_listened_to() -> None:
    robot = Robot()
    for step in range(25):
        robot.time = 10.0 + step / 20
        robot.feeds.put("/imu/data", Post(Imu(), robot.time, 1))
    line = next(line for line in robot.topics.lines() if line.name == "/imu")
    assert line.rate == pytest.approx(20.0, rel=0.1)
    assert (line.age, line.state) == (0.0, "live")
    other = next(line for line in robot.topics.lines() if line.name == "/scan_front")
    assert (math.isnan(other.rate), math.isnan(other.age), other.state) == (True, True, "")


@pytest.mark.parametrize(
    ("search", "found"),
    [("SCAN", ["/scan_front"]), ("sensor_msgs", ["/imu", "/scan_front"]), ("sensor imu", ["/imu"]), ("", 4)],
)
def test_the_search_looks_into_names_and_types(search: str, found: object) -> None:
    topics = Robot().topics
    topics.search = search
    names = [line.name for line in topics.lines()]
    assert found in (names, len(names))


def test_each_way_of_having_nothing_has_its_sentence() -> None:
    robot = Robot(None)
    assert robot.topics.sentence == "Asking the robot for its topics …"
    robot.connected = False
    assert robot.topics.sentence == "There is no connection."
    robot.robot.capabilities = Capabilities({}, frozenset(), rosapi=False)
    assert robot.topics.sentence == "This robot lists no topics: it runs no rosapi."
    assert robot.topics.summary == ""
    robot.robot.capabilities = Capabilities({}, frozenset())
    assert robot.topics.sentence == "This robot has no topics."
    robot.robot.capabilities, robot.topics.search = FOREIGN, " boat "
    assert robot.topics.sentence == "No topic has “boat” in its name or type."
    robot.topics.search = ""
    assert (robot.topics.sentence, robot.topics.summary) == ("", "4 topics, 1 service")


def test_the_list_is_asked_for_again_while_it_is_looked_at() -> None:
    robot = Robot()
    for _ in range(70):
        robot.topics.tick()
        robot.time += 0.1
    assert robot.asked == [("offer",)] * 3


def test_a_topic_is_listened_to_from_opening_to_closing() -> None:
    robot = Robot()
    robot.topics.open("/imu")
    assert robot.asked == [("look", "/imu", "sensor_msgs/Imu")]
    assert robot.topics.notice == "Learning sensor_msgs/Imu …"
    assert robot.say(Seen("/imu", kind=Imu))
    assert robot.topics.notice == "Nothing has come yet on /imu."
    for _ in range(2):
        robot.time += 1.1
        robot.say(Seen("/imu", Imu()))
    assert (robot.topics.notice, robot.topics.state, robot.topics.message) == ("", "live", Imu())
    robot.time += 3.5
    assert (robot.topics.state, robot.topics.age) == ("stale", pytest.approx(3.5))
    assert math.isnan(robot.topics.rate)
    robot.topics.close()
    assert robot.asked[-1] == ("look away",)
    assert (robot.topics.opened, robot.topics.message, robot.topics.notice) == ("", None, "")
    with pytest.raises(KeyError):
        robot.topics.open("/nothing")


def test_what_still_comes_of_another_topic_is_left_out() -> None:
    robot = Robot()
    robot.topics.open("/imu")
    robot.say(Seen("/imu", kind=Imu))
    assert not robot.say(Seen("/scan_front", LaserScan()))
    assert robot.topics.message is None


def test_a_type_that_cannot_be_shown_and_a_topic_that_went_away_are_said() -> None:
    robot = Robot()
    robot.topics.open("/gripper")
    robot.say(Seen("/gripper", problem="acme_msgs/Gripper cannot be shown."))
    assert robot.topics.notice == "acme_msgs/Gripper cannot be shown."
    robot.topics.on_post(LINK, Post(None, robot.time, 1))
    assert robot.asked[-1] == ("look", "/gripper", "acme_msgs/Gripper"), "tried again with the connection"
    robot.robot.capabilities = Capabilities.of({"/imu": "sensor_msgs/Imu"}, frozenset())
    robot.topics.on_post(CAPABILITIES, Post(robot.robot.capabilities, robot.time, 1))
    assert robot.topics.notice == "The robot no longer offers /gripper."


def test_what_a_robot_of_ours_tells_once_does_not_grow_old() -> None:
    robot = Robot(OURS)
    robot.topics.open("/map")
    robot.say(Seen("/map", kind=OccupancyGrid))
    robot.say(Seen("/map", OccupancyGrid()))
    robot.time += 60.0
    assert (robot.topics.state, robot.topics.age) == ("live", 0.0)
    robot.feeds.link(False)
    robot.time += 2.0
    assert (robot.topics.state, robot.topics.age) == ("stale", pytest.approx(2.0))


def test_what_a_strange_robot_says_once_is_no_fault() -> None:
    robot = Robot()
    robot.topics.open("/gripper")
    robot.say(Seen("/gripper", kind=Twist))
    robot.say(Seen("/gripper", Twist()))
    assert (robot.topics.state, math.isnan(robot.topics.once)) == ("live", True)
    robot.time += 60.0
    assert (robot.topics.state, robot.topics.age, robot.topics.once) == ("live", 0.0, 60.0)
    robot.feeds.link(False)
    robot.time += 2.0
    assert (robot.topics.state, robot.topics.age) == ("stale", pytest.approx(2.0))
    assert math.isnan(robot.topics.once)


def test_what_was_said_once_may_come_twice_to_who_subscribes_and_again_after_a_lost_link() -> None:
    robot = Robot()
    robot.topics.open("/gripper")
    robot.say(Seen("/gripper", kind=Twist))
    for pause in (0.0, 0.4, 30.0, 0.4):
        robot.time += pause
        if pause > 1.0:
            robot.topics.on_post(LINK, Post(None, robot.time, 1))
        robot.say(Seen("/gripper", Twist()), count=2)
    robot.time += 60.0
    assert (robot.topics.state, robot.topics.once) == ("live", 60.0)


def test_a_stream_that_a_lost_link_ended_stays_old_until_it_comes_again() -> None:
    robot = Robot()
    robot.topics.open("/gripper")
    robot.say(Seen("/gripper", kind=Twist))
    for _ in range(30):
        robot.time += 0.1
        robot.say(Seen("/gripper", Twist()))
    robot.time += 20.0
    robot.topics.on_post(LINK, Post(None, robot.time, 1))
    assert (robot.topics.state, robot.topics.age) == ("stale", pytest.approx(20.0))


def test_a_slow_stream_is_given_the_time_that_it_takes() -> None:
    robot = Robot()
    robot.topics.open("/gripper")
    robot.say(Seen("/gripper", kind=Twist))
    for _ in range(2):
        robot.say(Seen("/gripper", Twist()))
        robot.time += 10.0
    assert robot.topics.state == "live"
    robot.time += 20.5
    assert (robot.topics.state, robot.topics.age) == ("stale", pytest.approx(30.5))


def test_the_open_topic_has_its_rate_in_the_list_though_no_screen_shows_it() -> None:
    robot = Robot()
    robot.topics.open("/cmd_vel")
    robot.say(Seen("/cmd_vel", kind=Twist))
    for step in range(30):
        robot.time = 10.0 + step / 10
        robot.say(Seen("/cmd_vel", Twist()))
    line = robot.topics.lines()[0]
    assert (line.rate, line.state, line.use) == (pytest.approx(10.0, rel=0.1), "live", "drives it")
