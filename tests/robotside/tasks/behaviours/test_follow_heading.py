"""Going straight on, ticked by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from py_trees.common import Status

from robotside.core.pose2 import Pose2
from robotside.tasks.behaviours.course import Span
from robotside.tasks.behaviours.follow_heading import BLOCKED_TIMEOUT, FollowHeading
from tests.fakes import Pillar
from tests.robotside.tasks.behaviours.stage import Stage


def make(stage: Stage, heading: float, speed: float = math.nan, duration: float = math.nan) -> FollowHeading:
    span = Span(duration, lambda: stage.situation.worked)
    return FollowHeading(heading, speed, span, stage.navigator, stage.situation)


def test_it_turns_and_goes_at_the_speed_asked_for_until_the_time_is_over() -> None:
    stage = Stage()
    tree = make(stage, math.pi / 2, 0.2, 12.0)
    stage.tick(tree)
    assert stage.phase == "turning"
    assert stage.situation.doing.text == "Turning to 000°."
    assert stage.tick(tree, 20.0) is Status.SUCCESS
    x, y, yaw = stage.robot.pose
    assert abs(x) < 0.25
    assert 1.6 < y < 2.4
    assert yaw == pytest.approx(math.pi / 2, abs=0.05)
    assert max(twist.linear.x for twist in stage.robot.commands if twist) == pytest.approx(0.2)
    assert stage.robot.at_rest


def test_without_a_heading_it_goes_where_it_points_at_its_own_speed() -> None:
    stage = Stage()
    assert stage.tick(make(stage, math.nan, duration=3.0), 5.0) is Status.SUCCESS
    assert stage.robot.pose[0] == pytest.approx(3.0 * stage.navigator.cruise, abs=0.2)


def test_it_stops_before_a_wall_and_says_where() -> None:
    stage = Stage()
    tree = make(stage, 0.0)
    assert stage.tick(tree, 60.0) is Status.FAILURE
    x = stage.robot.pose[0]
    assert 9.2 < x < 10.0 - stage.robot.info.radius - 0.05
    assert stage.navigator.reason == (
        f"The way straight on ended at ({x:.1f}, 0.0) before a wall, the fence or the end of the map."
    )
    assert stage.robot.contacts == 0


@pytest.mark.parametrize("off", [-0.1, -0.05, 0.05])
def test_a_wall_of_the_map_that_the_laser_sees_a_little_nearer_ends_it_at_once(off: float) -> None:
    stage = Stage()
    stage.off = Pose2(off, 0.0, 0.0)
    assert stage.tick(make(stage, 0.0), 60.0) is Status.FAILURE
    assert stage.navigator.reason.endswith("before a wall, the fence or the end of the map.")
    assert stage.situation.now < 40.0  # it has not waited for the wall to go
    assert stage.robot.contacts == 0


def run(stage: Stage, tree: FollowHeading, seconds: float) -> Status:
    for _ in range(round(seconds / 0.05)):
        stage.situation.points = np.asarray(
            [[p.x - stage.robot.pose[0], p.y - stage.robot.pose[1]] for p in stage.robot.pillars]
        ).reshape(-1, 2)
        if stage.tick(tree) is not Status.RUNNING:
            break
    return tree.status


def test_it_waits_before_what_is_in_the_way_and_goes_on_when_that_is_gone() -> None:
    stage = Stage(pillars=(Pillar(3.0, 0.0),))
    tree = make(stage, 0.0)
    run(stage, tree, 12.0)
    assert stage.phase == "waiting"
    assert stage.robot.at_rest
    x = stage.robot.pose[0]
    assert 2.0 < x < 3.0 - stage.robot.info.radius
    stage.robot.pillars.clear()
    run(stage, tree, 2.0)
    assert stage.robot.pose[0] > x + 0.5


def test_it_fails_before_what_does_not_go_away() -> None:
    stage = Stage(pillars=(Pillar(3.0, 0.0),))
    tree = make(stage, 0.0)
    assert run(stage, tree, 12.0 + BLOCKED_TIMEOUT) is Status.FAILURE
    assert "before something that does not go away." in stage.navigator.reason
    assert stage.robot.contacts == 0


def test_after_a_pause_it_goes_on_at_the_same_heading() -> None:
    stage = Stage()
    tree = make(stage, math.nan, duration=4.0)
    stage.tick(tree, 2.0)
    stage.pause(30.0)
    stage.robot.pose = (*stage.robot.pose[:2], 0.3)
    assert stage.tick(tree, 3.0) is Status.SUCCESS
    assert stage.robot.pose[2] == pytest.approx(0.0, abs=0.1)


def test_an_interruption_leaves_it_at_rest() -> None:
    stage = Stage()
    tree = make(stage, 0.0)
    stage.tick(tree, 2.0)
    tree.stop(Status.INVALID)
    assert stage.robot.at_rest
