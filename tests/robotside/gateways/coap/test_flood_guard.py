"""What is heard of floods of datagrams, and what is sent to addresses that may be forged, in virtual time."""

from __future__ import annotations

import pytest

from robotside.gateways.coap import flood_guard
from robotside.gateways.coap.flood_guard import (
    ALL_BURST,
    ALL_RATE,
    ANSWER_BURST,
    ANSWER_RATE,
    MAX_SOURCES,
    SOURCE_BURST,
    SOURCE_RATE,
    STOP_BURST,
    FloodGuard,
    TokenBucket,
)


def test_a_bucket_gives_its_burst_at_once_and_then_its_rate() -> None:
    bucket = TokenBucket(10.0, 5.0, 0.0)
    assert [bucket.take(0.0) for _ in range(6)] == [True] * 5 + [False]
    assert [bucket.take(0.1), bucket.take(0.1)] == [True, False]
    assert sum(bucket.take(100.0) for _ in range(10)) == 5, "it never holds more than its burst"
    assert not bucket.take(101.0, 6.0)


def heard(guard: FloodGuard, seconds: float, host: str, port: int = 1) -> int:
    """Datagrams that are heard of a source that sends 10 kHz, from 1 s on."""
    return sum(guard.hears(host, port, 1.0 + step / 10_000) for step in range(round(seconds * 10_000)))


def test_a_source_is_heard_so_often() -> None:
    count = heard(FloodGuard(1.0), 1.0, "192.0.2.1")
    assert count == pytest.approx(SOURCE_BURST + SOURCE_RATE, abs=2)


def test_many_sources_are_heard_so_often_together_however_many_addresses_they_forge() -> None:
    guard = FloodGuard(1.0)
    count = sum(guard.hears(f"10.0.{n % 200}.{n % 251}", n, 1.0 + n / 10_000) for n in range(10_000))
    assert count == pytest.approx(ALL_BURST + ALL_RATE, abs=2)
    assert len(guard._sources) <= MAX_SOURCES


def test_one_source_leaves_room_for_others_and_ports_count_on_this_machine_alone() -> None:
    guard = FloodGuard(1.0)
    for port in range(1000):
        guard.hears("192.0.2.1", port, 1.0)
    assert guard.hears("192.0.2.2", 1, 1.0)
    assert not guard.hears("192.0.2.1", 7777, 1.0)
    guard = FloodGuard(1.0)
    for _ in range(round(SOURCE_BURST)):
        guard.hears("127.0.0.1", 5000, 1.0)
    assert not guard.hears("127.0.0.1", 5000, 1.0)
    assert guard.hears("127.0.0.1", 5001, 1.0)


def test_stop_has_room_of_its_own_at_the_very_moment_of_a_flood() -> None:
    guard = FloodGuard(1.0)
    for number in range(1000):
        guard.hears(f"192.0.2.{number % 9}", 1, 1.0)
    assert not guard.hears("192.0.2.77", 1, 1.0)
    assert guard.hears_stop(1.0)


def test_a_flood_of_stops_leaves_room_for_all_else() -> None:
    guard = FloodGuard(1.0)
    assert sum(guard.hears_stop(1.0) for _ in range(1000)) == STOP_BURST
    assert guard.hears("192.0.2.1", 1, 1.0)


def test_little_is_sent_to_one_network_and_anything_to_this_machine() -> None:
    guard = FloodGuard(1.0)
    sent = sum(1000 for step in range(2000) if guard.sends("192.0.2.1", 1000, 1.0 + step / 1000))
    assert sent == pytest.approx(ANSWER_BURST + 2 * ANSWER_RATE, rel=0.02)
    assert guard.sends("192.0.2.2", 1000, 3.0)
    assert guard.sends("127.0.0.1", 10**9, 3.0)
    assert guard.sends("2001:db8::1", round(ANSWER_BURST), 3.0)
    assert not guard.sends("2001:db8::2", 1000, 3.0), "one network has as many addresses as it likes"


def test_requests_that_are_remembered_are_few() -> None:
    remembered = ALL_RATE * 50.0 + flood_guard.ALL_BURST
    assert remembered <= 12_000
