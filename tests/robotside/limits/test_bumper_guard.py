"""A stick pushes the robot into nothing that it touches."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.door.station_door import StationDoor
from robotside.limits.bumper_guard import kept_off
from robotside.motion.manoeuvres import Order
from robotside.motion.measured import MeasuredState
from sim.robot import ROBOTS, SimRobot
from sim.simulation.simulation import Simulation
from tests.robotside.sim_run import Run
from tests.sim.rooms import room

WHEELS, TRUCK = RobotInfo(kind="wheels"), RobotInfo(kind="ackermann", max_speed=5.0)
DRONE = RobotInfo(kind="quadrotor", manoeuvres=["twist", "tilt"], max_tilt=0.35)
AHEAD, BEHIND, LEFT = (MeasuredState(touched=bearing) for bearing in (0.0, math.pi, math.pi / 2))


def test_what_touches_nothing_goes_as_it_is_told() -> None:
    order = Twist.planar(0.5, 0.2)
    assert kept_off(order, WHEELS, MeasuredState()) is order


@pytest.mark.parametrize(
    ("speed", "touched", "left"),
    [(0.5, AHEAD, 0.0), (-0.5, AHEAD, -0.5), (-0.5, BEHIND, 0.0), (0.5, BEHIND, 0.5), (0.5, LEFT, 0.5)],
)
def test_wheels_turn_and_drive_away_but_not_into_it(
    speed: float, touched: MeasuredState, left: float
) -> None:
    assert kept_off(Twist.planar(speed, 0.3), WHEELS, touched) == Twist.planar(left, 0.3)


def test_a_truck_that_steers_into_it_stands() -> None:
    order = Manoeuvre(kind="steer", speed=1.0, steering=0.3)
    assert kept_off(order, TRUCK, AHEAD) == Twist()
    assert kept_off(order, TRUCK, BEHIND) is order


def test_what_flies_slides_along_it_and_still_climbs() -> None:
    pushes = Twist(Vector3(0.5, 0.4, 0.3), Vector3(0.0, 0.0, 0.2))
    slides = kept_off(pushes, DRONE, LEFT)
    assert isinstance(slides, Twist)
    assert (slides.linear.x, slides.linear.y, slides.linear.z) == pytest.approx((0.5, 0.0, 0.3))
    assert kept_off(Manoeuvre(kind="tilt", pitch=0.2), DRONE, AHEAD) == Twist()
    away = Manoeuvre(kind="tilt", pitch=-0.2)
    assert kept_off(away, DRONE, AHEAD) is away


Make = Callable[[str], "Pushed"]


class Pushed(Run):
    """A robot in a small room, pushed on by a stick."""

    hear: Callable[..., None]

    def push(self, order: Order, seconds: float) -> None:
        topic = "/cmd_vel" if isinstance(order, Twist) else "/cmd_manoeuvre"
        for _ in range(round(seconds / 0.05)):
            self.hear(self.anna, topic, order, self.now)
            self.wait(0.05)

    def said(self) -> list[str]:
        return [event.text for event in self.station.events.since(0, "") if event.kind == "contact"]


@pytest.fixture
def pushed(tmp_path: Path) -> Iterator[Make]:
    made: list[Pushed] = []

    def make(name: str) -> Pushed:
        run = Pushed(SimRobot(Simulation(room(8.0, 8.0), ROBOTS[name], noise=False), camera=False), tmp_path)
        run.hear = StationDoor(run.station).publish
        made.append(run)
        return run

    yield make
    for run in made:
        run.station.close()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "order"),
    [
        ("patrol", Twist.planar(0.5, 0.0)),
        ("commander", Manoeuvre(kind="steer", speed=1.0)),
        ("ardrone", Manoeuvre(kind="tilt", pitch=0.2)),
    ],
)
def test_a_wall_is_touched_once_and_pushed_no_more(pushed: Make, name: str, order: Order) -> None:
    run = pushed(name)
    vehicle = run.robot.simulation.vehicle
    if name == "ardrone":
        run.order("take_off", height=0.4)
        run.finish()
    run.push(order, 14.0)
    x = run.place[0]
    assert vehicle.bumper.bumps == 1
    assert run.said() == ["The bumper touched something ahead."]
    assert vehicle.order.kind in ("twist", "rest")  # type: ignore[attr-defined]  # all have one
    assert vehicle.order.twist.linear.x < 0.01  # type: ignore[attr-defined]
    run.push(Twist.planar(-0.4, 0.0), 2.0)
    assert run.place[0] < x - 0.3
