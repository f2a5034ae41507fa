"""When a link counts as healed after an outage."""

from __future__ import annotations

import math

import pytest

from bench.bridge_trouble import healing


def test_a_link_has_healed_when_telemetry_and_a_new_command_have_passed():
    assert healing(10.0, [9.0, 10.5, 10.6], [(10.9, 10.8), (11.5, 11.4)]) == pytest.approx(0.9)
    assert healing(10.0, [9.0, 11.5], [(10.9, 10.8)]) == pytest.approx(1.5)


def test_a_command_from_before_does_not_heal_however_late_it_comes():
    assert healing(10.0, [10.5], [(10.2, 8.0), (12.0, 11.9)]) == pytest.approx(2.0)


def test_without_telemetry_or_commands_it_has_not_healed():
    assert healing(10.0, [9.9], [(10.2, 10.1)]) == math.inf
    assert healing(10.0, [10.1], []) == math.inf
