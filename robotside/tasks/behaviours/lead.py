"""The guide that leads a person along places: it waits when no one follows, and says what is there."""

from __future__ import annotations

import math
from collections.abc import Sequence as Places

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Sequence

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice
from robotside.navigation.navigator import Goal, Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.acts import Action, Rounds
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import DriveTo
from robotside.tasks.behaviours.patrol import at_place
from robotside.tasks.behaviours.situation import Situation

__all__ = ["FOLLOWER_TIMEOUT", "SENSOR_TIMEOUT", "STAY_TIME", "lead"]

FOLLOWER_TIMEOUT = 1.5
"""It drives on for so long after the follower was lost [s]."""

SENSOR_TIMEOUT = 3.0
"""A sensor that was silent for this long does not show who follows [s]."""

STAY_TIME = 6.0
"""Stop at a place that has a note [s]."""


class _Lead(DriveTo):
    """Drives to the course's point, no faster than who follows."""

    def __init__(self, course: Course, navigator: Navigator, situation: Situation, say: Say) -> None:
        super().__init__(course, navigator, situation, self._doing)
        self._say = say
        self._alone_since = math.nan
        self._waits = self._blind = False

    def update(self) -> Status:
        """Drive on, or wait."""
        now, goal = self._situation, self._course.goal
        if not self._alone():
            if self._waits:
                self._waits = False
                said = f"The person follows again; going on to {goal.spoken}."
                self._say("task", Notice(Code.FOLLOWER_BACK, said, place=goal.place), "ok")
            return super().update()
        if not self._waits:
            self._waits = True
            self._navigator.rest()
            at = (now.pose.x, now.pose.y)
            said = f"Waiting on the way to {goal.spoken}: no one follows."
            self._say("task", Notice(Code.FOLLOWER_LOST, said, place=goal.place), "warn", at=at)
        now.report("waiting", "Waiting: no one follows.", place=goal.place)
        return Status.RUNNING

    def _doing(self, goal: Goal) -> str:
        waits = ", without waiting: no sensor detects followers" if self._blind else ""
        return f"Leading the way to {goal.spoken}{waits}."

    def _alone(self) -> bool:
        """No one has followed for a while, by the sensor."""
        now = self._situation
        if now.follows is None or now.now - now.follows_heard > SENSOR_TIMEOUT:
            if not self._blind:
                said = "No sensor detects followers; the robot goes on without waiting."
                self._say("task", Notice(Code.FOLLOWER_UNKNOWN, said), "warn")
            self._blind, self._alone_since = True, math.nan
            return False
        self._blind = False
        if now.follows:
            self._alone_since = math.nan
        elif math.isnan(self._alone_since):
            self._alone_since = now.now
        return now.now - self._alone_since > FOLLOWER_TIMEOUT or (self._waits and not now.follows)


class _Tell(Behaviour):
    """Says the note of the place where it stands, and stays as long as that takes."""

    def __init__(self, course: Course, notes: list[str], situation: Situation, say: Say) -> None:
        super().__init__("tell")
        self._course, self._notes, self._situation, self._say = course, notes, situation, say
        self._until = -math.inf

    def initialise(self) -> None:
        goal, note = self._course.goal, self._notes[self._course.index]
        words = f"{goal.name} reached: {note}" if note else f"{goal.name} reached."
        reached = Notice(Code.WAYPOINT_REACHED, words, place=goal.name.rstrip(","))
        self._say("waypoint", reached, "ok", at=(goal.x, goal.y))
        self._until = self._situation.worked + (STAY_TIME if note else 0.0)

    def update(self) -> Status:
        left = self._until - self._situation.worked
        if left <= 1e-6:
            return Status.SUCCESS
        goal, note = self._course.goal, self._notes[self._course.index]
        text = f"At {goal.spoken}: {note}"
        self._situation.report("dwelling", text, place=goal.place, still=left)
        return Status.RUNNING


def lead(
    places: Places[Place], message: str, navigator: Navigator, situation: Situation, say: Say
) -> tuple[Course, Behaviour]:
    """Along `places` in their order; `message` is said at the start, empty for none."""
    course = Course([at_place(place) for place in places])

    def count() -> bool:
        course.reached()
        return True

    def choose() -> bool:
        if course.index < 0 and message:
            say("task", Notice(Code.MESSAGE_TOLD, message, place="", message=message), "info")
        course.advance()
        return True

    leg = Sequence(
        "leg",
        memory=True,
        children=[
            Action("choose", choose),
            _Lead(course, navigator, situation, say),
            _Tell(course, [place.note for place in places], situation, say),
            Action("count", count),
        ],
    )
    return course, Rounds("guide", leg, lambda: course.finished)
