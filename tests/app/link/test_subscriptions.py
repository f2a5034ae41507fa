"""Watching any number of topics: each is listened to once, by whoever looks, and only while somebody looks."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from app.link.channels import LinkPosts, watched
from app.link.feeds import Mailbox
from app.link.subscriptions import MAX_WATCHED, Seen, Watches
from bridge.core.errors import NotConnected
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import Imu

IMU = "sensor_msgs/Imu"


class Client:
    """Takes subscriptions; types that it does not know it fails to learn."""

    def __init__(self) -> None:
        self.open: list[str] = []
        self.learnable = False

    def subscribe(self, topic: str, _: object, callback: object, **__: object) -> Callable[[], None]:
        self.open.append(topic)
        return lambda: self.open.remove(topic)

    async def learn(self, name: str) -> type[Msg]:
        if not self.learnable:
            raise NotConnected("The link is down.")
        return Imu


class Bench:
    """Watches whose network thread is the test's own."""

    def __init__(self) -> None:
        self.client: Any = Client()
        self.seen: list[Seen] = []
        self.watches = Watches(
            self.client,
            lambda seen, _: self.seen.append(seen),
            asyncio.run,
            lambda act, *args: act(*args),
        )


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_a_topic_that_two_look_at_is_listened_to_once_until_both_look_away(bench: Bench) -> None:
    bench.watches.look("panels", {"/imu": IMU, "/imu2": IMU})
    bench.watches.look("plots", {"/imu": IMU})
    assert sorted(bench.client.open) == ["/imu", "/imu2"]
    bench.watches.look("panels", {})
    assert bench.client.open == ["/imu"]
    bench.watches.look("plots", {})
    assert bench.client.open == []


def test_a_topic_of_another_type_is_subscribed_to_anew(bench: Bench) -> None:
    bench.watches.look("panels", {"/imu": IMU})
    bench.watches.look("panels", {"/imu": "std_msgs/String"})
    assert bench.client.open == ["/imu"]
    assert [seen.kind.MSGTYPE for seen in bench.seen if seen.kind] == [IMU, "std_msgs/String"]


def test_a_type_that_could_not_be_learned_is_tried_again_over_the_next_link(bench: Bench) -> None:
    bench.watches.look("panels", {"/odd": "their_msgs/Odd"})
    assert "their_msgs/Odd cannot be shown" in bench.seen[-1].problem
    assert bench.client.open == []
    bench.client.learnable = True
    bench.watches.renew()
    assert bench.client.open == ["/odd"]


def test_one_topic_too_many_is_said_and_the_others_go_on(bench: Bench) -> None:
    many = {f"/imu/{number}": IMU for number in range(MAX_WATCHED + 1)}
    bench.watches.look("panels", many)
    assert len(bench.client.open) == MAX_WATCHED
    assert bench.seen[-1].problem.startswith("64 topics are shown already")


def test_what_is_seen_of_a_topic_has_a_channel_of_its_own_where_the_newest_wins() -> None:
    mailbox = Mailbox(lambda: None)
    posts = LinkPosts(mailbox, lambda: 100.0)
    kind, old, new = Seen("/imu", kind=Imu), Seen("/imu", Imu()), Seen("/imu", Imu())
    posts.post_watched(kind, float("nan"))
    posts.post_watched(old, 98.0)
    posts.post_watched(new, 99.0)
    drained = [(channel, post.value, post.received) for channel, post in mailbox.drain()]
    assert drained == [(watched("/imu"), kind, 100.0), (watched("/imu"), new, 99.0)]
