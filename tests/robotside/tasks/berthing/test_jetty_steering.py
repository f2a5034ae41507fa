"""Steering before a jetty, against where a push leads."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.tasks.berthing.jetty_steering import MAX_ASTERN, MAX_STREAM, JettySteering

AT = Pose2(-2.0, 0.0, 0.0)


def line(steering: JettySteering, off: float, moving: Pose2, now: float = 0.0, most: float = 0.5) -> float:
    return steering.line(AT, off, moving, 0.3, most=most, way=0.2, now=now).yaw


@pytest.mark.parametrize(("off", "way"), [(0.3, -1.0), (-0.3, 1.0)])
def test_off_the_line_it_looks_back_to_it_and_no_farther_than_it_may(off: float, way: float) -> None:
    assert way * line(JettySteering(), off, Pose2(0.3, 0.0, 0.0)) > 0.2
    assert line(JettySteering(), 5.0 * off, Pose2(0.3, 0.0, 0.0), most=0.3) == way * 0.3


def test_what_carries_it_aside_is_learnt_and_looked_into() -> None:
    steering, yaw = JettySteering(), 0.0
    for tick in range(600):
        yaw = line(steering, 0.0, Pose2(0.3, 0.04, 0.0), tick * 0.05)
    assert 0.3 * math.sin(yaw) == pytest.approx(-0.04, abs=0.005)


def test_while_it_turns_or_looks_far_aside_what_it_slides_is_no_stream() -> None:
    for robot, turning in ((AT, 0.3), (Pose2(-2.0, 0.0, 1.0), 0.0)):
        steering = JettySteering()
        for tick in range(200):
            steering.line(robot, 0.0, Pose2(0.3, 0.1, turning), 0.3, most=0.5, way=0.2, now=tick * 0.05)
        assert line(steering, 0.0, Pose2(0.3, 0.0, 1.0), 10.0) == 0.0


def test_carried_ahead_it_pushes_less_but_keeps_way_to_steer() -> None:
    steering, speed, over_ground = JettySteering(), 0.3, 0.3
    for tick in range(600):
        over_ground += 0.2 * (speed + 0.08 - over_ground)
        moving = Pose2(over_ground, 0.0, 0.0)
        speed = steering.line(AT, 0.0, moving, 0.3, most=0.5, way=0.1, now=tick * 0.05).speed
    assert speed == pytest.approx(0.22, abs=0.01)
    assert steering.line(AT, 0.0, Pose2(0.3, 0.0, 0.0), 0.1, most=0.5, way=0.2, now=30.0).speed > 0.15


def test_a_surge_that_is_not_wanted_is_pushed_against_along_its_own_axis() -> None:
    steering = JettySteering()
    assert steering.straight(AT, Pose2(0.15, 0.0, 0.0), 0.06, 0.0) == pytest.approx(-0.03)
    askew = Pose2(-2.0, 0.0, math.pi)
    assert steering.straight(askew, Pose2(-0.06, 0.0, 0.0), 0.06, 0.0) == pytest.approx(0.06)
    assert steering.straight(AT, Pose2(2.0, 0.0, 0.0), 0.06, 0.0) == -MAX_ASTERN


def test_held_fast_it_pushes_no_harder_than_any_stream_asks_for_and_leaning_learns_nothing() -> None:
    steering, speed = JettySteering(), 0.0
    for tick in range(4000):
        speed = steering.straight(AT, ORIGIN, 0.06, tick * 0.05)
    assert speed <= 0.06 + MAX_STREAM + 0.06 + 1e-9
    fresh = JettySteering()
    for tick in range(400):
        fresh.lie()
        fresh._learn(AT, Pose2(-0.3, 0.0, 0.0), tick * 0.05)
    assert fresh.straight(AT, Pose2(0.06, 0.0, 0.0), 0.06, 20.0) == pytest.approx(0.06)


def test_left_alone_it_learns_nothing_from_what_happened_meanwhile() -> None:
    steering = JettySteering()
    steering.straight(AT, Pose2(0.06, 0.0, 0.0), 0.06, 0.0)
    assert steering.straight(AT, Pose2(0.06, 0.5, 0.0), 0.06, 20.0) == pytest.approx(0.06)
    assert line(steering, 0.0, Pose2(0.3, 0.0, 1.0), 20.1) == 0.0
