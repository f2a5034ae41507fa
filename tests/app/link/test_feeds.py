"""Feeds: newest wins, and nothing is believed longer than it deserves."""

from __future__ import annotations

import math
import threading

import pytest

from app.link.feeds import Feeds, Mailbox, Post
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import TaskStatus


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def feeds(clock: Clock) -> Feeds:
    feeds = Feeds(clock)
    feeds.link(True)
    return feeds


def post(value: object, received: float, count: int = 1) -> Post:
    return Post(value, received, count)


def test_a_feed_that_never_heard_anything_has_no_age(feeds: Feeds) -> None:
    assert feeds.state("/pose") == "never"
    assert math.isnan(feeds.age("/pose"))
    assert feeds.latest("/pose") is None


def test_a_stream_is_stale_ten_periods_after_its_last_message(feeds: Feeds, clock: Clock) -> None:
    feeds.put("/pose", post(PoseWithCovarianceStamped(), 100.0))
    clock.now = 100.5
    assert feeds.state("/pose") == "live"
    clock.now = 100.51
    assert feeds.state("/pose") == "stale"
    assert feeds.age("/pose") == pytest.approx(0.51)


@pytest.mark.parametrize(("name", "patience"), [("/imu/data", 0.5), ("/scan", 1.0), ("/battery_state", 3.0)])
def test_patience_follows_the_rate_within_bounds(feeds: Feeds, name: str, patience: float) -> None:
    assert feeds[name].patience == patience


def test_a_latched_message_stays_true_while_the_link_is_up(feeds: Feeds, clock: Clock) -> None:
    feeds.put("/task/status", post(TaskStatus(), 100.0))
    clock.now = 5000.0
    assert feeds.state("/task/status") == "live"
    assert feeds.age("/task/status") == 0.0


def test_a_latched_message_ages_from_the_moment_the_link_is_lost(feeds: Feeds, clock: Clock) -> None:
    feeds.put("/task/status", post(TaskStatus(), 100.0))
    clock.now = 160.0
    feeds.link(False)
    feeds.link(False)
    clock.now = 164.0
    assert feeds.state("/task/status") == "stale"
    assert feeds.age("/task/status") == 4.0


def test_a_lost_link_makes_even_a_fresh_stream_stale(feeds: Feeds) -> None:
    feeds.put("/pose", post(PoseWithCovarianceStamped(), 100.0))
    feeds.link(False)
    assert feeds.state("/pose") == "stale"


def test_forgetting_leaves_nothing_of_the_last_robot(feeds: Feeds) -> None:
    feeds.put("/pose", post(PoseWithCovarianceStamped(), 100.0))
    feeds.forget()
    assert feeds.state("/pose") == "never"


def test_the_rate_counts_messages_that_the_mailbox_skipped(feeds: Feeds) -> None:
    for index in range(11):
        feeds.put("/pose", post(PoseWithCovarianceStamped(), 100.0 + index / 10, count=3))
    assert feeds["/pose"].rate == pytest.approx(30.0)


def test_the_rate_starts_anew_after_a_silence(feeds: Feeds) -> None:
    for index in range(11):
        feeds.put("/pose", post(PoseWithCovarianceStamped(), 100.0 + index / 10))
    feeds.put("/pose", post(PoseWithCovarianceStamped(), 200.0))
    assert math.isnan(feeds["/pose"].rate)


def test_the_newest_value_of_a_channel_wins_and_the_rest_are_counted() -> None:
    box = Mailbox(lambda: None)
    for value in (1, 2, 3):
        box.post("a", value, float(value))
    assert box.drain() == [("a", Post(3, 3.0, 3))]
    assert box.drain() == []


def test_only_what_is_queued_or_urgent_wakes_the_glass() -> None:
    woken: list[None] = []
    box = Mailbox(lambda: woken.append(None))
    box.post("a", 1, 0.0)
    assert woken == []
    box.post("a", 2, 0.0, urgent=True)
    box.queue("b", 3, 0.0)
    assert len(woken) == 2


def test_queued_values_all_arrive_in_their_order() -> None:
    box = Mailbox(lambda: None)
    for value in (1, 2, 3):
        box.queue("event", value, 0.0)
    assert [post.value for _, post in box.drain()] == [1, 2, 3]


def test_posts_of_many_threads_are_all_counted() -> None:
    box = Mailbox(lambda: None)

    def fill() -> None:
        for index in range(500):
            box.post("a", index, 0.0)
            box.queue("b", index, 0.0)

    threads = [threading.Thread(target=fill) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    drained = box.drain()
    assert sum(post.count for name, post in drained if name == "a") == 2000
    assert sum(name == "b" for name, _ in drained) == 2000
