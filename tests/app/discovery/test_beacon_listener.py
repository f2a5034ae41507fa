"""From a datagram to a card: whatever strangers send, the list is proper, bounded and measured sparingly."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from app.discovery import beacon_listener
from app.discovery.beacon_listener import HELLO, BeaconListener
from app.discovery.known_robots import MAX_HEARD, KnownRobots
from app.discovery.probes import MAX_AT_ONCE
from app.link.feeds import Mailbox
from app.screens.connect.connect import ConnectScreen
from bridge.discovery.beacon import Listener
from bridge.discovery.domain import discovery_domain
from bridge.discovery.hello import Hello


class Chain:
    """The way of a datagram without a socket: listener, mailbox, list, cards."""

    def __init__(self, screen: ConnectScreen) -> None:
        self.now = 100.0
        self.mailbox = Mailbox(lambda: None)
        self.nearby = BeaconListener(self.mailbox, None, now=lambda: self.now)  # type: ignore[arg-type]
        self.listener = Listener(self.nearby._hear)
        self.robots = KnownRobots(lambda: self.now, [{"url": "ws://10.0.0.3:9090", "name": "Mine"}])
        self.screen = screen

    def receive(self, datagram: bytes, source: str) -> None:
        self.listener._receive(datagram, source, 40000)

    def drain(self) -> int:
        """Everything to the glass; how many channels there were."""
        posts = self.mailbox.drain()
        for channel, post in posts:
            assert channel == HELLO
            for one in post.value.take():
                self.robots.heard(one.hello, one.received, one.source)
        entries = self.robots.entries()
        self.screen.show_entries(entries, "tablet")
        self.nearby.measure(entries)
        return len(posts)


def hello(host: str, port: int = 9090, **more: Any) -> bytes:
    fields = {"name": "x", "url": f"ws://{host}:{port}", "http": f"http://{host}:80"}
    return json.dumps({**fields, **more}).encode()


urls = st.sampled_from(
    ["ws://[x", "http://10.0.0.3:99999999", "ws://10.0.0.3:9090", "ws://a..b", "ws://[::1]"]
) | st.text(max_size=30)
words = st.text(max_size=100)
fields = st.fixed_dictionaries(
    {},
    optional={
        **dict.fromkeys(("name", "driver", "kind", "icon", "description", "boot", "key"), words),
        "url": urls,
        "http": urls,
        "battery": st.floats(),
    },
)
datagrams = st.one_of(
    st.binary(max_size=100),
    st.builds(lambda made: json.dumps(made).encode("utf-8", "replace"), fields),
    st.builds(lambda made: hello("10.0.0.3", **made), fields),
)


def test_no_datagram_whatever_ends_the_app(stage: Any) -> None:
    screen = ConnectScreen(app=None)  # one for all, with cards made anew

    @settings(max_examples=60)
    @given(st.lists(st.tuples(datagrams, st.sampled_from(["10.0.0.3", "127.0.0.1", "10.0.0.4"])), max_size=8))
    @example([(b'{"name":"a","url":"ws://h:1","http":"http://h:99999999"}', "127.0.0.1")])
    @example([(b'{"name":"a","url":"ws://[x"}', "127.0.0.1")])
    @example([(hello("10.0.0.3", battery=None, driver="\u202e"), "10.0.0.3")])
    def is_taken(received: list[tuple[bytes, str]]) -> None:
        screen.show_entries([], "tablet")
        assert not screen.cards
        chain = Chain(screen)
        for datagram, source in received:
            chain.receive(datagram, source)
        assert chain.drain() <= 1
        assert len(screen.cards) <= 1 + len(received)

    is_taken()


def test_a_flood_stays_bounded_at_each_station_of_its_way_and_the_saved_robot_is_shown(stage: Any) -> None:
    chain, screen = Chain(ConnectScreen(app=None)), set[str]()
    probed = 0
    for burst in range(4):
        for n in range(2000):
            host = f"10.{burst + 1}.{n // 250}.{n % 250}"
            chain.receive(hello(host), host)
        chain.receive(hello("10.0.0.3", name="Mine"), "10.0.0.3")
        assert chain.drain() == 1, "one channel of the mailbox, whoever says hello"
        probed = max(probed, len(chain.nearby._probes.due(chain.now)))
        screen = {card.title for card in chain.screen.cards}
        assert "Mine" in screen
        chain.now += 0.5
    assert len(chain.screen.cards) <= MAX_HEARD + 1
    assert 0 < probed <= MAX_AT_ONCE


async def test_mdns_is_tried_only_once_no_robot_was_heard_for_a_while(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now, started = [100.0], []

    class Browser:
        def __init__(self, found: Any) -> None:
            started.append(now[0])

        async def run(self) -> None:
            pass

    async def sleep(seconds: float) -> None:
        now[0] += seconds
        if now[0] < 105.0:
            nearby._hear(
                Hello(name="x", url="ws://10.0.0.3:9090"), ("10.0.0.3", 9090)
            )  # the last one at 104 s

    monkeypatch.setattr(beacon_listener, "MdnsBrowser", Browser)
    monkeypatch.setattr(beacon_listener.asyncio, "sleep", sleep)
    nearby = BeaconListener(Mailbox(lambda: None), None, now=lambda: now[0])  # type: ignore[arg-type]
    await nearby._browse()
    assert started == [108.0]


def test_what_is_asked_at_addresses_that_were_found_is_of_the_own_domain_too() -> None:
    nearby = BeaconListener(Mailbox(lambda: None), None, now=lambda: 0.0)  # type: ignore[arg-type]
    assert nearby._calls._domain == nearby._domain == discovery_domain() != ""
