"""Posts of one link: some wait their turn, some give way to a newer one, and some wake the glass."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from app.link.capabilities import Capabilities
from app.link.channels import EVENT, KNOWN, SEEN, LinkPosts
from app.link.event_order import KnownEvents
from app.link.feeds import Mailbox
from app.link.subscriptions import Seen, Sources
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import ControlStatus, Event


class Box:
    def __init__(self) -> None:
        self.wakes = 0
        self.mailbox = Mailbox(self.wake)
        self.posts = LinkPosts(self.mailbox, lambda: 100.0)

    def wake(self) -> None:
        self.wakes += 1

    def drained(self) -> list[tuple[str, object, float]]:
        return [(channel, post.value, post.received) for channel, post in self.mailbox.drain()]


@pytest.fixture
def box() -> Box:
    return Box()


def test_what_is_queued_all_arrives_and_wakes_the_glass(box: Box) -> None:
    for value in ("one", "two"):
        box.posts.queue(EVENT)(value)
    assert box.wakes == 2
    assert box.drained() == [(EVENT, "one", 100.0), (EVENT, "two", 100.0)]


def test_of_messages_the_newest_wins_and_only_the_word_of_control_is_urgent(box: Box) -> None:
    old, new = PoseWithCovarianceStamped(), PoseWithCovarianceStamped()
    box.posts.post_message("/pose", old, 98.0)
    box.posts.post_message("/pose", new, 99.0)
    assert box.wakes == 0
    box.posts.post_message("/control/status", ControlStatus(), 99.5)
    assert box.wakes == 1
    assert box.drained() == [("/pose", new, 99.0), ("/control/status", ControlStatus(), 99.5)]


def test_a_type_that_was_learned_is_not_lost_among_the_messages(box: Box) -> None:
    learned, message = Seen("/imu", kind=ControlStatus), Seen("/imu", ControlStatus())
    box.posts.post_seen(learned, float("nan"))
    box.posts.post_seen(message, 99.0)
    assert box.drained() == [(SEEN, learned, 100.0), (SEEN, message, 99.0)]


def test_how_far_events_are_known_comes_after_them(box: Box) -> None:
    box.posts.post_known(KnownEvents("boot", 1))
    box.posts.post_known(KnownEvents("boot", 2))
    box.posts.queue(EVENT)("event")
    assert box.drained() == [(EVENT, "event", 100.0), (KNOWN, KnownEvents("boot", 2), 100.0)]


class Client:
    """Takes subscriptions."""

    def __init__(self) -> None:
        self.subscribed: list[str] = []
        self.anew: list[str] = []
        """In the order in which they came, those that ended too."""
        self.callbacks: dict[str, Any] = {}

    def subscribe(self, topic: str, _: object, callback: object, **__: object) -> Callable[[], None]:
        self.subscribed.append(topic)
        self.anew.append(topic)
        self.callbacks[topic] = callback
        return lambda: self.subscribed.remove(topic)


def test_what_a_robot_makes_on_demand_is_listened_to_while_somebody_looks_and_where_it_is_offered() -> None:
    client = Client()
    sources = Sources(client, lambda *_: None, lambda *_: None)  # type: ignore[arg-type]
    offers = Capabilities({"/gateways": "pilothouse_msgs/GatewayArray"}, frozenset())
    sources.want("/gateways", True)
    sources.want("/payloads", True)
    assert not {"/gateways", "/payloads"} & set(client.subscribed), "nobody knows whether it has them"
    sources.follow(offers)
    assert client.subscribed.count("/gateways") == 1
    assert "/payloads" not in client.subscribed
    sources.want("/gateways", False)
    assert "/gateways" not in client.subscribed
    assert "/pose" in client.subscribed, "the others go on"


async def test_what_was_refused_while_its_payload_was_off_is_asked_for_again_when_one_is_switched() -> None:
    client, told = Client(), list[Event]()
    sources = Sources(client, lambda *_: None, lambda event, _: told.append(event))  # type: ignore[arg-type]
    sources.follow(Capabilities({}, frozenset()))
    before = list(client.subscribed)
    client.anew.clear()
    for code in ("task_started", "payload_switched"):
        client.callbacks["/events"](Event(code=code), 0.0)
        await asyncio.sleep(0)
        await asyncio.sleep(0)
        assert bool(client.anew) == (code == "payload_switched")
    assert sorted(client.subscribed) == sorted(before), "each once"
    assert "/arm" in client.anew
    assert "/events" not in client.anew, "none is missed meanwhile"
    assert len(told) == 2
