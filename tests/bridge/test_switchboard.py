"""Who gets what, and whether anybody wants it."""

from __future__ import annotations

import pytest

from bridge.errors import BridgeError
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Event, RobotInfo
from bridge.switchboard import CAMERA_TOPIC, Switchboard
from bridge.topics import TOPICS


class Ear:
    def __init__(self):
        self.heard = []

    def deliver(self, entry, message):
        self.heard.append((entry.name, message.msg))

    def offer(self, frame):
        self.heard.append(frame)


@pytest.fixture
def demands():
    return []


@pytest.fixture
def board(demands):
    return Switchboard(TOPICS, lambda *demand: demands.append(demand))


def test_a_message_reaches_who_subscribed_and_nobody_else(board):
    wants, other = Ear(), Ear()
    board.subscribe(wants, "/odom")
    board.subscribe(other, "/scan")
    board.publish("/odom", Odometry())
    assert (wants.heard, other.heard) == ([("/odom", Odometry())], [])


def test_a_latched_topic_is_told_at_once_and_with_its_last_message_only(board):
    board.publish("/robot/info", RobotInfo(name="old"))
    board.publish("/robot/info", RobotInfo(name="new"))
    late = Ear()
    board.subscribe(late, "/robot/info")
    assert [msg.name for _, msg in late.heard] == ["new"]


@pytest.mark.parametrize(("topic", "msg"), [("/odom", Odometry()), ("/events", Event())])
def test_streams_and_events_are_not_kept_for_later(board, topic, msg):
    board.publish(topic, msg)
    late = Ear()
    board.subscribe(late, topic)
    assert late.heard == []


def test_demand_is_told_for_the_first_who_comes_and_the_last_who_leaves(board, demands):
    first, second = Ear(), Ear()
    for ear in (first, second):
        board.subscribe(ear, "/odom")
    for ear in (first, second, second):
        board.unsubscribe(ear, "/odom")
    assert demands == [("/odom", True), ("/odom", False)]


def test_watching_a_camera_counts_as_wanting_its_pictures(board, demands):
    watcher, subscriber = Ear(), Ear()
    board.watch(watcher, "front")
    board.subscribe(subscriber, CAMERA_TOPIC)
    board.unwatch(watcher, "front")
    assert demands == [(CAMERA_TOPIC, True)]
    board.unsubscribe(subscriber, CAMERA_TOPIC)
    assert demands[1:] == [(CAMERA_TOPIC, False)]


def test_a_frame_reaches_who_watches_that_camera(board):
    front, back = Ear(), Ear()
    board.watch(front, "front")
    board.watch(back, "back")
    board.publish_frame("front", b"picture")
    assert (front.heard, back.heard) == ([b"picture"], [])


def test_a_topic_outside_the_table_is_refused(board):
    with pytest.raises(BridgeError, match="There is no topic /nowhere in the table"):
        board.publish("/nowhere", Odometry())
