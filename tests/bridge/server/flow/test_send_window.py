"""How much may be on its way: a link of known speed and length, in virtual time."""

from __future__ import annotations

from collections import deque

import pytest

from bridge.server.flow.send_window import (
    DEAD_TIMEOUT,
    MAX_WINDOW,
    MIN_DELAY_LIFETIME,
    MIN_WINDOW,
    START_WINDOW,
    SendWindow,
)


class Link:
    """Carries bytes at `rate` [byte/s] over a way of `way` [s] there and back, and answers pings in their turn."""

    def __init__(self, rate, way=0.002):
        self.rate, self.way, self.now, self.free = rate, way, 0.0, 0.0
        self.window = SendWindow(0.0)
        self.pongs = deque()
        self.worst = 0.0

    def send(self, size):
        self.window.sent += size
        self.free = max(self.free, self.now) + size / self.rate
        self.worst = max(self.worst, self.free - self.now)
        self.beat()

    def beat(self):
        if self.window.needs_ping(self.now):
            self.pongs.append((max(self.free, self.now) + self.way, self.window.ping(self.now)))

    def flood(self, seconds, size=900):
        """As much as the window lets through; gives the bytes that arrived."""
        began, end = self.window.acknowledged, self.now + seconds
        self.beat()
        while self.now < end:
            while self.window.has_room(self.now):
                self.send(size)
            self.now, content = self.pongs.popleft()
            self.window.on_pong(content, self.now)
            self.beat()
        return self.window.acknowledged - began


def test_what_was_sent_counts_until_a_pong_to_a_later_ping():
    window = SendWindow(0.0)
    window.sent += 100
    first = window.ping(0.0)
    window.sent += 50
    window.on_pong(first, 0.01)
    assert window.under_way == 50


def test_a_pong_answers_the_pings_before_it():
    window = SendWindow(0.0)
    window.sent += 100
    window.ping(0.0)
    window.sent += 100
    window.on_pong(window.ping(0.0), 0.01)
    assert window.under_way == 0
    assert not window.is_dead(100.0)


@pytest.mark.parametrize("content", [b"", b"hello", b"\0" * 8, b"\xff" * 8])
def test_a_pong_that_nobody_asked_for_changes_nothing(content):
    window = SendWindow(0.0)
    window.sent += 100
    window.ping(0.0)
    assert not window.on_pong(content, 0.01)
    assert window.under_way == 100


def test_there_is_no_room_once_the_window_is_full_and_again_when_it_is_acknowledged():
    window = SendWindow(0.0)
    window.sent += START_WINDOW
    assert not window.has_room(0.0)
    assert window.needs_ping(0.0)
    window.on_pong(window.ping(0.0), 0.001)
    assert window.has_room(0.001)


@pytest.mark.parametrize("rate", [1e6, 1e7])
@pytest.mark.parametrize("way", [0.0005, 0.05])
def test_a_link_is_used_and_yet_little_waits_on_it(rate, way):
    link = Link(rate, way)
    link.flood(2.0)
    link.worst = 0.0
    arrived = link.flood(5.0)
    assert arrived > 0.55 * rate * 5.0
    assert link.worst < 0.02


def test_on_a_slow_link_no_more_than_the_floor_waits():
    link = Link(100_000)
    link.flood(5.0)
    link.worst = 0.0
    link.flood(5.0)
    assert link.worst * 100_000 < MIN_WINDOW + 1000


def test_there_is_an_end_to_the_window_of_a_fast_link():
    link = Link(1e12, 0.00001)
    link.flood(0.01)
    assert link.window.limit == MAX_WINDOW


def test_a_window_that_is_not_full_does_not_grow():
    link = Link(1e6)
    for _ in range(100):
        link.send(500)
        while link.pongs:
            link.now, content = link.pongs.popleft()
            link.window.on_pong(content, link.now)
        link.now += 0.3
    assert link.window.limit == START_WINDOW


def test_a_link_that_became_longer_for_good_is_used_again():
    link = Link(1e7, 0.001)
    link.flood(1.0)
    link.way = 0.06
    link.flood(70.0)
    assert link.flood(5.0) > 0.6 * 5e7


def test_who_does_not_answer_gets_nothing_more_until_it_does():
    window = SendWindow(0.0)
    window.on_pong(window.ping(0.0), 0.01)
    window.sent += 10
    late = window.ping(1.0)
    assert window.has_room(1.2)
    assert not window.has_room(1.3)
    window.on_pong(late, 3.0)
    assert window.has_room(3.0)


def test_pings_are_few_when_little_is_sent_and_one_comes_even_when_nothing_is():
    window = SendWindow(0.0)
    assert window.needs_ping(0.0)
    window.on_pong(window.ping(0.0), 0.01)
    assert not window.needs_ping(1.0)
    assert window.needs_ping(5.0)
    window.sent += 10
    assert not window.needs_ping(0.2)
    assert window.needs_ping(0.3)
    window.ping(0.3)
    window.sent += 10
    assert not window.needs_ping(10.0)


def test_who_leaves_a_ping_unanswered_for_long_is_dead():
    window = SendWindow(0.0)
    assert not window.is_dead(100.0)
    window.ping(100.0)
    assert not window.is_dead(100.0 + DEAD_TIMEOUT - 0.1)
    assert window.is_dead(100.0 + DEAD_TIMEOUT)


def test_a_message_beyond_the_limit_goes_only_when_hardly_anything_is_before_it():
    window = SendWindow(0.0)
    assert window.fits(10 * START_WINDOW)
    window.sent += START_WINDOW // 4
    assert window.fits(START_WINDOW // 2)
    assert not window.fits(START_WINDOW)
    assert not window.needs_ping(0.0) or window.ping(0.0)
    window.sent += 10
    assert window.needs_ping(0.0, waiting=True)


def test_after_a_while_of_longer_ways_the_way_is_drained_and_looked_at_anew():
    window, now = SendWindow(0.0), 0.0
    window.on_pong(window.ping(now), now + 0.01)

    def fill():
        nonlocal now
        full = window.limit
        window.sent += full
        content = window.ping(now)
        now += 0.05
        window.on_pong(content, now)
        return full

    while now < MIN_DELAY_LIFETIME:
        fill()
        assert window.limit < START_WINDOW
    assert fill() + MIN_WINDOW == window.limit
    assert 2 * fill() == window.limit
