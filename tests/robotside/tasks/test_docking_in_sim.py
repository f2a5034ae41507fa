"""Docking on the simulated robots, measured against where they and their docks really are."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.msgs.pilothouse_msgs import CommandRequest, Manoeuvre, Place, SetPlaceRequest, Waypoint
from robotside.core.pose2 import ORIGIN, Pose2
from sim.core.shapes import from_yaw
from sim.robot import make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Run]]:
    runs: list[Run] = []

    def begin(name: str, world: str, off: Pose2 = ORIGIN, *, camera: bool = False) -> Run:
        """With the place of the dock wrong by `off`, in the frame of the dock."""
        run = Run(make(name, world, seed=7, camera=camera), tmp_path)
        runs.append(run)
        if name in ("aqua", "minnow"):  # nothing swims here to look for, and looking takes most of the time
            run.station.autonomy.watch.on_image = lambda *_, **__: None  # type: ignore[method-assign]
        dock = next(place for place in run.robot.places if place.kind == "dock")
        x, y, yaw = Pose2(dock.x, dock.y, dock.yaw).then(off)
        place = Place(name="Charger", kind="dock", x=x, y=y, yaw=yaw, height=dock.height)
        run.ask("/places/set", SetPlaceRequest(place=place))
        return run

    yield begin
    for run in runs:
        run.station.close()


def docked(run: Run) -> bool:
    """By the simulation itself: its contacts meet the dock's."""
    return run.robot.simulation.vehicle.dock is not None


@pytest.mark.parametrize(("aside", "turned"), [(0.0, 0), (0.25, 10), (-0.25, -10)])
def test_by_its_reflectors_the_patrol_docks_though_the_map_has_the_dock_elsewhere(
    start: Callable[..., Run], aside: float, turned: int
) -> None:
    run = start("patrol", "parking_lot", Pose2(-0.17 if aside else 0.0, aside, math.radians(turned)))
    run.order("dock", "Charger")
    run.until(lambda: run.task.phase == "docking", 120.0)
    run.finish()
    assert run.task.reason == "Docked at Charger: the battery takes charge."
    assert docked(run)
    run.order("undock")
    run.finish()
    assert run.task.reason == "Out of Charger."
    assert not docked(run)


@pytest.mark.parametrize(
    ("world", "off"),
    [
        ("parking_lot", (0.17, 0.25, 10.0)),
        ("parking_lot", (-0.17, -0.25, -10.0)),
        ("orchard", (0.0, 0.0, 0.0)),
    ],
)
def test_by_its_reflectors_the_truck_docks_though_the_map_has_the_dock_elsewhere(
    start: Callable[..., Run], world: str, off: tuple[float, float, float]
) -> None:
    run = start("commander", world, Pose2(off[0], off[1], math.radians(off[2])))
    run.order("dock", "Charger")
    run.finish()
    assert run.task.reason == "Docked at Charger: the battery takes charge."
    assert docked(run)
    assert math.hypot(*run.robot.simulation.vehicle.state().velocity[:2]) < 0.12
    assert run.robot.simulation.contacts == 0
    run.order("undock")
    run.finish()
    assert run.task.reason == "Out of Charger."
    assert not docked(run)


def test_stop_holds_a_truck_that_goes_up_to_its_dock(start: Callable[..., Run]) -> None:
    run = start("commander", "orchard")
    run.order("dock", "Charger")
    run.until(lambda: run.task.reason.startswith("Going up"), 120.0)
    run.wait(2.0)
    run.ask("/stop", CommandRequest())
    run.wait(1.0)
    where = run.place
    run.wait(5.0)
    assert math.dist(where, run.place) < 0.01
    assert not docked(run)


def test_by_its_tag_the_scout_docks_though_the_map_has_the_dock_elsewhere(start: Callable[..., Run]) -> None:
    run = start("scout", "office", Pose2(-0.15, 0.25, math.radians(10)), camera=True)
    run.order("dock", "Charger")
    run.until(lambda: run.task.reason.startswith("Going up"), 120.0)
    assert run.task.reason == "Going up to Charger, by its tag."
    run.finish()
    assert run.task.reason == "Docked at Charger: the battery takes charge."
    assert docked(run)


def test_without_a_camera_the_scout_docks_by_the_map_and_says_so(start: Callable[..., Run]) -> None:
    run = start("scout", "office")
    run.order("dock", "Charger")
    run.until(lambda: run.task.reason.startswith("Going up"), 120.0)
    assert run.task.reason == "Going up to Charger, by the map only."
    run.finish()
    assert docked(run)


