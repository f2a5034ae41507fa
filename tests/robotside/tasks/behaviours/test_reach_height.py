"""A point has a height: the robot is there when it is at it as well."""

from __future__ import annotations

import math
import re

import pytest
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Manoeuvre, Mission, Waypoint
from robotside.core.notice import Notice
from robotside.core.refusal import OrderRefused
from robotside.navigation.navigator import Goal
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import DriveTo
from robotside.tasks.behaviours.fly import RISE_TIMEOUT
from robotside.tasks.behaviours.patrol import patrol_route
from robotside.tasks.behaviours.reach_height import ReachHeight
from tests.robotside.tasks.behaviours.stage import Stage

OVER = Goal("Point 1", 0.0, 0.0)


class Lift(Stage):
    """A robot that rises as it is told, `rate` [m] a tick."""

    def __init__(self, height: float, rate: float = 0.1) -> None:
        super().__init__()
        self.rate, self.asked = rate, list[float]()
        self.navigator.measured(height)
        self.navigator.command = self._command  # type: ignore[method-assign]

    def _command(self, order: Manoeuvre) -> None:
        assert order.kind == "hover"
        self.asked.append(order.height)
        off = order.height - self.navigator.height
        self.navigator.measured(self.navigator.height + max(-self.rate, min(self.rate, off)))


def test_a_goal_with_a_height_is_gone_to_at_it_and_one_without_keeps_the_one_before() -> None:
    stage = Stage()
    stage.navigator.keep_height(1.0)
    for told, kept in ((math.nan, 1.0), (3.0, 3.0), (0.0, 3.0), (math.nan, 3.0), (-2.0, -2.0)):
        goal = Goal("The goal", 1.0, 1.0, height=told)
        ReachHeight(stage.navigator, stage.situation).begin(goal)
        assert stage.navigator.kept_height == kept


@pytest.mark.parametrize(("begins", "verb"), [(1.0, "Climbs"), (5.0, "Sinks")])
def test_over_the_point_it_goes_to_the_height_and_is_there_then(begins: float, verb: str) -> None:
    stage = Lift(begins)
    stage.navigator.keep_height(3.0)
    level = ReachHeight(stage.navigator, stage.situation)
    assert level.update(OVER) is Status.RUNNING
    assert stage.situation.doing.text == f"{verb} to 3 m at point 1."
    while level.update(OVER) is Status.RUNNING:
        stage.situation.now += 0.05
    assert level.update(OVER) is Status.SUCCESS
    assert abs(stage.navigator.height - 3.0) <= 0.25
    assert set(stage.asked) == {3.0}


def test_without_a_height_to_keep_or_one_that_is_measured_it_is_there_at_once() -> None:
    for measured, kept in ((1.0, math.nan), (math.nan, 3.0)):
        stage = Lift(measured)
        stage.navigator.keep_height(kept)
        assert ReachHeight(stage.navigator, stage.situation).update(OVER) is Status.SUCCESS
        assert stage.asked == []


def test_what_comes_no_nearer_gives_up_with_both_heights() -> None:
    stage = Lift(1.0, rate=0.0)
    stage.navigator.keep_height(3.0)
    level = ReachHeight(stage.navigator, stage.situation)
    level.begin(OVER)
    assert level.update(OVER) is Status.RUNNING
    stage.situation.now += RISE_TIMEOUT - 0.1
    assert level.update(OVER) is Status.RUNNING
    stage.situation.now += 0.2
    assert level.update(OVER) is Status.FAILURE
    why = stage.navigator.reason
    assert isinstance(why, Notice)
    assert why == "It comes no nearer to 3 m than 1.0 m; it stays there."
    assert why.code == Code.HEIGHT_UNREACHED


def test_a_drive_ends_at_the_height_of_its_point_and_not_before() -> None:
    stage = Lift(1.0, rate=0.02)
    course = Course([Goal("Point 1", 0.0, 0.0, height=2.0)])
    course.advance()
    tree = DriveTo(course, stage.navigator, stage.situation)
    assert stage.tick(tree, 1.0) is Status.RUNNING
    assert stage.situation.doing.text == "Climbs to 2 m at point 1."
    assert stage.tick(tree, 10.0) is Status.SUCCESS
    assert stage.navigator.height > 1.7


def test_the_heights_of_a_mission_are_those_of_its_goals() -> None:
    points = [Waypoint(1.0, 0.0, height=3.0), Waypoint(2.0, 0.0), Waypoint(3.0, 0.0, height=-1.5)]
    heights = [goal.height for goal in patrol_route(Mission(waypoints=points)).goals]
    assert heights[0::2] == [3.0, -1.5]
    assert math.isnan(heights[1])


def test_two_points_above_each_other_are_two() -> None:
    low, high = Goal("Point 1", 1.0, 1.0, height=1.0), Goal("Point 2", 1.0, 1.0, height=4.0)
    course = Course([low, high])
    course.advance()
    course.advance()
    course.edit(
        patrol_route(
            Mission(
                waypoints=[Waypoint(9.0, 9.0), Waypoint(1.0, 1.0, height=4.0), Waypoint(1.0, 1.0, height=1.0)]
            )
        )
    )
    assert course.take_over()
    assert course.goal.height == 4.0


@pytest.mark.parametrize("height", [1e308, 12.1, 0.2, -5.0])
def test_a_height_beyond_those_that_it_may_be_at_is_never_gone_to(height: float) -> None:
    stage = Lift(2.0)
    navigator = Stage().navigator
    for one in (stage.navigator, navigator):
        one.keep_height(2.0)
        one.heights = (0.3, 12.0)
    said = re.escape(f"The height must be from 0.3 to 12 m, not {height:g} m; it stays where it is.")
    level = ReachHeight(stage.navigator, stage.situation)
    with pytest.raises(OrderRefused, match=said):
        level.begin(Goal("Point 1", 0.0, 0.0, height=height))
    assert stage.navigator.kept_height == 2.0
    assert level.update(OVER) is Status.SUCCESS
    with pytest.raises(OrderRefused, match=said):
        navigator.command(Manoeuvre(kind="hover", height=height))
    with pytest.raises(OrderRefused, match=said):
        navigator.take_off(height)
    navigator.keep_height(12.0)
    navigator.command(Manoeuvre(kind="land"))
