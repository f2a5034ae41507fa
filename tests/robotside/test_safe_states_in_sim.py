"""What every kind of simulated vehicle does when nobody drives it any more, when STOP is pressed, and when it lies on its back."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, StartTaskRequest, TaskOrder, Waypoint
from robotside.core.config import DEFAULT_CONFIG, Config, SafeStateSettings
from robotside.motion.manoeuvres import Order
from tests.robotside.hand import UPSIDE_DOWN, Hand, steer, tilt

pytestmark = pytest.mark.slow

Make = Callable[..., Hand]
AHEAD = Twist.planar(0.5, 0.0)


@pytest.fixture
def hand(tmp_path: Path) -> Iterator[Make]:
    hands = []

    def make(name: str, hold_for: float | None = None) -> Hand:
        config = Config(safe_state=SafeStateSettings(hold_for=hold_for)) if hold_for else DEFAULT_CONFIG
        hands.append(Hand(name, tmp_path, config))
        return hands[-1]

    yield make
    for each in hands:
        each.close()


def vehicle(run: Hand) -> Any:
    """Its drive, fins, propeller or rotors are of its own kind."""
    return run.robot.simulation.vehicle


def flying(hand: Make, *hold_for: float) -> Hand:
    run = hand("ardrone", *hold_for)
    run.lift(1.8)
    run.push(tilt(pitch=0.2), 1.5)
    assert run.height > 1.5
    assert run.speed > 1.5
    return run


def toss(run: Hand, height: float) -> None:
    """Lay it on its back, so high above where it is."""
    x, y, z = run.state.position
    run.robot.simulation.backend.place(run.robot.simulation.vehicle.body, (x, y, z + height), UPSIDE_DOWN)
    run.wait(1.0)


# nobody drives it


@pytest.mark.parametrize("name", ["patrol", "scout"])
def test_one_on_wheels_brakes(hand: Make, name: str) -> None:
    run = hand(name)
    run.push(AHEAD, 1.0)
    assert run.speed > 0.3
    run.wait(1.5)
    assert run.speed < 0.01


def test_a_truck_brakes_with_its_wheels_straight(hand: Make) -> None:
    run = hand("commander")
    run.push(steer(0.4, speed=1.0), 1.5)
    assert vehicle(run)._drive.steering > 0.3
    run.wait(1.5)
    assert run.speed < 0.01
    assert abs(vehicle(run)._drive.steering) < 0.01


def test_a_truck_brakes_as_hard_as_it_can_and_does_not_swing(hand: Make) -> None:
    run = hand("commander")
    run.push(steer(-0.3, speed=3.0), 1.4)
    speed, way, turning = run.speed, 0.0, abs(run.state.turning[2])
    lost = run.now
    while run.speed > 0.02:
        way += run.speed / 30
        run.wait(1 / 30)
        assert run.now - lost < 3.0
        assert abs(run.state.turning[2]) < turning + 0.05
        turning = min(turning, abs(run.state.turning[2]) + 0.05)
    assert speed > 2.0
    # its command counts on for a quarter of a second
    assert run.now - lost < speed / vehicle(run).parameters.limits.braking + 0.4
    assert way < speed * speed / 6.0 + 0.4 * speed


def test_a_boat_idles_and_holds_its_heading_in_current_and_waves(hand: Make) -> None:
    run = hand("minnow")
    run.push(steer(0.3, throttle=0.8), 2.0)
    run.wait(4.0)
    heading = run.yaw
    run.wait(15.0, heard=False)
    assert run.yaw == pytest.approx(heading, abs=0.15)
    assert abs(vehicle(run).works.throttle) <= 0.13
    assert run.speed < 0.4


def test_a_swimmer_holds_its_depth_and_then_surfaces_once(hand: Make) -> None:
    run = hand("aqua", 4.0)
    run.push(tilt(pitch=0.4, throttle=1.0), 5.0)
    run.wait(3.0)
    depth = run.height
    run.wait(4.0)
    assert depth < -1.2
    assert run.height == pytest.approx(depth, abs=0.05)
    run.wait(24.0, heard=False)
    assert run.height > -0.2
    assert [event for event in run.events if event.startswith("No one drives")] == [
        "No one drives the robot: it surfaces.",
        "No one drives the robot: it has surfaced.",
    ]
    assert max(vehicle(run).fins.amplitudes) < 0.01


def test_a_drone_hovers_where_it_was_let_go_and_then_lands(hand: Make) -> None:
    run = flying(hand, 4.0)
    run.wait(3.0)
    before = run.state.position
    run.wait(3.0)
    assert math.dist(before, run.state.position) < 0.15
    run.wait(18.0, heard=False)
    assert vehicle(run).pilot.phase == "landed"
    assert max(vehicle(run).rotors.speeds) < 1.0
    assert [event for event in run.events if event.startswith("No one drives")] == [
        "No one drives the robot: it lands.",
        "No one drives the robot: it has landed.",
    ]


def test_a_drone_that_lands_for_want_of_charge_is_not_kept_up_by_its_safe_state(hand: Make) -> None:
    run = flying(hand)
    run.wait(1.0)
    vehicle(run).battery.charge = 0.04
    run.wait(10.0)
    assert vehicle(run).pilot.phase == "landed"


def test_what_holds_it_is_told_once_so_that_it_may_know_better(
    hand: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = flying(hand, 2.0)
    told: list[str] = []
    monkeypatch.setattr(run.robot, "manoeuvre", lambda order: told.append(order.kind))
    run.wait(6.0, heard=False)
    assert told == ["hover", "land"]


def test_a_drone_on_the_ground_stays_there_and_says_nothing(hand: Make) -> None:
    run = hand("ardrone", 2.0)
    run.push(tilt(), 0.5)
    run.wait(6.0, heard=False)
    assert max(vehicle(run).rotors.speeds) == 0.0
    assert not [event for event in run.events if event.startswith("No one drives")]


# STOP


def test_stop_in_the_air_hovers_and_never_switches_the_rotors_off(hand: Make) -> None:
    run = flying(hand)
    before = run.state.position
    assert run.ask("/stop").success
    slowest = math.inf
    for _ in range(20):
        run.push(tilt(pitch=0.3, z=-1.0), 0.2)
        slowest = min(slowest, *vehicle(run).rotors.speeds)
    assert run.speed < 0.1
    assert math.dist(before, run.state.position) < 2.5
    assert slowest > 150.0
    assert (
        f"{run.station.info.name} hovers, on its battery. Hold STOP to release it, then land." in run.events
    )
    run.wait(8.0, heard=False)
    assert run.height == pytest.approx(before[2], abs=0.3)
    assert vehicle(run).pilot.phase == "flying"


def test_stop_under_water_stills_the_fins_whatever_is_pushed(hand: Make) -> None:
    run = hand("aqua")
    run.push(tilt(pitch=0.4, throttle=1.0), 3.0)
    assert run.ask("/stop").success
    run.push(tilt(pitch=0.4, throttle=1.0), 3.0)
    assert max(vehicle(run).fins.amplitudes) < 0.01
    assert run.speed < 0.15  # it glides up slowly, since it weighs less than the water
    run.push(tilt(pitch=0.4, throttle=1.0), 3.0)
    assert max(vehicle(run).fins.amplitudes) < 0.01
    assert run.state.velocity[2] > 0
    assert f"{run.station.info.name} floats up. Hold STOP to release it, then hold its depth." in run.events


def test_stop_on_the_water_takes_the_way_off_a_boat(hand: Make) -> None:
    run = hand("minnow")
    run.push(steer(0.0, throttle=1.0), 4.0)
    fast = run.speed
    assert run.ask("/stop").success
    run.push(steer(0.0, throttle=1.0), 5.0)
    assert fast > 1.2
    assert run.speed < 0.35  # current and waves take it along
    assert run.station.at_rest  # else nobody could ever let go of STOP
    assert abs(vehicle(run).works.throttle) < 0.1


# on its back


@pytest.mark.parametrize(("name", "order"), [("patrol", AHEAD), ("commander", steer(0.0, speed=1.0))])
def test_one_that_has_turned_over_stands_still_and_says_why(hand: Make, name: str, order: Order) -> None:
    run = hand(name)
    toss(run, 0.8)
    run.push(order, 2.0)
    said = f"{run.robot.info.name} has turned over"
    assert f"{said}." in run.events
    assert f"{said}; put it upright first." in run.events
    assert vehicle(run).order.kind == "rest"


def test_a_drone_that_tumbles_cuts_its_rotors_and_takes_off_no_more(hand: Make) -> None:
    run = flying(hand)
    toss(run, 0.0)
    run.wait(1.0)
    run.push(tilt(z=1.0), 2.0)
    assert max(vehicle(run).rotors.speeds) < 1.0
    assert "Ardrone-1 has turned over." in run.events


def test_a_task_waits_while_the_robot_lies_on_its_back(hand: Make) -> None:
    run = hand("patrol")
    goal = TaskOrder(task="go_to", goals=[Waypoint(-12.0, -12.0)])
    assert run.ask("/task/start", StartTaskRequest(order=goal)).success
    run.wait(1.0)
    assert run.station.autonomy.engine.running
    toss(run, 0.8)
    assert run.station.autonomy.engine.status.state == "PAUSED"
    assert run.station.autonomy.engine.status.reason == "Paused: Patrol-1 has turned over."


def test_a_swimmer_swims_on_its_back(hand: Make) -> None:
    run = hand("aqua")
    toss(run, 0.0)
    run.push(Manoeuvre(kind="twist", twist=Twist(Vector3(0.5, 0.0, 0.0))), 2.0)
    assert vehicle(run).order.kind == "twist"
    assert run.speed > 0.2
