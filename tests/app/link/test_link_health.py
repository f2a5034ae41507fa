"""Signs of life of a link, in virtual time."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.link.link_health import SILENCE_LIMIT, LinkHealth
from tests.bridge.wires import Clock


class Watch:
    def __init__(self) -> None:
        self.clock = Clock()
        self.client: Any = SimpleNamespace(rtt=math.nan, lost=0, offset=math.nan, traffic=object())
        self.health = LinkHealth(self.client, self.clock)


@pytest.fixture
def watch() -> Watch:
    return Watch()


def test_before_anything_came_the_link_is_silent_and_the_robots_clock_unknown(watch: Watch) -> None:
    watch.health.measure()
    assert watch.health.silence == math.inf
    assert watch.health.silent
    assert math.isnan(watch.health.robot_time())


def test_a_message_is_a_sign_of_life_for_a_while(watch: Watch) -> None:
    watch.health.on_sign(watch.clock.time)
    watch.clock.time += SILENCE_LIMIT - 0.01
    assert not watch.health.silent
    watch.clock.time += 0.02
    assert watch.health.silent


def test_an_answered_ping_is_one_as_well_and_tells_the_robots_clock(watch: Watch) -> None:
    watch.client.rtt, watch.client.lost, watch.client.offset = 0.05, 2, 7.0
    watch.health.measure()
    assert not watch.health.silent
    assert (watch.health.rtt, watch.health.lost) == (0.05, 2)
    assert watch.health.robot_time() == watch.clock.time + 7.0


def test_the_same_ping_read_again_is_none(watch: Watch) -> None:
    watch.client.rtt = 0.05
    watch.health.measure()
    watch.clock.time += 1.0
    watch.health.measure()
    assert watch.health.silent


def test_a_round_trip_that_is_lost_is_none(watch: Watch) -> None:
    watch.client.rtt = 0.05
    watch.health.measure()
    watch.clock.time += 1.0
    watch.client.rtt = math.nan
    watch.health.measure()
    assert watch.health.silent


def test_the_certificate_that_the_robot_has_shown_is_that_of_the_connection_that_stands(watch: Watch) -> None:
    watch.client.fingerprint = "f" * 64
    assert watch.health.fingerprint == "f" * 64
    watch.client.fingerprint = ""
    assert watch.health.fingerprint == ""
