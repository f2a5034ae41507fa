"""Who gets what, and whether anybody wants it."""

from __future__ import annotations

import pytest

from bridge.codec import Unread
from bridge.core.errors import BridgeError, ProtocolError
from bridge.core.topics import TOPICS
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Event, RobotInfo
from bridge.msgs.std_msgs import String
from bridge.protocol import Subscribed
from bridge.server import switchboard
from bridge.server.flow.priority_lanes import Lane
from bridge.server.switchboard import CAMERA_TOPIC, MAX_TOPICS, Switchboard


class Ear:
    def __init__(self):
        self.heard = []

    def deliver(self, stream, message):
        self.heard.append((stream.topic, message.msg))

    def offer(self, frame):
        self.heard.append(frame)


def want(board, ear, topic, type="", **wishes):
    board.subscribe(ear, topic, Subscribed(topic, **wishes), type)


@pytest.fixture
def demands():
    return []


@pytest.fixture
def board(demands):
    return Switchboard(TOPICS, lambda *demand: demands.append(demand))


def test_a_message_reaches_who_subscribed_and_nobody_else(board):
    wants, other = Ear(), Ear()
    want(board, wants, "/odom")
    want(board, other, "/scan")
    board.publish("/odom", Odometry())
    assert (wants.heard, other.heard) == ([("/odom", Odometry())], [])


def test_a_latched_topic_is_told_at_once_and_with_its_last_message_only(board):
    board.publish("/robot/info", RobotInfo(name="old"))
    board.publish("/robot/info", RobotInfo(name="new"))
    late = Ear()
    want(board, late, "/robot/info")
    assert [msg.name for _, msg in late.heard] == ["new"]


@pytest.mark.parametrize(("topic", "msg"), [("/odom", Odometry()), ("/events", Event())])
def test_streams_and_events_are_not_kept_for_later(board, topic, msg):
    board.publish(topic, msg)
    late = Ear()
    want(board, late, topic)
    assert late.heard == []


def test_demand_is_told_for_the_first_who_comes_and_the_last_who_leaves(board, demands):
    first, second = Ear(), Ear()
    for ear in (first, second):
        want(board, ear, "/odom")
    for ear in (first, second, second):
        board.unsubscribe(ear, "/odom")
    assert demands == [("/odom", True), ("/odom", False)]


def test_watching_a_camera_counts_as_wanting_its_pictures(board, demands):
    watcher, subscriber = Ear(), Ear()
    board.watch(watcher, "front")
    want(board, subscriber, CAMERA_TOPIC)
    board.unwatch(watcher, "front")
    assert demands == [(CAMERA_TOPIC, True)]
    board.unsubscribe(subscriber, CAMERA_TOPIC)
    assert demands[1:] == [(CAMERA_TOPIC, False)]


def test_only_the_camera_that_is_watched_works(demands):
    board = Switchboard(
        TOPICS, lambda topic, wanted: demands.append((topic, wanted)), cameras=["front", "rear"]
    )
    rear, front = Ear(), Ear()
    board.watch(rear, "rear")
    board.watch(front, "front")
    board.unwatch(rear, "rear")
    behind = "/camera/rear/image/compressed"
    assert demands == [(behind, True), (CAMERA_TOPIC, True), (behind, False)]


def test_a_frame_reaches_who_watches_that_camera(board):
    front, back = Ear(), Ear()
    board.watch(front, "front")
    board.watch(back, "back")
    board.publish_frame("front", b"picture")
    assert (front.heard, back.heard) == ([b"picture"], [])


def test_a_topic_outside_the_table_is_refused(board):
    with pytest.raises(BridgeError, match="There is no topic /nowhere in the table"):
        board.publish("/nowhere", Odometry())


def test_clients_make_topics_and_they_vanish_with_the_last_who_needs_them(board, demands):
    talker, ear = object(), Ear()
    channel = board.advertise(talker, "/chatter", "std_msgs/msg/String")
    want(board, ear, "/chatter")
    board.pass_on(channel, String("hello"), talker, latch=False)
    assert ear.heard == [("/chatter", String("hello"))]
    board.unadvertise(talker, "/chatter")
    assert board.channels["/chatter"].type == "std_msgs/String"
    board.unsubscribe(ear, "/chatter")
    assert "/chatter" not in board.channels
    assert demands == []


def test_a_subscriber_may_come_before_the_publisher(board):
    ear = Ear()
    want(board, ear, "/chatter", "std_msgs/String")
    channel = board.advertise(None, "/chatter", "std_msgs/String")
    board.pass_on(channel, String("hello"), None, latch=False)
    assert ear.heard == [("/chatter", String("hello"))]


