"""Behaviours ticked by hand against a robot that moves exactly as told."""

from __future__ import annotations

import math
import random
from itertools import pairwise

import numpy as np
import pytest
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.navigation.navigator import Goal
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import DriveTo
from robotside.tasks.behaviours.dwell import Dwell
from robotside.tasks.behaviours.patrol import patrol_course, patrol_route, single
from robotside.tasks.behaviours.situation import Seen, Situation
from tests.fakes import Box
from tests.robotside.tasks.behaviours.stage import Stage

POINTS = [Waypoint(2.0, 0.0), Waypoint(2.0, 2.0), Waypoint(-1.0, 2.0)]


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
    drive = DriveTo(course, stage.navigator, stage.situation)
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
    drive = DriveTo(course, stage.navigator, stage.situation)
    stage.tick(drive)
    assert drive.feedback_message == "Heading for point 4 of 4, 9 m to go."
    stage.tick(drive, 60.0)
    assert drive.feedback_message == "Point 4 of 4 reached."


def test_home_is_driven_to_and_turned_to() -> None:
    stage = Stage()
    course, tree = single("Home", Waypoint(2.0, 1.0, math.pi), stage.navigator, stage.situation)
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
    assert course.progress(math.nan) == pytest.approx(1 / 8), "it has come no less far where it has no way"
    course.reached()
    assert course.time_left(math.nan, 0.5) == course.time_left(0.0, 0.5), "it stands at the point"
    course.advance()
    assert course.progress(math.nan) == pytest.approx(1 / 4)
    assert course.time_left(10.0, 0.5) == pytest.approx((10.0 + 20.0) / 0.4)
    assert math.isnan(course.time_left(math.nan, 0.5))
    assert np.isfinite(course.progress(0.0))


def test_new_points_count_from_the_next_choice_on_and_it_is_said() -> None:
    stage = Stage()
    course, tree = stage.patrol(Mission(waypoints=POINTS))
    while course.visited < 1:
        stage.tick(tree)
    course.edit(patrol_route(Mission(waypoints=[POINTS[0], Waypoint(0.0, -2.0), POINTS[1]], laps=1)))
    assert course.count == 3
    assert course.goal.x == POINTS[0].x
    assert stage.tick(tree, 60.0) is Status.SUCCESS
    assert stage.said[1] == "The patrol goes on with the new mission of 3 points."
    assert stage.said[2:] == ["Point 2 of 3 reached.", "Point 3 of 3 reached."]


def test_a_point_taken_out_while_the_patrol_stands_at_it_gives_way_to_the_one_in_its_place() -> None:
    course = patrol_course(Mission(waypoints=POINTS), random.Random(1))
    course.advance()
    course.reached()
    course.advance()
    course.reached()
    course.edit(patrol_route(Mission(waypoints=[POINTS[0], POINTS[2]])))
    assert course.take_over()
    assert (course.advance().x, course.lap) == (POINTS[2].x, 1)
    assert not course.take_over()


def test_fewer_laps_than_were_made_end_the_patrol() -> None:
    course = Course([Goal("a", 0.0, 0.0), Goal("b", 1.0, 0.0)], laps=0)
    for _ in range(4):
        course.advance()
        course.reached()
    assert not course.finished
    course.edit(patrol_route(Mission(waypoints=POINTS, laps=2)))
    course.take_over()
    assert course.finished


def test_a_patrol_that_is_taken_up_again_heads_for_the_point_that_it_headed_for() -> None:
    before = patrol_course(Mission(waypoints=POINTS, laps=2), random.Random(1))
    before.advance()
    before.reached()
    before.advance()
    after = patrol_course(Mission(waypoints=POINTS, laps=2), random.Random(1))
    after.take_up(before.noted())
    assert (after.advance().x, after.visited, after.lap) == (POINTS[1].x, 1, 1)
    fewer = patrol_course(Mission(waypoints=POINTS[:1]), random.Random(1))
    fewer.take_up(before.noted())
    assert fewer.advance().x == POINTS[0].x


def test_an_intruder_is_gone_round_once_from_every_side_and_the_patrol_goes_on() -> None:
    stage = Stage()
    course, tree = stage.patrol(Mission(waypoints=[Waypoint(6.0, 0.0)], laps=1))
    stage.tick(tree, 1.0)
    stage.situation.intruders.append(Seen(3, 4.0, 0.5))
    nearest, sides = math.inf, set()
    while stage.tick(tree) is Status.RUNNING:
        x, y, _ = stage.robot.pose
        if stage.phase == "circling":
            nearest = min(nearest, math.hypot(x - 4.0, y - 0.5))
            sides.add(round(math.atan2(y - 0.5, x - 4.0) / (math.pi / 3)))
            assert stage.situation.doing.text == "Going round intruder 3 and looking at it."
    assert nearest > 1.0
    assert len(sides) >= 6
    assert stage.said == ["Intruder 3 was seen from all 6 sides; going on.", "Point 1 of 1 reached."]
    assert course.visited == 1


def test_sides_of_an_intruder_that_cannot_be_reached_are_left_out_and_counted() -> None:
    stage = Stage()
    _, tree = stage.patrol(Mission(waypoints=[Waypoint(6.0, 4.0)], laps=1))
    stage.situation.intruders.append(Seen(1, 4.0, 5.4))
    assert stage.tick(tree, 200.0) is Status.SUCCESS
    assert stage.said[0] == "Intruder 1 was seen from 4 of 6 sides; not: north-east, north-west."


def test_there_may_be_no_room_to_go_round_an_intruder() -> None:
    stage = Stage()
    stage.fault = lambda x, y: "outside the fence"
    _, tree = stage.patrol(Mission(waypoints=[Waypoint(2.0, 0.0)], laps=1))
    stage.situation.intruders.append(Seen(1, 4.0, 0.0))
    assert stage.tick(tree, 60.0) is Status.SUCCESS
    assert stage.said[0] == "There is no room to go round intruder 1; going on."
