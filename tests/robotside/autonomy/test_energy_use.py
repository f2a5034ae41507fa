"""What the way takes, against a battery that loses evenly."""

from __future__ import annotations

import math

import pytest

from robotside.autonomy.energy_use import DETOURS, RESERVE, EnergyUse


def test_the_need_is_that_of_the_way_with_a_reserve():
    use = EnergyUse()
    for metre in range(0, 300, 5):
        use.note(0.9 - 0.0005 * metre, float(metre), charging=False)
    assert use.per_metre == pytest.approx(0.0005, rel=0.1)
    assert use.needed(100.0) == pytest.approx(RESERVE + DETOURS * 100 * 0.0005, rel=0.1)


def test_it_is_not_known_before_it_has_lost_enough_on_enough_way():
    use = EnergyUse()
    assert math.isnan(use.per_metre)
    assert use.needed(100.0) == 0.0
    for metre in range(30):
        use.note(0.9 - 0.0005 * metre, float(metre), charging=False)
    assert use.needed(100.0) == 0.0
    standing = EnergyUse()
    for step in range(10):
        standing.note(0.9 - 0.01 * step, 1.0, charging=False)
    assert standing.needed(100.0) == 0.0


def test_charging_teaches_nothing():
    use = EnergyUse()
    for metre in range(0, 300, 5):
        use.note(0.9 - 0.0005 * metre, float(metre), charging=False)
    use.note(0.9, 300.0, charging=True)
    assert math.isnan(use.per_metre)
    use.note(math.nan, 300.0, charging=False)
    assert math.isnan(use.per_metre)


def test_a_distance_that_is_not_known_needs_nothing_told():
    use = EnergyUse()
    for metre in range(0, 300, 5):
        use.note(0.9 - 0.0005 * metre, float(metre), charging=False)
    assert use.needed(math.nan) == 0.0
