"""A run whose time is given up: nothing moves meanwhile, and what is measured afterwards is as fresh as ever."""

from __future__ import annotations

import pytest

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from sim.robot import make_several


def stamps(messages: list[tuple[str, Msg]]) -> list[float]:
    return [msg.header.stamp.seconds for _, msg in messages if isinstance(msg, Odometry)]


def test_what_is_skipped_is_not_simulated_and_its_stamps_are_those_of_now_for_all_robots_of_the_world() -> (
    None
):
    one, other = make_several(["scout", "scout"], "office", camera=False, noise=False)
    try:
        for robot in (one, other):
            robot.read(100.0)
        one.drive(Twist.planar(0.2, 0.0))
        one.read(101.0)
        x, y, _ = one.simulation.pose()
        for robot in (one, other):
            robot.skip_to(126.0)
        assert one.simulation.time == pytest.approx(1.0)
        assert one.simulation.pose()[:2] == (x, y)
        fresh = [stamps(one.read(126.2)), stamps(other.read(126.2))]
        assert one.simulation.time == pytest.approx(1.2, abs=0.01)
        assert fresh[0]
        assert min(fresh[0]) > 126.0
        assert 126.1 < max(fresh[0]) <= 126.2
        assert max(fresh[1]) == pytest.approx(max(fresh[0]), abs=0.05)
    finally:
        one.close()
        other.close()


def test_a_run_does_not_go_back() -> None:
    (robot,) = make_several(["scout"], "office", camera=False, noise=False)
    try:
        robot.read(100.0)
        robot.read(101.0)
        robot.skip_to(100.5)
        assert stamps(robot.read(101.2))[-1] == pytest.approx(101.2, abs=0.1)
        assert robot.simulation.time == pytest.approx(1.2, abs=0.01)
    finally:
        robot.close()
