"""Links of real robot sides are cut at full speed: by RST and in silence. How soon it rests `bench/link_cuts.py` measures."""

from __future__ import annotations

import math

from bench.link_cuts import cuts
from bench.support.cuts import ours


def test_the_robot_is_told_to_rest_and_does_and_nothing_that_waited_in_the_line_moves_it() -> None:
    found = [each for its in cuts(("quadrotor", "wheels"), 2, ours).values() for each in its]
    assert {each.hard for each in found} == {True, False}
    assert all(each.zero < math.inf and each.rest < math.inf for each in found)
    assert not any(each.old for each in found)