def test_each_publishers_latched_message_is_told_and_forgotten_with_it(board):
    for talker in ("a", "b"):
        channel = board.advertise(talker, "/chatter", "std_msgs/String")
        for text in ("old", talker):
            board.pass_on(channel, String(text), talker, latch=True)
    board.unadvertise("a", "/chatter")
    late = Ear()
    want(board, late, "/chatter")
    assert late.heard == [("/chatter", String("b"))]


def test_a_topic_needs_a_type(board):
    with pytest.raises(ProtocolError, match="no topic /chatter here, and a new one needs its type"):
        want(board, Ear(), "/chatter")


def test_a_topic_has_one_type(board):
    board.advertise("a", "/chatter", "std_msgs/String")
    with pytest.raises(ProtocolError, match="/chatter is std_msgs/String, not std_msgs/Bool"):
        board.check("/chatter", "std_msgs/Bool")
    board.check("/chatter", "std_msgs/msg/String")
    board.check("/chatter", "*")
    board.check("/chatter", None)


def test_there_is_an_end_to_the_topics_of_clients(board):
    for number in range(MAX_TOPICS):
        board.advertise("a", f"/n{number}", "std_msgs/String")
    with pytest.raises(ProtocolError, match="/more is one too many"):
        board.advertise("a", "/more", "std_msgs/String")


@pytest.mark.parametrize(
    ("topic", "type", "lane", "keep"),
    [
        ("/odom", "", Lane.TELEMETRY, 1),
        ("/events", "", Lane.EVENT, 0),
        ("/robot/info", "", Lane.EVENT, 0),
        ("/map", "", Lane.BULK, 1),
        (CAMERA_TOPIC, "", Lane.BULK, 1),
        ("/chatter", "std_msgs/String", Lane.TELEMETRY, 100),
        ("/other/imu", "sensor_msgs/Imu", Lane.TELEMETRY, 1),
        ("/other/picture", "sensor_msgs/Image", Lane.BULK, 1),
        ("/strange", "my_msgs/Own", Lane.TELEMETRY, 100),
    ],
)
def test_every_topic_has_its_lane(board, topic, type, lane, keep):
    want(board, Ear(), topic, type)
    channel = board.channels[topic]
    assert (channel.lane, channel.keep) == (lane, keep)


def latch(board, talker, topic, bytes):
    channel = board.advertise(talker, topic, "std_msgs/String")
    board.pass_on(channel, Unread(b'{"data":""}'.ljust(bytes), String), talker, latch=True)


def test_what_a_client_latches_is_bounded_and_what_is_too_much_is_refused(board, monkeypatch):
    monkeypatch.setattr(switchboard, "MAX_LATCHED_BYTES", 1000)
    latch(board, "a", "/one", 600)
    ear = Ear()
    want(board, ear, "/two", "std_msgs/String")
    with pytest.raises(ProtocolError) as refused:
        latch(board, "a", "/two", 500)
    assert str(refused.value) == (
        "A message of 500 bytes on /two cannot be latched: what one client latched may have at most 1000 bytes,"
        " and 600 are taken."
    )
    assert ear.heard == []
    latch(board, "b", "/two", 500)
    latch(board, "a", "/one", 1000)
    latch(board, "a", "/one", 400)
    latch(board, "a", "/two", 600)


def test_what_all_clients_latch_is_bounded_too_and_freed_when_they_leave(board, monkeypatch):
    monkeypatch.setattr(switchboard, "MAX_LATCHED_BYTES_IN_ALL", 1000)
    for talker in "ab":
        latch(board, talker, f"/{talker}", 450)
    with pytest.raises(ProtocolError, match="what all clients latched may have at most 1000 bytes, and 900"):
        latch(board, "c", "/c", 200)
    board.unadvertise("a", "/a")
    latch(board, "c", "/c", 200)
    for talker in "bc":
        board.unadvertise(talker, f"/{talker}")
    latch(board, "c", "/c", 1000)


def test_what_the_robot_latches_is_not_bounded(board, monkeypatch):
    monkeypatch.setattr(switchboard, "MAX_LATCHED_BYTES", 0)
    monkeypatch.setattr(switchboard, "MAX_LATCHED_BYTES_IN_ALL", 0)
    board.publish("/robot/info", RobotInfo(name="new"))
    late = Ear()
    want(board, late, "/robot/info")
    assert len(late.heard) == 1
