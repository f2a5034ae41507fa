"""Links of real robot sides are cut: at full speed by RST and in silence, and with clients of every kind that hold the stick. How soon it rests `bench/link_cuts.py` measures."""

from __future__ import annotations

import math

import pytest

from bench.link_cuts import cuts
from bench.support.child import child
from bench.support.cuts import ours
from bench.support.many_cuts import CLIENTS, HOWS, ManyCut

pytestmark = pytest.mark.slow


def test_the_robot_is_told_to_rest_and_does_and_nothing_that_waited_in_the_line_moves_it() -> None:
    found = [each for its in cuts(("quadrotor", "wheels"), 2, ours).values() for each in its]
    assert {each.hard for each in found} == {True, False}
    assert all(each.zero < math.inf and each.rest < math.inf for each in found)
    assert not any(each.old for each in found)


def test_no_client_that_holds_its_stick_moves_the_robot_after_the_cut() -> None:
    """Stamped or not: how long a command was in force is a matter of time, what was given after the cut is not."""
    with child("bench.support.many_cuts", str(len(HOWS) * len(CLIENTS)), "1") as process:
        found = [ManyCut(**each) for each in process.receive()]
    assert {(each.client, each.how) for each in found} == {
        (client, how) for client in CLIENTS for how in HOWS
    }
    assert all(each.obeyed and each.zero < math.inf for each in found)
    assert not [each for each in found if each.late]