def test_a_low_battery_on_patrol_charges_and_goes_on(start: Callable[..., Run]) -> None:
    run = start("patrol", "parking_lot")
    battery = run.robot.simulation.vehicle.battery
    run.patrol([Waypoint(-17.5, -5.0), Waypoint(-17.5, 2.0), Waypoint(-17.5, -5.0)])
    run.until(lambda: run.task.visited == 1, 60.0)
    battery.charge = 0.14
    run.until(lambda: run.task.phase == "charging", 200.0)
    assert docked(run)
    assert (run.task.task, run.task.visited) == ("patrol", 1)
    before = battery.charge
    run.wait(30.0)
    assert battery.charge > before
    battery.charge = 0.79
    run.until(lambda: run.task.phase == "driving", 400.0)
    assert battery.charge > 0.79
    assert not docked(run)
    run.finish()
    assert (run.task.state, run.task.visited) == ("SUCCEEDED", 3)


def test_a_low_battery_has_a_truck_charge_and_go_on_with_its_patrol(start: Callable[..., Run]) -> None:
    run = start("commander", "orchard")
    battery = run.robot.simulation.vehicle.battery
    x, y = run.place
    run.patrol([Waypoint(x, y), Waypoint(x + 1.0, y)], home=[Waypoint(x, y)])
    battery.charge = 0.14
    run.until(lambda: run.task.phase == "charging", 300.0)
    assert docked(run)
    assert run.task.task == "patrol"
    battery.charge = 0.799
    run.until(lambda: run.task.phase == "driving", 200.0)
    assert battery.charge > 0.7995
    assert not docked(run)
    run.finish()
    assert run.task.state == "SUCCEEDED"


@pytest.mark.parametrize(("world", "off"), [("office", (-0.8, -0.9)), ("lake", (0.3, 0.6))])
def test_by_the_tag_below_the_drone_lands_on_its_pad_though_the_map_has_it_elsewhere(
    start: Callable[..., Run], world: str, off: tuple[float, float]
) -> None:
    run = start("ardrone", world, Pose2(*off, 0.0), camera=True)
    run.order("dock", "Charger")
    run.finish(150.0)
    assert run.task.reason == "Docked at Charger: the battery takes charge."
    assert docked(run)
    charge = run.robot.simulation.vehicle.battery.charge
    run.wait(5.0)
    assert run.robot.simulation.vehicle.battery.charge > charge
    assert run.robot.simulation.contacts == 0


def test_a_low_battery_has_a_drone_charge_on_its_pad_and_go_on_with_its_patrol(
    start: Callable[..., Run],
) -> None:
    run = start("ardrone", "office", Pose2(0.2, 0.3, 0.0), camera=True)
    battery = run.robot.simulation.vehicle.battery
    run.patrol([Waypoint(-10.0, -1.2), Waypoint(-11.0, -3.0)], home=[Waypoint(-11.6, -1.2)])
    run.until(lambda: run.task.phase == "driving", 10.0)
    battery.charge = 0.14
    run.until(lambda: run.task.phase == "charging", 120.0)
    assert docked(run)
    assert run.task.task == "patrol"
    battery.charge = 0.795
    run.until(lambda: run.task.phase == "taking off", 60.0)
    assert battery.charge >= 0.8
    run.finish(120.0)
    assert (run.task.state, run.task.visited) == ("SUCCEEDED", 2)
    assert not docked(run)


def put_before(run: Run, away: float, aside: float, turned: float) -> None:
    """Put the robot afloat before its dock, at rest and at its depth, `away` from where it is docked [m], and have the robot side know it."""
    dock = next(place for place in run.robot.places if place.kind == "dock")
    at = Pose2(dock.x, dock.y, dock.yaw).then(Pose2(-away, aside, turned))
    simulation = run.robot.simulation
    simulation.backend.place(simulation.vehicle.body, (at.x, at.y, dock.height), from_yaw(at.yaw))
    run.robot.manoeuvre(Manoeuvre(kind="hover", yaw=at.yaw, height=dock.height))
    run.wait(1.0)
    run.station.autonomy.place(Pose2(*simulation.pose()))


def test_before_a_cage_that_is_not_there_the_swimmer_says_so_and_goes_in_nowhere(
    start: Callable[..., Run],
) -> None:
    run = start("aqua", "tank", Pose2(-4.5, 0.0, 0.0), camera=True)
    run.order("dock", "Charger")
    trail = run.finish(200.0)
    assert run.task.reason == (
        "Charger is not seen: no tag of a cage is where it should be; the robot keeps its depth there."
    )
    assert min(y for _, y in trail) > -4.0
    assert run.robot.simulation.contacts == 0


def test_stop_holds_a_swimmer_on_its_way_into_the_cage(start: Callable[..., Run]) -> None:
    run = start("aqua", "tank", camera=True)
    put_before(run, 2.0, 0.2, 0.1)
    run.order("dock", "Charger")
    run.until(lambda: run.task.reason.startswith("Coming up"), 120.0)
    run.ask("/stop", CommandRequest())
    run.wait(0.2)
    assert run.robot.simulation.vehicle.order.kind == "rest"
    run.wait(3.0)
    assert run.robot.simulation.vehicle.order.kind == "rest"
    assert not docked(run)


