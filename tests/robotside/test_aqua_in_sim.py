"""A swimmer at work in the tank: at a depth, and up again."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Waypoint
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

POINTS = [Waypoint(-3.0, 2.0), Waypoint(1.0, 1.0)]


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Run]:
    run = Run(make("aqua", "tank", seed=2, camera=False), tmp_path)
    yield run
    run.station.close()


def depth(run: Run) -> float:
    return -run.robot.simulation.vehicle.state().position[2]


def test_it_patrols_at_its_depth_goes_to_a_place_at_another_and_surfaces(run: Run) -> None:
    run.patrol(POINTS, home=[Waypoint(-7.0, 0.0)])
    before, trail = depth(run), []
    while run.station.autonomy.engine.running:
        run.wait(0.2)
        trail.append((*run.place, depth(run)))
    assert run.task.reason == "Patrol done: 2 points visited."
    for point in POINTS:
        assert min(math.hypot(x - point.x, y - point.y) for x, y, _ in trail) < 0.8
    assert max(abs(z - before) for _, _, z in trail) < 0.15
    run.order("go_to", goals=[Waypoint(-2.0, 0.0)], height=-2.0)
    run.finish()
    assert depth(run) == pytest.approx(2.0, abs=0.2)
    run.order("surface")
    run.wait(1.0)
    assert run.task.phase == "surfacing"
    run.finish()
    assert run.task.reason == "At the surface."
    assert depth(run) < 0.15
    assert run.robot.simulation.contacts == 0


def test_it_holds_depth_and_heading_and_follows_another_heading(run: Run) -> None:
    run.order("hold", height=-1.6, duration=12.0)
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    assert run.task.reason == "Held for 12 s."
    assert depth(run) == pytest.approx(1.6, abs=0.12)
    assert yaw == pytest.approx(0.0, abs=0.1)
    run.order("follow_heading", heading=0.8, speed=0.3, duration=8.0)
    run.finish()
    _, _, yaw = run.robot.simulation.pose()
    assert yaw == pytest.approx(0.8, abs=0.15)
    assert depth(run) == pytest.approx(1.6, abs=0.2)


def test_a_depth_that_cannot_be_is_refused(run: Run) -> None:
    said = "The height of Aqua-1 in tank must be from -4.8 to 0 m, 0 being the surface, not"
    for height in (1.0, -4.9, -1000.0, -math.inf):
        with pytest.raises(AssertionError, match=f"{said} {height:g} m"):
            run.order("hold", height=height)
    assert run.station.info.tasks[-1] == "surface"
