"""Lights and putting back: offered where the robot has them, and done by whoever has control."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    ArmOrder,
    CommandRequest,
    LightState,
    MoveArmRequest,
    SetLightsRequest,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.hand import UPSIDE_DOWN, Hand, tilt
from tests.robotside.scene import Scene

Make = Callable[..., Hand]
OURS = {"/lights/set", "/arm/move", "/robot/reset"}


@pytest.fixture
def hand(tmp_path: Path) -> Iterator[Make]:
    hands = []

    def make(name: str = "patrol", *payloads: str) -> Hand:
        hands.append(Hand(name, tmp_path, payloads=payloads))
        return hands[-1]

    yield make
    for each in hands:
        each.close()


def last(run: Hand, topic: str, seconds: float = 1.1) -> Msg:
    """What is said on a topic after a while."""
    told: list[Msg] = []
    end = run.station.bus.subscribe(topic, lambda _, msg: told.append(msg))
    run.wait(seconds)
    end()
    return told[-1]


def test_only_what_the_robot_has_is_offered(hand: Make, tmp_path: Path) -> None:
    assert OURS & set(hand("patrol", "arm", "lights").door.services) == OURS
    assert OURS & set(hand("scout", "lights").door.services) == {"/lights/set", "/robot/reset"}
    assert not OURS & set(Scene(FakeRobot(), tmp_path).door.services)


def test_lights_are_set_and_their_brightness_is_judged(hand: Make) -> None:
    run = hand("scout", "lights")
    assert run.ask("/lights/set", SetLightsRequest(brightness=0.6)).message == "The lights are at 60%."
    lit = last(run, "/lights")
    assert isinstance(lit, LightState)
    assert lit.brightness == 0.6
    answer = run.ask("/lights/set", SetLightsRequest(brightness=1.5))
    assert (answer.success, answer.message) == (
        False,
        "The brightness of the lights must be a number from 0 to 1.",
    )
    assert run.ask("/lights/set", SetLightsRequest()).message == "The lights are off."


@pytest.mark.parametrize(
    ("service", "request_"),
    [
        ("/lights/set", SetLightsRequest(brightness=0.5)),
        ("/arm/move", MoveArmRequest(order=ArmOrder(pose="home"))),
        ("/robot/reset", CommandRequest()),
    ],
)
def test_who_has_no_control_moves_nothing(hand: Make, service: str, request_: CommandRequest) -> None:
    run = hand("patrol", "arm", "lights")
    bert = FakeClient("bert", run.now)
    run.station.controls.introduce(bert, "tablet-bert", "Bert")
    assert run.ask("/control/acquire", by=bert).success
    answer = run.ask(service, request_)
    assert not answer.success
    assert answer.message.startswith("Bert has control")


# put back


def test_one_that_is_put_back_stands_at_its_start_and_knows_it(hand: Make) -> None:
    run = hand("patrol")
    start = run.state.position
    run.push(Twist.planar(0.6, 0.1), 3.0)
    x, y, z = run.state.position
    run.robot.simulation.backend.place(run.robot.simulation.vehicle.body, (x, y, z + 0.5), UPSIDE_DOWN)
    run.wait(1.0)
    answer = run.ask("/robot/reset")
    assert (answer.success, answer.message) == (True, "Patrol-1 is put back: it stands at (-17.5, -12.0).")
    assert "a client at 192.0.2.1:5000 put Patrol-1 back to its start." in run.events
    run.wait(1.0)
    assert math.dist(start, run.state.position) < 0.02
    assert run.error < 0.1
    assert run.speed < 0.01
    run.push(Twist.planar(0.5, 0.0), 2.0)
    assert math.dist(start, run.state.position) > 0.5
    assert run.error < 0.15


def test_a_task_ends_when_the_robot_is_put_back_and_stop_stays_pressed(hand: Make) -> None:
    run = hand("patrol")
    goal = TaskOrder(task="go_to", goals=[Waypoint(-12.0, -12.0)])
    assert run.ask("/task/start", StartTaskRequest(order=goal)).success
    run.wait(1.0)
    assert run.ask("/stop").success
    assert run.ask("/robot/reset").success
    status = run.station.autonomy.engine.status
    assert (status.state, status.reason) == (
        "CANCELED",
        "a client at 192.0.2.1:5000 put the robot back to its start.",
    )
    assert run.station.controls.stopped


def test_a_stick_that_is_held_does_not_drive_on_from_the_start(hand: Make) -> None:
    run = hand("patrol")
    run.push(Twist.planar(0.5, 0.0), 1.0)
    assert run.ask("/robot/reset").success
    start = run.state.position
    run.push(Twist.planar(0.5, 0.0), 1.0, from_rest=False)
    assert math.dist(start, run.state.position) < 0.02


def test_a_drone_without_a_laser_is_put_back_from_the_air_to_where_it_stood(hand: Make) -> None:
    run = hand("ardrone")
    start = run.state.position
    run.lift()
    run.push(tilt(pitch=0.3), 3.0)
    assert run.ask("/robot/reset").success
    run.wait(2.0)
    assert math.dist(start, run.state.position) < 0.02
    assert run.error < 0.1
    assert max(run.robot.simulation.vehicle.rotors.speeds) == 0.0  # type: ignore[attr-defined]  # the drone's
