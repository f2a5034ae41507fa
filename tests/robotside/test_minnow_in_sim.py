"""A boat at work on the lake, with waves, wind and a current."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import CommandRequest, Waypoint
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

POINTS = [Waypoint(-10.0, -15.0), Waypoint(0.0, 10.0)]
START = Waypoint(-30.0, -20.0)


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    run = Run(make("minnow", "lake", seed=2, camera=False), tmp_path)
    yield run
    run.station.close()


def test_it_passes_its_waypoints_within_their_circle_and_comes_home(run: Run) -> None:
    run.patrol(POINTS, home=[START])
    trail = run.finish()
    assert run.task.reason == "Patrol done: 2 points visited."
    for point in POINTS:  # a circle of 1.5 m, and what its satellite receiver errs
        assert min(math.hypot(x - point.x, y - point.y) for x, y in trail) < 3.0
    run.ask("/task/go_home", CommandRequest())
    run.finish()
    assert run.task.reason == "Home."
    assert math.hypot(run.place[0] - START.x, run.place[1] - START.y) < 3.5
    assert run.robot.simulation.contacts == 0


def test_it_comes_about_and_follows_a_heading_by_its_throttle(run: Run) -> None:
    run.order("follow_heading", heading=0.0, throttle=0.6, duration=15.0)
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    assert run.task.state == "SUCCEEDED"
    assert yaw == pytest.approx(0.0, abs=0.2)


def test_it_holds_its_place_against_the_current(run: Run) -> None:
    begun = run.place
    run.order("hold", duration=120.0)
    far = 0.0
    while run.station.autonomy.engine.running:
        run.wait(0.5)
        far = max(far, math.dist(begun, run.place))
    assert run.task.reason == "Held for 120 s."
    assert far < 8.0  # of 12 m that the current alone would carry it
    assert any("carried away" in event.text for event in run.station.events.since(0, "b1")) or far > 3.0
