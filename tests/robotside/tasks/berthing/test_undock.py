"""Leaving a dock, ticked by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Place
from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.pose2 import Pose2
from robotside.tasks.berthing.approach import Approach
from robotside.tasks.berthing.undock import Undock
from tests.fakes import FakeDock, FakeRobot, Pillar
from tests.robotside.tasks.behaviours.stage import Stage

DOCK = Place(1, "Dock", "dock", x=4.0, y=1.0, yaw=0.0)


def stage(*, gives: int = 1) -> Stage:
    dock = FakeDock(4.18, 1.0, 0.0, gives=gives)
    on = Stage(robot=FakeRobot(start=(4.0, 1.0, 0.0), beams=360, dock=dock))
    on.tick(make(on), 0.0)
    on.situation.last_power = gives
    on._hear()
    return on


def make(on: Stage) -> Undock:
    return Undock(lambda: [DOCK], on.navigator, on.situation, Approach.of(on.robot.info))


@pytest.mark.parametrize("gives", [1, 3, 4])
def test_it_backs_out_of_the_dock_slowly_and_straight(gives: int) -> None:
    on = stage(gives=gives)
    tree, speeds = make(on), []
    while on.tick(tree) is Status.RUNNING:
        speeds.append(on.robot.twist.linear.x)
        assert on.phase == "undocking"
    assert tree.status is Status.SUCCESS
    assert on.robot.pose == pytest.approx((3.3, 1.0, 0.0), abs=0.03)
    assert min(speeds) == pytest.approx(-0.12)
    assert on.robot.at_rest
    assert tree.dock == "Dock"


@pytest.mark.parametrize("guided", [0.1, 0.5])
def test_only_where_the_dock_guides_it_a_touch_is_meant(guided: float) -> None:
    on = stage()
    way = replace(Approach.of(on.robot.info), guided=guided)
    tree = Undock(lambda: [DOCK], on.navigator, on.situation, way)
    while on.tick(tree) is Status.RUNNING:
        gone = 4.0 - on.robot.pose[0]
        assert on.situation.touches or gone > guided - 0.03
        assert not on.situation.touches or gone < guided + 0.03


def test_a_robot_in_no_dock_does_not_move() -> None:
    on = stage()
    on.situation.last_power = BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
    on.robot.dock = None
    assert on.tick(make(on)) is Status.SUCCESS
    assert on.robot.pose == (4.0, 1.0, 0.0)


def test_a_robot_that_charges_by_a_cable_elsewhere_does_not_move() -> None:
    on = stage()
    on.robot.pose = (-2.0, 1.0, 0.0)
    on.robot.dock, on.situation.last_power = None, 1
    assert on.tick(make(on)) is Status.SUCCESS
    assert on.robot.pose == (-2.0, 1.0, 0.0)


def test_what_no_cable_can_charge_leaves_its_dock_though_it_believes_to_be_elsewhere() -> None:
    on = stage()
    on.situation.pose = Pose2(-2.0, 1.0, 0.0)
    tree = Undock(lambda: [DOCK], on.navigator, on.situation, Approach.of(on.robot.info), math.inf)
    tree.initialise()
    assert tree.dock == "Dock"


def test_it_does_not_back_into_who_stands_behind_and_goes_on_when_they_are_gone() -> None:
    on = stage()
    on.robot.pillars.append(Pillar(3.5, 1.0, 0.1))
    tree = make(on)
    on.tick(tree, 8.0)
    assert on.robot.at_rest
    assert on.situation.doing.text == "Waiting: something stands behind at Dock."
    assert on.robot.room() > -0.01
    on.robot.pillars.clear()
    while on.tick(tree) is Status.RUNNING:
        pass
    assert tree.status is Status.SUCCESS


def test_who_stays_behind_it_ends_the_try() -> None:
    on = stage()
    on.robot.pillars.append(Pillar(3.5, 1.0, 0.1))
    tree = make(on)
    assert on.tick(tree, 40.0) is Status.FAILURE
    assert on.navigator.reason == "Dock cannot be left: something stands behind."
    assert on.robot.at_rest


def test_a_robot_that_is_held_fast_says_so() -> None:
    on = stage()
    tree = make(on)
    on.tick(tree)
    for _ in range(20 * 70):
        on.robot.pose = (4.0, 1.0, 0.0)
        on.robot._odom = (0.0, 0.0, 0.0)
        if on.tick(tree) is not Status.RUNNING:
            break
    assert tree.status is Status.FAILURE
    assert on.navigator.reason == "Dock cannot be left: the robot does not move."
