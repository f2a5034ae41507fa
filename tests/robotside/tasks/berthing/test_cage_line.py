"""The line of a cage, against where the robot and the cage are."""

from __future__ import annotations

import math

import pytest

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.tasks.berthing.cage_line import LEAN, CageLine
from tests.robotside.tasks.berthing.water import CAGE, FRONT, TICK, Water


def line_of(on: Water, looks: int) -> CageLine:
    line = CageLine(CAGE, on, on.situation, on.look, FRONT)  # type: ignore[arg-type]  # what it calls of a navigator
    line.height = CAGE.height
    for _ in range(looks):
        on.situation.now += TICK
        on.situation.pose = on.situation.odom = on.believed
        on.situation.ahead = on.view
        line.look()
    return line


def test_before_it_is_seen_the_cage_is_where_the_map_has_it() -> None:
    robot, gap = line_of(Water(Pose2(0.2, 0.3, 0.0), Pose2(-2.0, 0.0, 0.0)), 1).where()
    assert gap == pytest.approx(1.8, abs=0.01)
    assert robot.y == pytest.approx(0.3, abs=0.01)


def test_seen_it_is_where_it_is_and_as_deep_as_it_is() -> None:
    line = line_of(Water(Pose2(0.2, 0.3, 0.1), Pose2(-2.0, 0.1, 0.2), deeper=0.2), 60)
    robot, gap = line.where()
    assert gap == pytest.approx(2.0, abs=0.02)
    assert robot.y == pytest.approx(0.1, abs=0.12)  # the map's direction is believed in part
    assert line.wanted == pytest.approx(CAGE.height - 0.2, abs=0.01)


def test_its_speed_is_told_along_and_aside_of_the_cage() -> None:
    on = Water(ORIGIN, Pose2(-2.0, 0.0, math.pi / 2))
    line = line_of(on, 1)
    on.situation.moving = Pose2(0.1, 0.0, 0.0)
    assert line.moving() == pytest.approx((0.0, 0.1), abs=0.01)


def test_its_orders_keep_within_the_depths_that_are_allowed() -> None:
    on = Water()
    line = line_of(on, 1)
    line.keep(2.0, -9.0)
    assert on.orders[-1].height == on.heights[0]


def test_at_the_coil_it_leans_and_before_it_it_goes_there() -> None:
    on = Water(start=Pose2(0.0, 0.0, 0.0))
    line_of(on, 1).press()
    assert on.orders[-1].speed == LEAN
    on = Water(start=Pose2(-0.2, 0.0, 0.0))
    line = line_of(on, 1)
    on.situation.moving = Pose2(0.2, 0.0, 0.0)
    line.press()
    assert on.orders[-1].kind == "course"
