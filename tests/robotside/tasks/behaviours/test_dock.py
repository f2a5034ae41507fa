"""Docking, ticked by hand."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Place
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.dock import CHARGE_TIMEOUT, MAX_BEYOND, Dock, before
from tests.fakes import Box
from tests.robotside.tasks.behaviours.stage import Stage

DOCK = Place(1, "Dock", "dock", x=3.0, y=1.0, yaw=math.pi / 2)


def make(stage: Stage) -> Dock:
    return Dock(DOCK, Course([before(DOCK)]), stage.navigator, stage.situation)


def until(stage: Stage, tree: Dock, phase: str) -> None:
    end = stage.situation.now + 60.0
    while stage.phase != phase and stage.situation.now < end:
        assert stage.tick(tree) is Status.RUNNING
    assert stage.phase == phase


def test_it_drives_before_the_dock_turns_to_it_and_creeps_until_the_charge_is_seen() -> None:
    stage = Stage()
    tree = make(stage)
    until(stage, tree, "driving")
    until(stage, tree, "turning")
    assert stage.robot.pose[:2] == pytest.approx((3.0, 0.2), abs=0.25)
    until(stage, tree, "docking")
    assert stage.robot.pose[2] == pytest.approx(math.pi / 2, abs=0.1)
    stage.tick(tree, 5.0)
    assert stage.robot.twist.linear.x == pytest.approx(0.08)
    stage.situation.charging = True
    assert stage.tick(tree) is Status.SUCCESS
    assert stage.robot.at_rest


def test_without_a_charge_in_time_it_stands_and_says_so() -> None:
    stage = Stage()
    tree = make(stage)
    until(stage, tree, "docking")
    began = stage.situation.now
    assert stage.tick(tree, 60.0) is Status.FAILURE
    assert stage.situation.now - began == pytest.approx(CHARGE_TIMEOUT, abs=0.2)
    assert stage.navigator.reason == "No charge at Dock within 20 s; the robot stands there."
    assert stage.robot.at_rest
    assert stage.robot.pose[1] < DOCK.y + MAX_BEYOND + 0.05


def test_what_it_touches_while_it_creeps_is_the_dock_and_it_pushes_no_further() -> None:
    stage = Stage()
    tree = make(stage)
    until(stage, tree, "docking")
    stage.tick(tree, 2.0)
    stage.situation.touched = True
    stage.tick(tree, 0.1)
    assert stage.robot.at_rest
    assert stage.situation.doing.text == "Waiting for the charge at Dock."


def test_who_was_moved_away_while_it_was_paused_begins_anew() -> None:
    stage = Stage()
    tree = make(stage)
    until(stage, tree, "docking")
    stage.pause(30.0)
    stage.robot.pose = (0.0, 0.0, 0.0)
    until(stage, tree, "driving")
    until(stage, tree, "docking")


def test_a_pause_does_not_count_as_waiting_for_the_charge() -> None:
    stage = Stage()
    tree = make(stage)
    until(stage, tree, "docking")
    stage.pause(CHARGE_TIMEOUT + 5.0)
    assert stage.tick(tree, 1.0) is Status.RUNNING


def test_who_is_charging_at_the_dock_stays_there() -> None:
    stage = Stage()
    stage.robot.pose = (DOCK.x, DOCK.y, DOCK.yaw)
    stage.situation.charging = True
    assert stage.tick(make(stage)) is Status.SUCCESS


def test_a_dock_without_a_way_to_it_fails() -> None:
    stage = Stage(Box(1.0, -6.0, 1.3, 6.0))
    assert stage.tick(make(stage), 5.0) is Status.FAILURE
    assert stage.navigator.reason.startswith("There is no way to Dock at (3.0, 0.2)")
