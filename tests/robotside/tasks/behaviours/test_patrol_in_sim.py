"""Real patrols of the simulated robot, in virtual time: what the job demands, measured against the truth."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import CommandRequest, Waypoint
from sim.robot import make
from tests.robotside.sim_run import HOME, Run

pytestmark = pytest.mark.slow

ROUND = [
    Waypoint(-17.5, 7.5),
    Waypoint(0.0, 7.5),
    Waypoint(16.5, 7.5),
    Waypoint(17.0, -7.5),
    Waypoint(0.0, -7.5),
    Waypoint(-17.0, -7.5),
]
CONES = [(-19.0, -1.5), (-6.0, 9.1), (4.2, 7.15), (18.6, 3.6), (6.6, -5.4), (-2.6, -9.6)]


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Run]]:
    runs: list[Run] = []

    def begin(seed: int, *, camera: bool = False) -> Run:
        runs.append(Run(make("patrol", "parking_lot", seed=seed, camera=camera), tmp_path))
        return runs[-1]

    yield begin
    for run in runs:
        run.station.close()


def test_a_round_of_the_car_park_passes_every_point_touches_nothing_and_comes_home(
    start: Callable[..., Run],
) -> None:
    run = start(seed=2)
    run.patrol(ROUND)
    trail, worst = [], 0.0
    while run.station.autonomy.engine.running and run.now < 1400.0:
        run.wait(0.2)
        trail.append(run.place)
        worst = max(worst, run.error)
    for point in ROUND:
        assert min(math.hypot(x - point.x, y - point.y) for x, y in trail) < 0.3
    assert worst < 0.15
    run.ask("/task/go_home", CommandRequest())
    run.finish()
    assert run.station.autonomy.engine.status.reason == "Home."
    assert math.hypot(run.place[0] - HOME.x, run.place[1] - HOME.y) < 0.3
    assert run.robot.simulation.contacts == 0


def test_cones_beside_the_way_are_reported_once_each_where_they_stand(start: Callable[..., Run]) -> None:
    run = start(seed=1, camera=True)
    run.patrol([Waypoint(-17.5, -5.0)])
    run.finish()
    found = run.station.autonomy.watch.intruders.known
    assert [intruder.id for intruder in found] == [1]
    assert math.hypot(found[0].position.x - CONES[0][0], found[0].position.y - CONES[0][1]) < 1.0
    said = [event.text for event in run.station.events.since(0, "b1") if event.kind == "intruder"]
    assert len(said) == 1


def test_a_cone_on_the_way_is_passed_without_contact(start: Callable[..., Run]) -> None:
    run = start(seed=3)
    run.patrol([Waypoint(-17.5, -9.0), Waypoint(-19.0, -4.0), Waypoint(-19.0, 1.5)])
    run.finish()
    status = run.station.autonomy.engine.status
    assert (status.state, status.visited) == ("SUCCEEDED", 3)
    assert run.robot.simulation.contacts == 0


def test_pause_holds_the_robot_within_five_centimetres(start: Callable[..., Run]) -> None:
    run = start(seed=4)
    run.patrol([Waypoint(-17.5, 0.0)])
    run.wait(6.0)
    run.ask("/task/pause", CommandRequest())
    run.wait(1.2)
    x, y = run.place
    run.wait(10.0)
    assert math.hypot(run.place[0] - x, run.place[1] - y) < 0.05
