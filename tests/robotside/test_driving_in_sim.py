"""Every kind of simulated vehicle driven by the controls of its kind, and kept to its limits."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, StartTaskRequest, TaskOrder
from bridge.msgs.std_msgs import Header, Time
from robotside.core.config import Config, LimitSettings, Ring
from robotside.motion.manoeuvres import Order
from tests.robotside.hand import Hand, steer, tilt

pytestmark = pytest.mark.slow

Make = Callable[..., Hand]


@pytest.fixture
def hand(tmp_path: Path) -> Iterator[Make]:
    hands = []

    def make(name: str, **limits: object) -> Hand:
        hands.append(Hand(name, tmp_path, Config(limits=LimitSettings(**limits))))  # type: ignore[arg-type]
        return hands[-1]

    yield make
    for each in hands:
        each.close()


def box(x: float, y: float, reach: float) -> Ring:
    return ((x - reach, y - reach), (x + reach, y - reach), (x + reach, y + reach), (x - reach, y + reach))


def test_a_truck_is_steered_round_a_circle(hand: Make) -> None:
    run = hand("commander")
    run.push(steer(-0.3, speed=1.5), 3.0)
    turning = run.state.turning[2]
    assert math.hypot(*run.state.velocity[:2]) == pytest.approx(1.5, abs=0.1)
    assert turning == pytest.approx(-1.5 * math.tan(0.3) / 2.0, rel=0.05)


def test_a_boat_is_steered_by_rudder_and_throttle_and_keeps_to_its_speed(hand: Make) -> None:
    run = hand("minnow", max_speed=0.8)
    start = run.yaw
    run.push(steer(0.0, throttle=1.0), 4.0)
    assert 0.6 < run.speed < 0.95
    assert run.yaw == pytest.approx(start, abs=0.15)
    run.push(steer(0.4, throttle=0.5), 3.0)
    assert run.yaw - start > 0.3


def test_a_boat_at_full_throttle_does_not_cross_its_fence(hand: Make) -> None:
    run = hand("minnow", keep_in=(box(-33.0, -24.0, 12.0),))
    run.push(steer(0.0, throttle=1.0), 14.0)
    pose = run.station.autonomy.pose_estimator.pose
    assert pose is not None
    assert max(pose.x + 33.0, pose.y + 24.0) == pytest.approx(9.8, abs=0.4)  # a fix may be off by 1.7 m
    assert any("The robot's fence" in event for event in run.events)
    assert run.speed < 0.3


def test_a_drone_flies_where_it_leans_to_and_stays_within_fence_and_height(hand: Make) -> None:
    run = hand("ardrone", keep_in=(box(-17.5, -12.0, 6.0),), max_height=2.0)
    run.lift()
    run.push(tilt(z=1.0), 4.0)
    assert run.height == pytest.approx(2.0, abs=0.1)
    begun = run.state.position[1]
    run.push(tilt(pitch=0.2), 1.5)
    assert run.state.position[1] - begun > 1.0  # it looks north
    highest = farthest = 0.0
    for _ in range(14):
        run.push(tilt(z=1.0, pitch=0.35), 0.5)
        highest, farthest = max(highest, run.height), max(farthest, run.state.position[1] + 12.0)
    assert highest < 2.1
    assert 4.5 < farthest < 6.0
    assert run.speed < 0.1


@pytest.mark.parametrize("up", [tilt(z=1.0), tilt(z=0.3, pitch=0.2), Twist(Vector3(0.0, 0.0, 1.0))])
def test_sticks_alone_start_no_rotors_and_that_is_said(hand: Make, up: Order) -> None:
    run = hand("ardrone")
    run.push(up, 1.0)
    assert run.height < 0.06
    assert max(run.robot.simulation.vehicle.rotors.speeds) == 0.0  # type: ignore[attr-defined]  # a quadrotor's
    said = "Ardrone-1 stands on the ground: The sticks cannot start the rotors. Slide to take off."
    assert run.events.count(said) == 1
    order = TaskOrder(task="take_off", height=1.0)
    assert run.ask("/task/start", StartTaskRequest(order=order)).success
    run.push(up, 3.0)  # held all the while, it does not take the robot from its task
    assert run.station.autonomy.engine.status.state == "SUCCEEDED"
    assert run.height == pytest.approx(1.0, abs=0.3)


def test_a_drone_that_leans_no_more_stays_where_it_is(hand: Make) -> None:
    run = hand("ardrone")
    run.lift()
    run.push(tilt(pitch=0.25), 2.0)
    assert run.speed > 2.0
    run.push(tilt(), 3.0)
    before = run.state.position
    run.push(tilt(), 2.0)
    assert math.dist(before, run.state.position) < 0.1


def test_a_swimmer_dives_by_leaning_and_goes_no_deeper_than_it_may(hand: Make) -> None:
    run = hand("aqua", max_depth=1.8)
    deepest = 0.0
    for order in (tilt(pitch=0.5, throttle=1.0), tilt(z=-0.25)):
        for _ in range(14):
            run.push(order, 0.5)
            deepest = min(deepest, run.height)
    assert deepest == pytest.approx(-1.8, abs=0.12)
    assert "The robot goes no deeper than 1.8 m of depth." in run.events


def test_a_slow_link_makes_it_lean_less(hand: Make) -> None:
    run = hand("ardrone")
    run.lift()
    run.anna.rtt = 0.4
    run.push(tilt(pitch=0.35), 2.0)
    assert run.robot.simulation.vehicle.order.pitch == pytest.approx(0.15 * 0.35)  # type: ignore[attr-defined]  # the drive's
    assert run.speed < 1.2


@pytest.mark.parametrize(
    ("name", "order", "why"),
    [
        ("patrol", tilt(pitch=0.2), "Patrol-1 cannot tilt."),
        ("scout", steer(0.2, speed=0.2), "Scout-1 cannot steer."),
        ("aqua", Manoeuvre(kind="surface"), "it is twist, steer or tilt, not 'surface'."),
        ("ardrone", tilt(pitch=math.nan), "its speeds are not all numbers."),
    ],
)
def test_an_order_that_it_cannot_follow_is_dropped_and_said(
    hand: Make, name: str, order: Order, why: str
) -> None:
    run = hand(name)
    dropped = run.station.controls.dropped
    run.push(order, 0.3)
    assert run.station.controls.dropped == dropped + 3
    assert next(event for event in run.events if event.startswith("A drive command")).endswith(why)
    assert run.station.controls.driver is None


def test_a_late_manoeuvre_is_dropped_like_a_late_twist(hand: Make) -> None:
    run = hand("minnow")
    run.anna.asked_time = True
    order = steer(0.2, throttle=0.5)
    run.station.on_message(run.anna, "/cmd_manoeuvre", order, run.now - 0.5)
    assert "it came 0.5 s late" in run.events[-1]
    said = len(run.events)
    run.wait(3.2)
    stamped = msgspec.structs.replace(order, header=Header(Time.at(run.now - 0.4)))
    run.station.on_message(run.anna, "/cmd_manoeuvre", stamped, None)
    assert "it came 0.4 s late" in run.events[said]
    run.station.on_message(run.anna, "/cmd_vel", Twist(), None)
    run.station.on_message(run.anna, "/cmd_manoeuvre", order, run.now)
    run.wait(0.1)
    assert run.robot.simulation.vehicle.order.kind == "steer"  # type: ignore[attr-defined]  # the drive's
    run.wait(0.25)
    assert run.robot.simulation.vehicle.order.kind == "hover"  # type: ignore[attr-defined]  # the drive's


def test_twists_and_manoeuvres_follow_each_other(hand: Make) -> None:
    run = hand("commander")
    run.push(steer(0.0, speed=0.8), 1.5)
    run.push(Twist.planar(0.8, 0.0), 1.0)
    assert run.robot.simulation.vehicle.order.kind == "twist"  # type: ignore[attr-defined]  # the drive's
    assert run.speed == pytest.approx(0.8, abs=0.1)
