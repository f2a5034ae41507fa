"""Patrolling: point after point in a loop, at random or with a halt at each; and the ways to a single place.

repeat ── visit ─┬─ choose the next point
                 ├─ try ─┬─ arrive ─┬─ drive to point
                 │       │          └─ reached
                 │       └─ skip it
                 └─ dwell
"""

from __future__ import annotations

import random
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Selector, Sequence
from py_trees.decorators import Repeat

from bridge.msgs.pilothouse_msgs import Mission, Waypoint
from robotside.behaviours.course import Course
from robotside.behaviours.drive_to import DriveTo
from robotside.behaviours.dwell import Dwell
from robotside.behaviours.situation import Situation
from robotside.events import Say
from robotside.guide import Goal, Guide

__all__ = ["patrol", "patrol_course", "single"]


class _Act(Behaviour):
    """One thing done at once."""

    def __init__(self, name: str, act: Callable[[], bool]) -> None:
        super().__init__(name)
        self._act = act

    def update(self) -> Status:
        return Status.SUCCESS if self._act() else Status.FAILURE


def patrol_course(mission: Mission, rng: random.Random) -> Course:
    """The points of `mission` in its motion."""
    count = len(mission.waypoints)
    goals = [_goal(f"Point {number} of {count}", point) for number, point in enumerate(mission.waypoints, 1)]
    dwell = mission.dwell if mission.motion == "intermittent" else 0.0
    return Course(goals, motion=mission.motion, laps=mission.laps, dwell=dwell, rng=rng)


def patrol(course: Course, guide: Guide, situation: Situation, say: Say) -> Behaviour:
    """The tree that visits the points of `course`; skips what cannot be reached, fails when nothing can."""
    drive = DriveTo(course, guide, situation)

    def choose() -> bool:
        course.advance()
        return True

    def reached() -> bool:
        course.reached()
        goal = course.goal
        say("waypoint", f"{goal.name} reached.", "ok", at=(goal.x, goal.y))
        return True

    def skip() -> bool:
        goal = course.goal
        goes_on = course.skip()
        after = "going on to the next" if goes_on else "and no other point can be either"
        say(
            "waypoint",
            f"{goal.name} is skipped, {after}: {drive.feedback_message}",
            "warn",
            at=(goal.x, goal.y),
        )
        return goes_on

    arrive = Sequence("arrive", memory=True, children=[drive, _Act("reached", reached)])
    either = Selector("try", memory=True, children=[arrive, _Act("skip", skip)])
    dwell = Dwell(course.dwell, situation)
    visit = Sequence("visit", memory=True, children=[_Act("choose", choose), either, dwell])
    return Repeat("patrol", visit, course.total or -1)


def single(name: str, place: Waypoint, guide: Guide, situation: Situation) -> tuple[Course, Behaviour]:
    """The way to one place, as `Home`: its course and its tree, which fails when the place cannot be reached."""
    course = Course([_goal(name, place)])

    def reached() -> bool:
        course.reached()
        return True

    drive = DriveTo(course, guide, situation)
    return course, Sequence(name, memory=True, children=[drive, _Act("reached", reached)])


def _goal(name: str, place: Waypoint) -> Goal:
    return Goal(f"{name}, {place.name}," if place.name else name, place.x, place.y, place.yaw)
