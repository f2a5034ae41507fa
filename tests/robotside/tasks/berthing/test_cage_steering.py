"""Steering before a cage, against where a push leads."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import Pose2
from robotside.tasks.berthing.cage_steering import MAX_LOOK, MAX_STREAM, CageSteering

STANDS = (0.0, 0.0)


def test_one_that_slides_past_the_point_turns_towards_its_slide_and_brakes() -> None:
    steering = CageSteering()
    push = steering.keep(Pose2(-2.0, 0.0, 0.0), (0.0, -0.1), (-2.0, 0.0), 0.0, 0.0)
    assert abs(push.yaw) == MAX_LOOK
    assert push.speed == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize(("x", "way"), [(-2.3, 1.0), (-1.7, -1.0)])
def test_to_come_aside_it_goes_ahead_where_it_is_far_and_astern_where_it_is_near(
    x: float, way: float
) -> None:
    robot = Pose2(x, 0.4, 0.0)
    steering = CageSteering()
    yaw = steering.keep(robot, STANDS, (-2.0, 0.0), 0.0, 0.0).yaw
    push = steering.keep(robot._replace(yaw=yaw), STANDS, (-2.0, 0.0), 0.0, 0.1)
    assert way * push.speed > 0.03
    assert push.speed * math.sin(yaw) < -0.02


def test_turned_away_from_where_it_is_to_push_it_waits() -> None:
    assert CageSteering().keep(Pose2(-2.0, 0.5, 0.0), STANDS, (-2.0, 0.0), 0.0, 0.0).speed == 0.0


def test_who_comes_too_near_goes_back_and_too_far_ahead() -> None:
    for x, way in ((-1.2, -1.0), (-2.8, 1.0)):
        push = CageSteering().keep(Pose2(x, 0.0, 0.0), STANDS, (-2.0, 0.0), 0.0, 0.0)
        assert way * push.speed > 0.05
        assert push.yaw == pytest.approx(0.0, abs=1e-9)


def test_at_rest_at_the_point_it_looks_where_it_is_told() -> None:
    assert CageSteering().keep(Pose2(-2.0, 0.03, 0.0), STANDS, (-2.0, 0.0), 0.4, 0.0) == (0.4, 0.0)


@pytest.mark.parametrize("ahead", [0.2, -0.2])
def test_off_the_line_it_looks_so_that_its_push_leads_back_to_it(ahead: float) -> None:
    push = CageSteering().line(Pose2(-1.5, 0.3, 0.0), (ahead, 0.0), ahead, 0.35, 0.0)
    assert push.speed * math.sin(push.yaw) < -0.02
    assert abs(push.yaw) <= 0.35


def test_a_slide_along_the_line_is_pushed_against_before_it_leaves_it() -> None:
    assert CageSteering().line(Pose2(-1.5, 0.0, 0.0), (0.2, 0.05), 0.2, 0.35, 0.0).yaw < -0.2


def test_what_the_stream_does_is_learnt_and_taken_off() -> None:
    steering, speed = CageSteering(), 0.2
    for tick in range(600):
        speed = steering.line(Pose2(-1.5, 0.0, 0.0), (speed + 0.06, 0.0), 0.2, 0.3, tick * 0.05).speed
    assert speed == pytest.approx(0.14, abs=0.01)


def test_held_fast_it_pushes_no_harder_than_any_stream_asks_for() -> None:
    steering, speed = CageSteering(), 0.0
    for tick in range(4000):
        speed = steering.line(Pose2(-1.5, 0.0, 0.0), STANDS, 0.1, 0.3, tick * 0.05).speed
    assert speed == pytest.approx(0.1 + MAX_STREAM)
    assert steering.lean(0.05) == (0.0, 0.05)


def test_left_alone_it_learns_nothing_from_what_happened_meanwhile() -> None:
    steering = CageSteering()
    steering.line(Pose2(-1.5, 0.0, 0.0), STANDS, 0.1, 0.3, 0.0)
    assert steering.line(Pose2(-1.5, 0.0, 0.0), (-0.5, 0.0), 0.1, 0.3, 20.0).speed == pytest.approx(0.1)
