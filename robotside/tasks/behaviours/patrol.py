"""Patrols: point after point in a loop, at random or with a stop at each; and the ways to a single place.

rounds ── visit ─┬─ choose the next point
                 ├─ try ─┬─ arrive ─┬─ drive ─┬─ circle intruders
                 │       │          │         └─ drive to point
                 │       │          └─ reached
                 │       └─ skip it
                 └─ dwell
"""

from __future__ import annotations

import random
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.composites import Selector, Sequence

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Mission, Place, Waypoint
from robotside.core.notice import Notice
from robotside.navigation.navigator import Goal, Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.acts import Action, Rounds
from robotside.tasks.behaviours.circle import Circle
from robotside.tasks.behaviours.course import Course, Route
from robotside.tasks.behaviours.drive_to import DriveTo
from robotside.tasks.behaviours.dwell import Dwell
from robotside.tasks.behaviours.situation import Situation

__all__ = ["at_place", "patrol", "patrol_course", "patrol_route", "single", "way"]


def patrol_route(mission: Mission) -> Route:
    """The points of `mission` and how they are visited."""
    count = len(mission.waypoints)
    goals = tuple(_goal(f"Point {n} of {count}", point) for n, point in enumerate(mission.waypoints, 1))
    return Route(goals, mission.motion, mission.laps, _dwell(mission))


def patrol_course(mission: Mission, rng: random.Random) -> Course:
    """The points of `mission` in its motion."""
    goals, motion, laps, dwell = patrol_route(mission)
    return Course(goals, motion=motion, laps=laps, dwell=dwell, rng=rng)


def patrol(
    course: Course,
    navigator: Navigator,
    situation: Situation,
    say: Say,
    fault: Callable[[float, float], str] = lambda *_: "",
) -> Behaviour:
    """The tree that visits the points of `course`; skips what cannot be reached, fails when nothing can.

    What waits in `situation.intruders` is gone round on the way; `fault` gives the reason where the robot cannot stand.
    """
    drive = DriveTo(course, navigator, situation)

    def take_over() -> None:
        if course.take_over():
            points = "point" if course.count == 1 else "points"
            said = f"The patrol goes on with the new mission of {course.count} {points}."
            say("task", Notice(Code.TASK_EDITED, said, count=course.count), "ok")

    def choose() -> bool:
        take_over()
        course.advance()
        return True

    def finished() -> bool:
        take_over()
        return course.finished

    def skip() -> bool:
        goal = course.goal
        goes_on = course.skip()
        after = "going on to the next" if goes_on else "and no other point can be either"
        said = f"{goal.name} is skipped, {after}: {drive.feedback_message}"
        skipped = Notice(Code.WAYPOINT_SKIPPED, said, place=goal.name.rstrip(","))
        say("waypoint", skipped, "warn", at=(goal.x, goal.y))
        return goes_on

    circle = Circle(navigator, situation, say, fault)
    drives = Selector("drive", memory=False, children=[circle, drive])
    arrive = Sequence(
        "arrive", memory=True, children=[drives, Action("reached", lambda: _reached(course, say))]
    )
    either = Selector("try", memory=True, children=[arrive, Action("skip", skip)])
    dwell = Dwell(course.dwell, situation, course)
    visit = Sequence("visit", memory=True, children=[Action("choose", choose), either, dwell])
    return Rounds("patrol", visit, finished)


def way(course: Course, navigator: Navigator, situation: Situation, say: Say | None = None) -> Behaviour:
    """The tree that visits the points of `course` once, and fails where one cannot be reached."""

    def reached() -> bool:
        if say is not None:
            return _reached(course, say)
        course.reached()
        return True

    drive = DriveTo(course, navigator, situation)
    choose = Action("choose", lambda: bool(course.advance()))
    leg = Sequence("leg", memory=True, children=[choose, drive, Action("reached", reached)])
    return Rounds("way", leg, lambda: course.finished)


def single(
    name: str, place: Waypoint, navigator: Navigator, situation: Situation
) -> tuple[Course, Behaviour]:
    """The way to one place, as `Home`: its course and its tree, which fails when the place cannot be reached."""
    course = Course([_goal(name, place)])

    def reached() -> bool:
        course.reached()
        return True

    def words(goal: Goal) -> str:
        return "Heading home." if name == "Home" else f"Heading for {goal.spoken}."

    drive = DriveTo(course, navigator, situation, words)
    return course, Sequence(name, memory=True, children=[drive, Action("reached", reached)])


def at_place(place: Place) -> Goal:
    """A place that has a name."""
    return Goal(place.name, place.x, place.y, place.yaw, place.name, place.height)


def _reached(course: Course, say: Say) -> bool:
    course.reached()
    goal = course.goal
    reached = Notice(Code.WAYPOINT_REACHED, f"{goal.name} reached.", place=goal.name.rstrip(","))
    say("waypoint", reached, "ok", at=(goal.x, goal.y))
    return True


def _dwell(mission: Mission) -> float:
    return mission.dwell if mission.motion == "intermittent" else 0.0


def _goal(name: str, place: Waypoint) -> Goal:
    called = place.name or ("Home" if name == "Home" else "")
    spoken = f"{name}, {place.name}," if place.name else name
    return Goal(spoken, place.x, place.y, place.yaw, called, place.height)
