"""A simulated robot goes to the dock of its world and charges, by the whole robot side, measured against the truth."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import SetPlaceRequest
from bridge.msgs.sensor_msgs import BatteryState
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Run]]:
    runs: list[Run] = []

    def begin(world: str) -> Run:
        run = Run(make("patrol", world, seed=7, camera=False), tmp_path)
        runs.append(run)
        for place in run.robot.places:
            if place.kind == "dock":
                run.ask("/places/set", SetPlaceRequest(place=place))
        return run

    yield begin
    for run in runs:
        run.station.close()


@pytest.mark.parametrize("world", ["office", "parking_lot"])
def test_it_goes_to_the_dock_of_its_world_and_charges_without_a_bump(
    start: Callable[..., Run], world: str
) -> None:
    run = start(world)
    run.order("dock")
    run.finish()
    vehicle = run.robot.simulation.vehicle
    assert run.task.reason.endswith("the battery takes charge.")
    assert vehicle.dock is not None
    assert vehicle.battery.status == BatteryState.POWER_SUPPLY_STATUS_CHARGING
    charge = vehicle.battery.charge
    run.wait(5.0)
    assert vehicle.battery.charge > charge
    assert run.robot.simulation.contacts == 0


def test_at_a_dock_without_current_it_says_so(start: Callable[..., Run]) -> None:
    run = start("office")
    run.robot.simulation.dead_docks.add("dock")
    run.order("dock")
    run.finish()
    assert run.task.state != "SUCCEEDED"
    assert run.robot.simulation.vehicle.battery.current < 0
    assert run.task.code == Code.DOCK_DEAD.value
