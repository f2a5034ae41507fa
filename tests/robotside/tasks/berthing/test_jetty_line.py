"""The line of a jetty, against where the boat and the jetty are."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.tasks.berthing.jetty_line import LEAN, JettyLine
from tests.robotside.tasks.berthing.harbour import FRONT, JETTY, TICK, Harbour


def line_of(on: Harbour, looks: int) -> JettyLine:
    line = JettyLine(JETTY, on, on.situation, on.look, FRONT)  # type: ignore[arg-type]  # what it calls of a navigator
    for _ in range(looks):
        on.situation.now += TICK
        on._measure()
        line.look()
    return line


def told(on: Harbour) -> Manoeuvre:
    order = on.orders[-1]
    assert isinstance(order, Manoeuvre)
    return order


def test_before_it_is_seen_the_jetty_is_where_the_map_has_it() -> None:
    robot, gap = line_of(Harbour(Pose2(0.2, 0.3, 0.0), Pose2(-3.0, 0.0, 0.0)), 1).where()
    assert gap == pytest.approx(2.8, abs=0.01)
    assert robot.y == pytest.approx(0.3, abs=0.01)


def test_seen_it_is_where_it_is_and_so_is_the_place_to_lie() -> None:
    on = Harbour(Pose2(0.2, 0.3, 0.15), Pose2(-1.0, 0.1, 0.2))
    line = line_of(on, 100)
    robot, gap = line.where()
    assert gap == pytest.approx(1.0, abs=0.03)
    assert robot.y == pytest.approx(0.1, abs=0.08)
    assert line.aside() == pytest.approx(0.1 + FRONT * math.sin(0.2), abs=0.08)
    assert line.docked() == pytest.approx(on.jetty, abs=0.05)


def test_what_is_turned_far_from_what_the_map_says_is_none_of_it() -> None:
    for turned, seen in ((0.4, True), (0.6, False)):
        line = line_of(Harbour(Pose2(0.0, 0.0, turned), Pose2(-1.0, 0.0, 0.0)), 20)
        assert line.sight.known is seen


def test_its_speed_is_told_along_and_aside_of_the_jetty() -> None:
    on = Harbour(ORIGIN, Pose2(-3.0, 0.0, math.pi / 2))
    line = line_of(on, 1)
    on.situation.moving = Pose2(0.1, 0.0, 0.2)
    assert line.moving() == pytest.approx((0.0, 0.1, 0.2), abs=0.01)


def test_the_nearer_it_is_the_less_it_looks_aside() -> None:
    turns = []
    for away in (6.0, 1.0):
        on = Harbour(ORIGIN, Pose2(-away, 1.0, 0.0))
        line_of(on, 1).go(0.3, 0.2)
        turns.append(abs(told(on).yaw - JETTY.yaw))
    assert turns[0] > turns[1] > 0.2
    assert turns[1] < 0.45


def test_astern_it_turns_back_to_the_line_once_it_goes_astern() -> None:
    on = Harbour(ORIGIN, Pose2(-3.0, 0.0, 0.3))
    line = line_of(on, 1)
    for ahead, turns in ((0.1, False), (-0.2, True)):
        on.situation.moving = Pose2(ahead, 0.0, 0.0)
        line.back(0.5)
        order = on.orders[-1]
        assert isinstance(order, Twist)
        assert order.linear.x == -0.5
        assert (order.angular.z < -0.05) is turns


def test_at_the_jetty_it_leans_with_the_rudder_amidships_and_brakes_what_comes_too_fast() -> None:
    on = Harbour(start=Pose2(0.0, 0.0, 0.0))
    line = line_of(on, 1)
    for ahead, speed in ((0.0, LEAN), (0.2, LEAN - 0.2)):
        on.situation.moving = Pose2(ahead, 0.0, 0.0)
        line.lean()
        assert (told(on).kind, told(on).steering) == ("steer", 0.0)
        assert told(on).speed == pytest.approx(speed)
