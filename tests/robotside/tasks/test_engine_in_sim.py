"""Each task once on the simulated robot, in virtual time, measured against the truth."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import CommandRequest, Following, Place, SetPlaceRequest, TagRead, Waypoint
from robotside.tasks.behaviours.circle import CLEARANCE
from robotside.tasks.behaviours.situation import Seen
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

CONE = (-19.0, -1.5)


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Run]]:
    runs: list[Run] = []

    def begin(*places: Place) -> Run:
        run = Run(make("patrol", "parking_lot", seed=7, camera=False), tmp_path)
        runs.append(run)
        for place in places:
            run.ask("/places/set", SetPlaceRequest(place=place))
        return run

    yield begin
    for run in runs:
        run.station.close()


def off(run: Run, x: float, y: float) -> float:
    return math.hypot(run.place[0] - x, run.place[1] - y)


def test_a_delivery(start: Callable[..., Run]) -> None:
    gate, shop = Place(name="Gate", x=-17.5, y=-9.5), Place(name="Shop", x=-16.5, y=-7.5, tag="card")
    run = start(gate, shop)
    run.order("deliver", "Gate", "Shop")
    run.until(lambda: bool(run.task.asks), 60.0)
    assert off(run, gate.x, gate.y) < 0.3
    run.ask("/task/confirm", CommandRequest())
    run.wait(0.2)
    run.until(lambda: bool(run.task.asks), 60.0)
    assert off(run, shop.x, shop.y) < 0.3
    run.tell("/tag", TagRead(tag="card"))
    run.wait(0.2)
    assert run.task.reason == "Delivered at Shop."
    assert run.robot.simulation.contacts == 0


def test_a_tour_waits_for_who_follows(start: Callable[..., Run]) -> None:
    run = start(Place(name="Gate", x=-17.5, y=-9.0))
    run.order("guide", "Gate")
    for number in range(150):
        run.tell("/following", Following(present=not 10 < number < 60))
        run.wait(0.2)
        if number == 40:
            waited, where = run.task.phase, run.place
        if number == 60:
            assert (waited, off(run, *where) < 0.05) == ("waiting", True)
    assert run.task.reason == "Guided tour done: 1 place visited."
    assert off(run, -17.5, -9.0) < 0.3


def test_going_to_a_place_and_holding_there(start: Callable[..., Run]) -> None:
    run = start(Place(name="Gate", x=-17.5, y=-10.0, yaw=0.0))
    run.order("go_to", "Gate")
    run.finish()
    assert run.task.reason == "Gate reached."
    assert off(run, -17.5, -10.0) < 0.3
    run.order("hold", duration=5.0)
    run.wait(1.0)
    where = run.place
    run.finish()
    assert off(run, *where) < 0.05


def test_following_a_heading_up_to_the_wall(start: Callable[..., Run]) -> None:
    run = start()
    run.order("follow_heading", heading=math.pi, speed=0.4)
    run.finish()
    assert run.task.reason.endswith("before a wall, the fence or the end of the map.")
    assert -19.8 < run.place[0] < -18.9
    assert abs(run.place[1] + 12.0) < 0.3
    assert run.robot.simulation.contacts == 0


def test_an_intruder_is_gone_round_without_touching_it(start: Callable[..., Run]) -> None:
    run = start()
    run.patrol([Waypoint(-17.5, -5.0), Waypoint(-17.5, 2.0)])
    run.station.autonomy.situation.intruders.append(Seen(1, *CONE))
    sides, nearest = set(), math.inf
    while run.task.state == "RUNNING" and run.now < 1300.0:
        run.wait(0.2)
        if run.task.phase == "circling":
            sides.add(round(math.atan2(run.place[1] - CONE[1], run.place[0] - CONE[0])))
            nearest = min(nearest, off(run, *CONE))
    assert len(sides) >= 3
    assert (run.task.state, run.task.visited) == ("SUCCEEDED", 2)
    said = [event.text for event in run.station.events.since(0, "") if event.kind == "intruder"]
    assert said == [
        "Intruder 1 was seen from 3 of 6 sides; not: north-west, west, south-west."
    ]  # a wall is there
    assert nearest > CLEARANCE + run.robot.info.radius
    assert run.robot.simulation.contacts == 0
