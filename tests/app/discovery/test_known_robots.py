"""The list of robots: who says hello is there, who falls silent is lost, what was typed is checked."""

from __future__ import annotations

import math

import pytest

from app.discovery.known_robots import (
    MAX_HEARD,
    MAX_PER_KEY,
    MAX_PER_SOURCE,
    KnownRobots,
    address,
    check_address,
)
from bridge.discovery.hello import Hello

A, B = "ws://10.0.0.3:9090", "ws://10.0.0.4:9091"


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def robots(clock: Clock) -> KnownRobots:
    return KnownRobots(clock)


@pytest.mark.parametrize(
    ("typed", "sentence"),
    [
        ("", "Enter an address"),
        ("  ", "Enter an address"),
        ("http://10.0.0.3", "not http://"),
        ("htp:/1.2", "An address begins with ws:// or wss://, not htp:/."),
        ("ws:/10.0.0.3:9090", "begins with ws:// or wss://, not ws:/."),
        ("10.0.0.3:", "no valid port"),
        ("10.0.0.3:0", "is not an address"),
        ("10.0.0.3:port", "no valid port"),
        ("10.0.0.3:70000", "no valid port"),
        ("two words", "is not an address"),
        ("ws://", "is not an address"),
    ],
)
def test_what_is_no_address_is_said(robots: KnownRobots, typed: str, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        robots.add(typed)
    assert robots.entries() == []


@pytest.mark.parametrize(
    ("typed", "url"),
    [
        ("10.0.0.3", A),
        (" robot.local ", "ws://robot.local:9090"),
        ("10.0.0.4:9091", B),
        ("wss://robot.example/bridge/", "wss://robot.example:9090/bridge"),
        ("ws://[fe80::1]:9091", "ws://[fe80::1]:9091"),
        (" pilothouse://10.0.0.4:9091?n=Rex ", B),
        ("pilothouse://[fe80::1]:9091?t=1&n=Rex", "wss://[fe80::1]:9091"),
    ],
)
def test_an_address_is_completed(typed: str, url: str) -> None:
    assert check_address(typed) == url


def test_a_silent_robot_is_lost_and_then_forgotten(robots: KnownRobots, clock: Clock) -> None:
    robots.heard(Hello(name="Patrol-1", url=A, battery=0.5), 100.0)
    assert robots.entries()[0].state == "live"
    clock.now = 106.0
    (entry,) = robots.entries()
    assert (entry.state, entry.silent) == ("lost", 6.0)
    clock.now = 161.0
    assert robots.entries() == []


def test_a_saved_address_stays_and_learns_its_name(robots: KnownRobots, clock: Clock) -> None:
    url = robots.add("10.0.0.3")
    assert [(entry.state, entry.saved) for entry in robots.entries()] == [("unheard", True)]
    robots.name(url, "Patrol-1", "wheels", "Differential drive")
    again = KnownRobots(clock, robots.save())
    (entry,) = again.entries()
    assert (entry.name, entry.kind, entry.address) == ("Patrol-1", "wheels", "10.0.0.3")
    again.remove(url)
    assert again.entries() == []


def test_a_saved_robot_that_says_hello_is_listed_once(robots: KnownRobots) -> None:
    robots.add("10.0.0.4:9091")
    robots.heard(Hello(name="Minnow", url=B, driver="tablet-B"), 100.0)
    (entry,) = robots.entries()
    assert (entry.driver, entry.saved, entry.address) == ("tablet-B", True, "10.0.0.4:9091")


def test_robots_keep_the_order_in_which_they_were_met_so_that_no_card_moves_under_a_finger(
    robots: KnownRobots,
) -> None:
    robots.heard(Hello(name="patrol", url=A), 100.0)
    robots.heard(Hello(name="Aqua", url=B), 100.0)
    robots.heard(Hello(name="patrol", url=A), 100.1)
    assert [entry.name for entry in robots.entries()] == ["patrol", "Aqua"]


def test_robots_that_fell_silent_come_after_those_within_reach(robots: KnownRobots) -> None:
    robots.heard(Hello(name="patrol", url=A), 90.0)
    robots.heard(Hello(name="Aqua", url=B), 100.0)
    assert [(entry.name, entry.state) for entry in robots.entries()] == [("Aqua", "live"), ("patrol", "lost")]


def test_a_measured_round_trip_is_shown(robots: KnownRobots) -> None:
    robots.heard(Hello(name="A", url=A), 100.0)
    assert math.isnan(robots.entries()[0].latency)
    robots.measured(A, 0.012)
    assert robots.entries()[0].latency == 0.012


@pytest.mark.parametrize("saved", [[None], ["x"], [{}], [{"url": 5}]])
def test_damaged_saved_addresses_are_left_out(clock: Clock, saved: list[object]) -> None:
    assert KnownRobots(clock, saved).entries() == []  # type: ignore[arg-type]


def test_an_address_in_the_settings_that_is_none_is_shown_as_it_is() -> None:
    assert (address("ws://[x"), address("ws://h:99999999")) == ("ws://[x", "ws://h:99999999")


# strangers that say HELLO


def flood(robots: KnownRobots, at: float, count: int, name: str = "flood", source: str = "10.9") -> None:
    """So many robots, each from an address of its own."""
    for n in range(count):
        host = f"{source}.{n // 250}.{n % 250}"
        robots.heard(Hello(name=name, url=f"ws://{host}:9090"), at, host)


def names(robots: KnownRobots) -> list[str]:
    return [entry.name for entry in robots.entries() if entry.name != "flood"]


def test_a_flood_of_hellos_is_bounded(robots: KnownRobots) -> None:
    flood(robots, 100.0, 5000)
    assert len(robots.entries()) == MAX_HEARD


def test_a_flood_from_one_address_leaves_half_of_the_list_to_others(robots: KnownRobots) -> None:
    for port in range(1, 5000):
        robots.heard(Hello(name="flood", url=f"ws://10.9.0.1:{port}"), 100.0, "10.9.0.1")
    assert len(robots.entries()) == MAX_PER_SOURCE < MAX_HEARD
    robots.heard(Hello(name="Patrol-1", url=A), 100.0, "10.0.0.3")
    assert names(robots) == ["Patrol-1"]


def test_a_robot_that_keeps_saying_hello_is_never_crowded_out(robots: KnownRobots, clock: Clock) -> None:
    for tick in range(40):
        clock.now = 100.0 + tick / 2
        robots.heard(Hello(name="Patrol-1", url=A), clock.now, "10.0.0.3")
        flood(robots, clock.now, 300, source=f"10.{10 + tick}")
    assert names(robots) == ["Patrol-1"]
    assert len(robots.entries()) <= MAX_HEARD


def test_who_fell_silent_makes_room_the_longest_silent_first(robots: KnownRobots, clock: Clock) -> None:
    flood(robots, 100.0, MAX_HEARD - 1)
    robots.heard(Hello(name="Aqua", url=B), 101.0, "10.0.0.4")
    robots.heard(Hello(name="Late", url=A), 101.0, "10.0.0.3")
    assert names(robots) == ["Aqua"], "all of them are heard"
    clock.now = 104.5
    robots.heard(Hello(name="Late", url=A), 104.5, "10.0.0.3")
    assert sorted(names(robots)) == ["Aqua", "Late"]
    assert len(robots.entries()) == MAX_HEARD


@pytest.mark.parametrize("how", ["saved", "connected", "paired"])
def test_one_that_is_saved_connected_or_paired_always_gets_in_and_stays(clock: Clock, how: str) -> None:
    robots = KnownRobots(
        clock,
        [{"url": A}] if how == "saved" else [],
        connected=lambda: [A] if how == "connected" else [],
        paired=lambda: {"Patrol-1": KEY} if how == "paired" else {},
    )
    flood(robots, 100.0, 500)
    robots.heard(Hello(name="Patrol-1", url=A, key=KEY), 100.0, "10.0.0.3")
    clock.now = 110.0
    flood(robots, 110.0, 500, source="10.99")
    (mine,) = (entry for entry in robots.entries() if entry.url == A)
    assert (mine.kept, mine.state) == (True, "lost"), "it fell silent, and nobody took its place"


KEY = "0123456789abcdef" * 2


def test_claims_of_a_paired_key_are_bounded_the_longest_known_ones_count(clock: Clock) -> None:
    robots = KnownRobots(clock, paired=lambda: {"Patrol-1": KEY})
    robots.heard(Hello(name="Patrol-1", url=A, key=KEY), 100.0, "10.0.0.3")
    for n in range(500):
        host = f"10.9.{n // 250}.{n % 250}"
        robots.heard(Hello(name="flood", url=f"ws://{host}:9090", key=KEY), 100.0, host)
    kept = [entry.url for entry in robots.entries() if entry.kept]
    assert (kept[0], len(kept)) == (A, MAX_PER_KEY)
    assert len(robots.entries()) <= MAX_HEARD


@pytest.mark.parametrize("name", ["Patrol-1", "patrol-1", "Ｐatrol-1", "Patrol -1"])
def test_another_robot_that_uses_the_name_of_a_paired_one_is_told_apart(clock: Clock, name: str) -> None:
    robots = KnownRobots(clock, paired=lambda: {"Patrol-1": KEY})
    robots.heard(Hello(name=name, url=A), 100.0, "10.0.0.3")
    robots.heard(Hello(name="Patrol-1", url=B, key=KEY), 100.0, "10.0.0.4")
    robots.heard(Hello(name="Aqua", url="ws://10.0.0.5:9090"), 100.0, "10.0.0.5")
    assert [entry.warning for entry in robots.entries()] == [
        "Not your paired Patrol-1: another robot uses its name.",
        "",
        "",
    ]


def test_a_robot_of_this_machine_is_listed_once_under_its_loopback_address(robots: KnownRobots) -> None:
    near = "ws://127.0.0.1:9090"
    robots.heard(Hello(name="Patrol-1", url=A, boot="b1"), 100.0, "10.0.0.3")
    robots.heard(Hello(name="Patrol-1", url=near, boot="b1"), 100.0, "127.0.0.1")
    assert [entry.url for entry in robots.entries()] == [near]


def test_a_claim_of_another_machine_hides_nobody(robots: KnownRobots) -> None:
    robots.heard(Hello(name="Patrol-1", url=A, boot="b1"), 100.0, "10.0.0.3")
    robots.heard(Hello(name="Fake", url=B, boot="b1"), 100.0, "10.0.0.4")
    assert [entry.url for entry in robots.entries()] == [A, B]


def test_a_round_trip_is_measured_to_where_the_hello_came_from(robots: KnownRobots) -> None:
    robots.heard(Hello(name="a", url=A, http="http://10.0.0.3:8080"), 100.0, "10.0.0.3")
    robots.heard(Hello(name="b", url=B), 100.0, "10.0.0.4")
    assert [entry.probe for entry in robots.entries()] == [("10.0.0.3", 8080), None]


def test_round_trips_to_robots_that_are_not_listed_are_not_kept(robots: KnownRobots, clock: Clock) -> None:
    robots.heard(Hello(name="A", url=A), 100.0)
    for n in range(100):
        robots.measured(f"ws://10.9.0.{n}:9090", 0.1)
    robots.measured(A, 0.1)
    assert list(robots._latency) == [A]
    clock.now = 200.0
    robots.entries()
    assert not robots._latency


def test_a_robot_that_its_centre_has_lost_is_lost_though_the_centre_says_hello() -> None:
    robots = KnownRobots(lambda: 100.0)
    robots.heard(Hello(name="North", url="ws://10.0.0.3:9090", reached=False), 100.0, "10.0.0.3")
    assert robots.entries()[0].state == "lost"


def test_an_address_is_no_robot_until_one_was_met_there_and_stays_one_over_the_end_of_the_app(robots, clock):
    url, other = robots.add("10.0.0.8"), robots.add("10.0.0.9", met=True)
    assert [(one.url, one.met) for one in robots.entries()] == [(url, False), (other, True)]
    again = KnownRobots(clock, robots.save())
    assert [one.met for one in again.entries()] == [False, True]
    again.name(url, "Boat", "boat", "")
    assert [one.met for one in KnownRobots(clock, again.save()).entries()] == [True, True]


def test_a_name_saved_by_an_earlier_version_says_that_the_robot_was_met(clock):
    saved = [{"url": "ws://10.0.0.8:9090", "name": "Boat"}, {"url": "ws://10.0.0.9:9090", "name": ""}]
    assert [one.met for one in KnownRobots(clock, saved).entries()] == [True, False]
