"""Links of real robot sides are cut at full speed: by RST and in silence. bench/link_cuts.py does it 500 times."""

from __future__ import annotations

from bench.link_cuts import cuts
from bench.support.cuts import ours


def test_the_robot_is_told_to_rest_in_time_and_nothing_old_moves_it_later() -> None:
    found = [each for its in cuts(("hexapod", "quadrotor"), 2, ours).values() for each in its]
    assert {each.hard for each in found} == {True, False}
    assert not [each for each in found if each.missed]
    assert all(each.rest < 3.0 for each in found)
