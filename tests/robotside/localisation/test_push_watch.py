"""Wheels that turn against something."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import Bumper
from robotside.localisation.push_watch import MAX_PUSH, PushWatch


def touching(bearing: float = math.nan, *, rolls: bool = True) -> PushWatch:
    watch = PushWatch(rolls=rolls)
    watch.on_bumper(Bumper(pressed=True, bearing=bearing))
    return watch


def test_it_pushes_where_its_bumper_says() -> None:
    assert touching(0.4).bearing(-0.2) == 0.4


@pytest.mark.parametrize(("speed", "bearing"), [(0.3, 0.0), (0.0, 0.0), (-0.3, math.pi)])
def test_what_has_no_bearing_lies_ahead_of_its_way(speed: float, bearing: float) -> None:
    assert touching().bearing(speed) == bearing


def test_with_nothing_in_touch_and_off_the_ground_there_is_no_bearing() -> None:
    watch = touching(0.4)
    watch.on_bumper(Bumper(pressed=False, bearing=0.4))
    assert math.isnan(watch.bearing(0.3))
    assert math.isnan(touching(0.4, rolls=False).bearing(0.3))


def test_more_than_a_touch_is_a_push_until_a_step_leads_away() -> None:
    watch = touching()
    watch.on_step(0.9 * MAX_PUSH)
    assert (watch.began, watch.pushes) == (True, False)
    watch.on_step(0.2 * MAX_PUSH)
    assert watch.pushes
    watch.on_step(0.0)
    assert (watch.began, watch.pushes) == (False, False)
