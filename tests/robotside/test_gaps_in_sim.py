"""Narrow gaps between things that are not on the map, against the truth of the simulation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import Waypoint
from sim.core.shapes import Shape
from sim.robot import make_several
from sim.world.tables import Start
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

AT = 2.0
"""Where boxes close the office's corridor, which is 2.2 m wide, but for one gap [m]."""
FAR = Waypoint(4.5, 0.0)


@pytest.fixture
def corridor(tmp_path: Path) -> Iterator[Run]:
    robot = make_several([("patrol", Start(x=-0.5, y=0.0, yaw=0.0))], "office", seed=3, camera=False)[0]
    run = Run(robot, tmp_path)
    yield run
    run.station.close()


def close_but(run: Run, gap: float, aside: float) -> None:
    """Two boxes that leave a `gap` [m], whose middle is so far to the left [m]."""
    for side in (1.0, -1.0):
        inner, outer = aside + side * gap / 2, side * 1.1
        long = abs(outer - inner)
        box = Shape("box", (0.3, long, 0.6), (AT, (inner + outer) / 2, 0.3))
        run.robot.simulation.backend.add_static([box])


@pytest.mark.parametrize("aside", [0.0, 0.07])
def test_a_gap_of_half_a_metre_is_passed_slowly_and_without_contact(corridor: Run, aside: float) -> None:
    close_but(corridor, 0.5, aside)
    corridor.wait(1.0)
    corridor.order("go_to", goals=[FAR])
    fastest, least, before = 0.0, math.inf, corridor.place
    radius = corridor.robot.info.radius
    while corridor.station.autonomy.engine.running and corridor.now < 1120.0:
        corridor.wait(0.1)
        x, y = corridor.place
        if abs(x - AT) < 0.15:
            fastest = max(fastest, math.hypot(x - before[0], y - before[1]) / 0.1)
            least = min(least, 0.25 - abs(y - aside) - radius)
        before = x, y
    assert (corridor.task.state, corridor.task.reason) == ("SUCCEEDED", "Way to the goal done.")
    assert least > 0.0
    assert fastest < 0.35
    assert corridor.robot.simulation.vehicles[0].bumper.bumps == 0


def test_a_gap_of_forty_centimetres_is_refused_with_its_width_and_the_one_that_is_needed(
    corridor: Run,
) -> None:
    close_but(corridor, 0.4, 0.0)
    corridor.wait(1.0)
    corridor.order("go_to", goals=[FAR])
    corridor.finish(120.0)
    assert corridor.task.state == "FAILED"
    assert "m wide and the robot needs 0.45 m" in corridor.task.reason
    said = float(corridor.task.reason.split(" is ")[-1].split(" m wide")[0])
    assert said == pytest.approx(0.4, abs=0.04)
    assert corridor.place[0] < AT
    assert corridor.robot.simulation.vehicles[0].bumper.bumps == 0
