"""What another subscriber costs."""

from __future__ import annotations

import pytest

from bench.bridge import FIGURES, more


def test_what_each_subscriber_after_the_first_costs_is_a_share_of_the_first():
    assert more(10.0, 19.0) == pytest.approx(10.0)
    assert more(10.0, 100.0) == pytest.approx(100.0)
    assert more(10.0, 10.0) == 0.0


def test_a_promised_share_of_the_real_servers_cost_is_the_target():
    figures = {figure.name: figure for figure in FIGURES}
    assert figures["relay_odom_1"].target == pytest.approx(311 / 15)
    assert figures["robot_scan"].target is None
    assert figures["robot_scan"].stated.value == 575
