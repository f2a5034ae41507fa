"""The list of robots: who says hello is there, who falls silent is lost, what was typed is checked."""

from __future__ import annotations

import math

import pytest

from app.discovery.known_robots import KnownRobots, check_address
from bridge.discovery.beacon import Hello

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
