"""How long the way to a client takes, and how old at most what it says can be."""

from __future__ import annotations

import math

from bridge.server.flow.round_trip import PING_PERIOD, RoundTrip


def test_before_the_first_answer_nothing_is_known_and_the_opening_is_the_bound() -> None:
    round_trip = RoundTrip(10.0)
    assert round_trip.ping(10.0) is not None
    assert math.isnan(round_trip.rtt)
    assert round_trip.answered == 10.0


def test_an_answer_tells_how_long_the_way_takes_and_when_its_ping_was_sent() -> None:
    round_trip = RoundTrip(10.0)
    content = round_trip.ping(10.2)
    assert content is not None
    assert round_trip.on_pong(content, 10.25)
    assert round(round_trip.rtt, 6) == 0.05
    assert round_trip.answered == 10.2


def test_what_is_overdue_makes_the_way_longer_until_an_answer_comes() -> None:
    round_trip = RoundTrip(10.0)
    first, second = round_trip.ping(10.0), round_trip.ping(10.0 + PING_PERIOD)
    assert first is not None
    assert second is not None
    assert round_trip.on_pong(first, 10.05)
    round_trip.ping(11.0)
    assert round(round_trip.rtt, 6) == 1.0 - PING_PERIOD
    assert round_trip.on_pong(second, 11.2)
    assert round(round_trip.rtt, 6) == 1.0
    assert round_trip.answered == 10.0 + PING_PERIOD


def test_a_first_ping_that_is_not_answered_counts_as_a_long_way() -> None:
    round_trip = RoundTrip(10.0)
    round_trip.ping(10.0)
    round_trip.ping(10.5)
    assert round_trip.rtt == 0.5


def test_the_answer_to_a_later_ping_answers_those_before() -> None:
    round_trip = RoundTrip(10.0)
    round_trip.ping(10.0)
    later = round_trip.ping(10.2)
    assert later is not None
    assert round_trip.on_pong(later, 10.3)
    round_trip.ping(10.4)
    assert round(round_trip.rtt, 6) == 0.1


def test_strange_answers_change_nothing() -> None:
    round_trip = RoundTrip(10.0)
    mine = round_trip.ping(10.0)
    assert mine is not None
    assert not round_trip.on_pong(b"", 10.1)
    assert not round_trip.on_pong(bytes(8), 10.1)
    assert not round_trip.on_pong(bytes(11), 10.1)
    assert not round_trip.on_pong(mine[:-1] + b"\xff", 10.1)
    assert round_trip.answered == 10.0
    assert round_trip.on_pong(mine, 10.1)
    assert not round_trip.on_pong(mine, 10.2)


def test_a_client_that_never_answers_is_not_asked_for_ever() -> None:
    round_trip = RoundTrip(0.0)
    asked = sum(round_trip.ping(number * PING_PERIOD) is not None for number in range(1000))
    assert asked == 64


def test_a_ping_on_its_way_makes_a_long_way_no_shorter() -> None:
    """The last answer took a second; the next ping waits for half of one and has proved nothing better."""
    round_trip = RoundTrip(10.0)
    slow = round_trip.ping(10.0)
    assert slow is not None
    assert round_trip.on_pong(slow, 11.0)
    round_trip.ping(11.0)
    round_trip.ping(11.5)
    assert round_trip.rtt == 1.0


def test_what_came_late_counts_though_others_wait_for_longer_by_then() -> None:
    round_trip = RoundTrip(10.0)
    first = round_trip.ping(10.0)
    round_trip.ping(10.2)
    assert first is not None
    assert round_trip.on_pong(first, 10.9)
    assert round(round_trip.rtt, 6) == 0.9
    assert round_trip.answered == 10.0, "nothing newer is known to have arrived"
