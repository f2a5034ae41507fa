"""A truck at work in the car park: it turns only by driving."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import CommandRequest, Waypoint
from sim.robot import make
from tests.robotside.sim_run import HOME, Run

pytestmark = pytest.mark.slow

POINTS = [Waypoint(0.0, 7.5), Waypoint(16.0, 7.0), Waypoint(17.0, -7.5)]


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    run = Run(make("commander", "parking_lot", seed=2, camera=False), tmp_path)
    yield run
    run.station.close()


def test_it_patrols_and_comes_home_looking_as_it_should_and_touches_nothing(run: Run) -> None:
    run.patrol(POINTS)
    trail = run.finish()
    assert run.task.reason == "Patrol done: 3 points visited."
    for point in POINTS:
        assert min(math.hypot(x - point.x, y - point.y) for x, y in trail) < 0.5
    run.ask("/task/go_home", CommandRequest())
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    assert run.task.reason == "Home."
    assert math.hypot(run.place[0] - HOME.x, run.place[1] - HOME.y) < 0.5
    assert yaw == pytest.approx(HOME.yaw, abs=0.4)
    assert run.robot.simulation.contacts == 0


def test_it_comes_round_to_a_heading_in_a_bend_and_follows_it(run: Run) -> None:
    before = run.place
    run.order("follow_heading", heading=math.pi / 2 - 0.6, speed=1.0, duration=6.0)
    run.wait(1.5)
    slow = math.dist(before, run.place)
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    assert run.task.state == "SUCCEEDED"
    assert 0.3 < slow < 1.6
    assert yaw == pytest.approx(math.pi / 2 - 0.6, abs=0.15)


def test_it_stops_before_the_wall_that_its_bend_would_lead_into(run: Run) -> None:
    run.order("follow_heading", heading=math.pi, speed=1.0)
    run.finish(40.0)
    state, reason = run.task.state, run.task.reason
    assert state == "FAILED"
    assert "before a wall" in reason
    assert run.robot.simulation.contacts == 0