@pytest.mark.parametrize(("world", "aside", "turned"), [("tank", 0.3, 10), ("lake", -0.2, -10)])
def test_by_the_tag_over_the_coil_the_swimmer_docks_though_the_map_has_the_cage_elsewhere(
    start: Callable[..., Run], world: str, aside: float, turned: int
) -> None:
    run = start("aqua", world, Pose2(-0.2, aside, math.radians(turned)), camera=True)
    put_before(run, 2.2, 0.3, -0.2)
    run.order("dock", "Charger")
    run.finish()
    assert run.task.reason == "Docked at Charger: the battery takes charge."
    run.wait(10.0)
    assert docked(run)
    run.order("undock")
    run.finish()
    assert run.task.reason == "Out of Charger."
    assert not docked(run)


def test_a_low_battery_has_a_swimmer_charge_in_its_cage_and_go_on_with_its_patrol(
    start: Callable[..., Run],
) -> None:
    run = start("aqua", "tank", Pose2(0.1, 0.2, 0.1), camera=True)
    battery = run.robot.simulation.vehicle.battery
    run.patrol([Waypoint(-8.0, -2.5), Waypoint(-6.5, -2.0)], home=[Waypoint(-7.0, 0.0)])
    run.until(lambda: run.task.phase == "driving", 10.0)
    battery.charge = 0.14
    run.until(lambda: run.task.phase == "charging", 200.0)
    assert docked(run)
    assert run.task.task == "patrol"
    run.wait(20.0)
    assert docked(run)
    battery.charge = 0.795
    run.until(lambda: run.task.phase == "undocking", 120.0)
    assert battery.charge >= 0.8
    run.finish(200.0)
    assert (run.task.state, run.task.visited) == ("SUCCEEDED", 2)
    assert not docked(run)


@pytest.mark.parametrize(
    ("world", "off"),
    [("lake", (0.2, 0.2, 10.0)), ("lake", (-0.2, -0.2, -10.0)), ("tank", (0.0, 0.3, 10.0))],
)
def test_by_the_tag_on_its_post_the_boat_docks_though_the_map_has_the_jetty_elsewhere(
    start: Callable[..., Run], world: str, off: tuple[float, float, float]
) -> None:
    run = start("minnow", world, Pose2(off[0], off[1], math.radians(off[2])), camera=True)
    if world == "tank":
        put_before(run, 7.0, 0.5, -0.2)
    simulation = run.robot.simulation
    run.order("dock", "Charger")
    touches, before = [], simulation.contacts
    while run.station.autonomy.engine.running:
        fast = math.hypot(*simulation.vehicle.state().velocity[:2])
        run.wait(1 / 30)
        if simulation.contacts > before:
            touches.append(max(fast, math.hypot(*simulation.vehicle.state().velocity[:2])))
            before = simulation.contacts
    assert run.task.reason == "Docked at Charger: the battery takes charge."
    assert max(touches, default=0.0) < 0.18
    for _ in range(20):
        run.wait(0.5)
        assert docked(run)
        assert math.hypot(*simulation.vehicle.state().velocity[:2]) < 0.1
    run.order("undock")
    run.finish()
    assert run.task.reason == "Out of Charger."
    assert not docked(run)


@pytest.mark.parametrize("doing", ["Heading", "Coming up", "Waiting for"])
def test_stop_holds_a_boat_at_each_phase_of_docking(start: Callable[..., Run], doing: str) -> None:
    run = start("minnow", "tank", Pose2(0.0, 0.2, 0.1), camera=True)
    put_before(run, 7.0, 0.4, -2.0 if doing == "Heading" else -0.2)
    run.order("dock", "Charger")
    run.until(lambda: run.task.reason.startswith(doing), 200.0)
    assert run.task.reason.startswith(doing)
    run.wait(1.0)
    run.ask("/stop", CommandRequest())
    run.wait(3.0)
    for _ in range(10):
        run.wait(0.5)
        assert run.robot.simulation.vehicle.order.kind == "rest"
        assert math.hypot(*run.robot.simulation.vehicle.state().velocity[:2]) < 0.1


def test_a_low_battery_has_a_boat_charge_at_its_jetty_and_go_on_with_its_patrol(
    start: Callable[..., Run],
) -> None:
    run = start("minnow", "lake", Pose2(0.1, 0.2, 0.1), camera=True)
    battery = run.robot.simulation.vehicle.battery
    run.patrol([Waypoint(-31.0, -18.0), Waypoint(-33.0, -22.0)], home=[Waypoint(-34.0, -24.0)])
    run.until(lambda: run.task.phase == "driving", 10.0)
    battery.charge = 0.14
    run.until(lambda: run.task.phase == "charging", 300.0)
    assert docked(run)
    assert run.task.task == "patrol"
    run.wait(20.0)
    assert docked(run)
    battery.charge = 0.795
    run.until(lambda: run.task.phase == "undocking", 200.0)
    assert battery.charge >= 0.8
    run.finish(300.0)
    assert (run.task.state, run.task.visited) == ("SUCCEEDED", 2)
    assert not docked(run)
