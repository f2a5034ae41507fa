"""Subscriptions of one client as the deliveries that they are merged into."""

from __future__ import annotations

import pytest

from bridge.core.compat import Compat
from bridge.core.errors import ProtocolError
from bridge.protocol import Subscribe, Unsubscribe, client_subscriptions
from bridge.protocol.client_subscriptions import ClientSubscriptions


def subscriptions(*ops: Subscribe) -> ClientSubscriptions:
    made = ClientSubscriptions(Compat())
    for op in ops:
        made.subscribe(op, ros2=False)
    return made


def test_a_second_id_is_merged_at_once_and_a_repeated_one_with_the_next_question():
    made = subscriptions(Subscribe(topic="odom", id="a", throttle_rate=200))
    made.subscribe(Subscribe(topic="/odom", id="b", throttle_rate=100), ros2=False)
    assert not made.is_stale("/odom")
    assert made.deliveries["/odom"].period == 0.1
    made.subscribe(Subscribe(topic="/odom", id="b", throttle_rate=500), ros2=False)
    assert made.is_stale("/odom")
    assert made.changed()["/odom"].period == 0.2
    assert made.changed() == {}


def test_a_fragment_size_changes_every_delivery():
    made = subscriptions(Subscribe(topic="/a"), Subscribe(topic="/b", fragment_size=50))
    made.set_fragment_size(100)
    assert {topic: wanted.fragment_size for topic, wanted in made.changed().items()} == {"/a": 100, "/b": 50}


def test_a_removed_topic_is_not_among_the_changed_ones():
    made = subscriptions(Subscribe(topic="/a", id="1"), Subscribe(topic="/a", id="2"))
    made.unsubscribe(Unsubscribe(topic="/a", id="1"))
    made.unsubscribe(Unsubscribe(topic="/a", id="2"))
    assert made.changed() == {}
    assert made.deliveries == {}


def test_there_is_an_end_to_subscriptions_and_clearing_makes_room(monkeypatch):
    monkeypatch.setattr(client_subscriptions, "MAX_SUBSCRIPTIONS", 2)
    made = subscriptions(Subscribe(topic="/a"), Subscribe(topic="/b"))
    with pytest.raises(ProtocolError, match="at most 2 subscriptions"):
        made.subscribe(Subscribe(topic="/c"), ros2=False)
    made.clear()
    assert made.subscribe(Subscribe(topic="c"), ros2=False) == "/c"
