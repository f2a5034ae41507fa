"""Asking for more than the robot may do: cut, and said with what was asked and what is allowed."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.control.limit_violations import REPORT_PERIOD, excess
from robotside.core.config import Config, LimitSettings
from robotside.motion.manoeuvres import Order
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene

TRUCK = RobotInfo(name="Truck-1", kind="ackermann", max_speed=2.5, max_yaw_rate=1.0, max_steering=0.5)
DRONE = RobotInfo(
    name="Drone-1", kind="quadrotor", max_speed=4.0, max_yaw_rate=1.75, max_climb=1.0, max_tilt=0.35
)


@pytest.mark.parametrize(
    ("order", "info", "said"),
    [
        (Twist.planar(5.0, 0.0), TRUCK, "Truck-1 goes at most 2.5 m/s; 5 m/s was requested."),
        (Twist.planar(-5.0, 0.0), TRUCK, "Truck-1 goes at most 2.5 m/s; 5 m/s was requested."),
        (Twist.planar(1e308, 9.0), TRUCK, "Truck-1 goes at most 2.5 m/s; 1e+308 m/s was requested."),
        (Twist.planar(0.0, -9.0), TRUCK, "Truck-1 turns at most 1 rad/s; 9 rad/s was requested."),
        (Manoeuvre(kind="steer", speed=99.0), TRUCK, "Truck-1 goes at most 2.5 m/s; 99 m/s was requested."),
        (
            Manoeuvre(kind="steer", speed=1.0, steering=-3.0),
            TRUCK,
            "Truck-1 steers at most 0.5 rad; 3 rad was requested.",
        ),
        (
            Manoeuvre(kind="steer", throttle=50.0),
            TRUCK,
            "Truck-1 takes a throttle of at most 1; 50 was requested.",
        ),
        (Manoeuvre(kind="tilt", roll=1.2), DRONE, "Drone-1 leans at most 0.35 rad; 1.2 rad was requested."),
        (
            Manoeuvre(kind="tilt", twist=Twist(Vector3(0.0, 0.0, 7.0))),
            DRONE,
            "Drone-1 climbs and sinks at most 1 m/s; 7 m/s was requested.",
        ),
    ],
)
def test_the_sentence_names_what_was_asked_and_what_is_allowed(
    order: Order, info: RobotInfo, said: str
) -> None:
    assert excess(order, info) == said


@pytest.mark.parametrize(
    ("order", "info"),
    [
        (Twist.planar(2.5, 1.0), TRUCK),
        (Twist.planar(2.5 * 1.0000001, 0.0), TRUCK),
        (Manoeuvre(kind="steer", throttle=1.0, steering=0.5, speed=math.nan), TRUCK),
        (Manoeuvre(kind="tilt", roll=0.35, pitch=-0.35, twist=Twist(Vector3(0.0, 0.0, 1.0))), DRONE),
        (Twist(Vector3(4.0, 0.0, 1.0), Vector3(0.0, 0.0, 1.75)), DRONE),
    ],
)
def test_controls_at_their_stops_say_nothing(order: Order, info: RobotInfo) -> None:
    assert excess(order, info) == ""


def test_everyone_is_told_every_few_seconds_while_it_goes_on(scene: Scene) -> None:
    said = "goes at most 0.7 m/s; 5 m/s was requested."
    scene.drive(Twist.planar(5.0, 0.0))
    assert scene.robot.twist == Twist.planar(0.7, 0.0)
    assert [text.endswith(said) for text in scene.events("command")] == [True]
    scene.drive(Twist.planar(5.0, 0.0))
    assert len(scene.events("command")) == 1
    scene.run(REPORT_PERIOD + 0.1)
    scene.drive(Twist.planar(5.0, 0.0))
    assert len(scene.events("command")) == 2


def test_somebody_else_who_asks_too_much_is_told_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(5.0, 0.0))
    scene.station.on_gone(scene.anna)
    scene.clients.remove(scene.anna)
    scene.drive(Twist.planar(6.0, 0.0), scene.client("bert"))
    assert len(scene.events("command")) == 2


def test_what_a_configuration_allows_counts(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path, config=Config(limits=LimitSettings(max_speed=0.2)))
    scene.run(4.0)
    scene.drive(Twist.planar(0.6, 0.0))
    assert scene.events("command")[-1].endswith("goes at most 0.2 m/s; 0.6 m/s was requested.")
    scene.station.close()


def test_a_slow_link_slows_without_a_word(scene: Scene) -> None:
    scene.anna.rtt = 2.0
    scene.drive(Twist.planar(0.7, 1.9))
    assert scene.robot.twist.linear.x < 0.2
    assert scene.events("command") == []


def test_what_is_not_obeyed_is_not_cut(scene: Scene) -> None:
    scene.ask("/stop")
    scene.drive(Twist.planar(5.0, 0.0))
    assert not any("at most" in text for text in scene.events("command"))
