"""The robot whose port tells what passes through it."""

from __future__ import annotations

from bench.support.probe import Probe
from robotside.core.robot import Robot


def test_it_has_all_that_a_robot_has():
    needed = {name for name in dir(Robot) if not name.startswith("_")} - {"info"}
    assert needed <= set(dir(Probe))
