"""Behaviours ticked by hand against a robot that moves exactly as told."""

from __future__ import annotations

import math
import random
from itertools import pairwise

import numpy as np
import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.behaviours.course import Course
from robotside.behaviours.drive_to import DriveTo
from robotside.behaviours.dwell import Dwell
from robotside.behaviours.patrol import patrol, patrol_course, single
from robotside.behaviours.situation import Situation
from robotside.grid import Grid
from robotside.guide import Goal, Guide
from robotside.pose2 import Pose2
from tests.fakes import Box, FakeRobot

POINTS = [Waypoint(2.0, 0.0), Waypoint(2.0, 2.0), Waypoint(-1.0, 2.0)]


class Stage:
    def __init__(self, *boxes: Box) -> None:
        self.robot = FakeRobot(boxes=boxes)
        self.situation = Situation()
        self.guide = Guide(self.robot, Grid.from_msg(self.robot.map()), lambda _: None)
        self.said: list[str] = []
        list(self.robot.read(0.0))

    def say(
        self, kind: str, text: str, level: str = "info", *, at: tuple[float, float] | None = None
    ) -> None:
        self.said.append(text)

    def patrol(self, mission: Mission) -> tuple[Course, Behaviour]:
        course = patrol_course(mission, random.Random(3))
        return course, patrol(course, self.guide, self.situation, self.say)

    def tick(self, tree: Behaviour, seconds: float = 0.05) -> Status:
        for _ in range(round(seconds / 0.05)):
            self.situation.pose = Pose2(*self.robot.pose)
            tree.tick_once()
            self.situation.now += 0.05
            list(self.robot.read(self.situation.now))
            if tree.status is not Status.RUNNING:
                break
        return tree.status


def test_a_patrol_of_two_laps_visits_every_point_twice_and_succeeds_at_rest() -> None:
    stage = Stage()
    course, tree = stage.patrol(Mission(waypoints=POINTS, laps=2))
    assert stage.tick(tree, 200.0) is Status.SUCCESS
    assert (course.visited, course.lap) == (6, 2)
    assert stage.said == [f"Point {n} of 3 reached." for n in (1, 2, 3, 1, 2, 3)]
    assert stage.robot.at_rest


def test_a_patrol_without_laps_goes_on_until_it_is_stopped_and_then_rests() -> None:
    stage = Stage()
    course, tree = stage.patrol(Mission(waypoints=POINTS))
    assert stage.tick(tree, 90.0) is Status.RUNNING
    assert course.lap > 2
    tree.stop(Status.INVALID)
    assert stage.robot.at_rest


def test_intermittent_motion_stands_at_each_point() -> None:
    stage = Stage()
    _, tree = stage.patrol(Mission(waypoints=POINTS[:2], motion="intermittent", dwell=4.0, laps=1))
    while not stage.said:
        stage.tick(tree)
    began, place = stage.situation.now, stage.robot.pose
    stage.tick(tree, 3.8)
    assert stage.robot.pose == place
    stage.tick(tree, 2.0)
    assert stage.robot.pose != place
    assert stage.situation.now - began == pytest.approx(5.8)


def test_a_single_point_is_visited_once_where_laps_are_not_counted() -> None:
    stage = Stage()
    _, tree = stage.patrol(Mission(waypoints=POINTS[:1]))
    assert stage.tick(tree, 60.0) is Status.SUCCESS


def test_random_motion_visits_all_and_never_the_same_twice_in_a_row() -> None:
    course = Course(
        [Goal(str(n), float(n), 0.0) for n in range(4)], motion="random", laps=0, rng=random.Random(1)
    )
    order = [course.advance().name for _ in range(200)]
    assert all(a != b for a, b in pairwise(order))
    assert set(order) == {"0", "1", "2", "3"}


def test_a_point_that_cannot_be_reached_is_skipped_and_said() -> None:
    stage = Stage(Box(1.0, -6.0, 1.3, 6.0))
    mission = Mission(waypoints=[Waypoint(-2.0, 0.0), Waypoint(4.0, 0.0)], laps=1)
    course, tree = stage.patrol(mission)
    assert stage.tick(tree, 60.0) is Status.SUCCESS
    assert course.visited == 1
    assert stage.said[-1].startswith("Point 2 of 2 is skipped, going on to the next: There is no way to")


def test_a_patrol_of_which_nothing_can_be_reached_fails_at_rest() -> None:
    stage = Stage(Box(1.0, -6.0, 1.3, 6.0))
    _, tree = stage.patrol(Mission(waypoints=[Waypoint(4.0, 0.0), Waypoint(5.0, 0.0)]))
    assert stage.tick(tree, 10.0) is Status.FAILURE
    assert stage.robot.at_rest
    assert len(stage.said) == 2


@pytest.mark.parametrize("end", ["success", "failure", "interruption"])
def test_driving_rests_at_every_ending(end: str) -> None:
    stage = Stage(Box(1.0, -6.0, 1.3, 6.0))
    course = Course([Goal("Point 1", 4.0 if end == "failure" else -2.0, 0.0)])
    drive = DriveTo(course, stage.guide, stage.situation)
    stage.tick(drive, 1.0)
    if end == "interruption":
        assert not stage.robot.at_rest
        drive.stop(Status.INVALID)
    else:
        stage.tick(drive, 60.0)
        assert drive.status is (Status.SUCCESS if end == "success" else Status.FAILURE)
    assert stage.robot.at_rest
    assert stage.robot.commands[-1] is None


def test_the_feedback_says_how_far_it_is_and_then_that_it_arrived() -> None:
    stage = Stage()
    course = patrol_course(Mission(waypoints=[*POINTS, Waypoint(9.0, 0.0)]), random.Random(1))
    course.index = 3
    drive = DriveTo(course, stage.guide, stage.situation)
    stage.tick(drive)
    assert drive.feedback_message == "Heading for point 4 of 4, 9 m to go."
    stage.tick(drive, 60.0)
    assert drive.feedback_message == "Point 4 of 4 reached."


def test_home_is_driven_to_and_turned_to() -> None:
    stage = Stage()
    course, tree = single("Home", Waypoint(2.0, 1.0, math.pi), stage.guide, stage.situation)
    assert stage.tick(tree, 60.0) is Status.SUCCESS
    assert course.visited == 1
    assert abs(math.remainder(stage.robot.pose[2] - math.pi, math.tau)) < 0.1


def test_dwelling_lasts_as_long_as_told_and_says_how_long_still() -> None:
    situation = Situation(now=10.0)
    dwell = Dwell(2.0, situation)
    dwell.tick_once()
    assert (dwell.status, dwell.feedback_message) == (Status.RUNNING, "Standing for another 2 s.")
    situation.now = 12.0
    dwell.tick_once()
    assert dwell.status is Status.SUCCESS


def test_progress_counts_the_points_and_the_part_of_the_leg() -> None:
    course = Course([Goal("a", 0.0, 0.0), Goal("b", 10.0, 0.0)], laps=2)
    course.advance()
    assert course.progress(8.0) == 0.0
    assert course.progress(4.0) == pytest.approx(1 / 8)
    course.reached()
    course.advance()
    assert course.progress(math.nan) == pytest.approx(1 / 4)
    assert course.time_left(10.0, 0.5) == pytest.approx((10.0 + 20.0) / 0.4)
    assert math.isnan(course.time_left(math.nan, 0.5))
    assert np.isfinite(course.progress(0.0))
