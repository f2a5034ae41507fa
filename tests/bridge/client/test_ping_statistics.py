"""Round trips, clocks and losses."""

from __future__ import annotations

import math

import pytest

from bridge.client.ping_statistics import PingStatistics


def test_nothing_is_known_before_the_first_answer():
    pings = PingStatistics()
    pings.on_sent(0.0)
    assert math.isnan(pings.rtt)
    assert math.isnan(pings.offset)


def test_the_clock_is_compared_half_way_between_question_and_answer():
    pings = PingStatistics()
    pings.on_answer(pings.on_sent(10.0), 10.2, robot_time=1010.1)
    assert (pings.rtt, pings.offset) == pytest.approx((0.2, 1000.0))


def test_the_ping_with_the_shortest_way_is_believed_about_the_clock():
    pings = PingStatistics()
    for sent, took, error in ((0, 0.3, 0.1), (1, 0.02, 0.0), (2, 0.5, -0.2)):
        pings.on_answer(pings.on_sent(sent), sent + took, robot_time=50 + sent + took / 2 + error)
    assert (pings.rtt, pings.offset) == pytest.approx((0.5, 50.0))


def test_only_the_last_twenty_count():
    pings = PingStatistics()
    pings.on_answer(pings.on_sent(0.0), 0.001, robot_time=99.0)
    for sent in range(1, 21):
        pings.on_answer(pings.on_sent(sent), sent + 0.1, robot_time=sent + 0.05)
    assert pings.offset == pytest.approx(0.0)


def test_an_answer_without_the_time_still_measures_the_way():
    pings = PingStatistics()
    pings.on_answer(pings.on_sent(0.0), 0.1, robot_time=math.nan)
    assert pings.rtt == pytest.approx(0.1)
    assert math.isnan(pings.offset)


def test_a_ping_is_lost_when_late_and_found_again_when_answered():
    pings = PingStatistics()
    late = pings.on_sent(0.0)
    pings.on_sent(1.0)
    assert [pings.lost(now) for now in (1.0, 1.6, 2.6)] == [0, 1, 2]
    pings.on_answer(late, 2.6, robot_time=0.0)
    assert pings.lost(2.6) == 1
