"""The drive to the next point of a course."""

from __future__ import annotations

import math
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.reach_height import ReachHeight
from robotside.tasks.behaviours.situation import Situation

__all__ = ["LEG_STATUS", "DriveTo"]

LEG_STATUS = {
    LegState.UNDER_WAY: Status.RUNNING,
    LegState.ARRIVED: Status.SUCCESS,
    LegState.BLOCKED: Status.FAILURE,
}

STANDING_TIMEOUT = 4.0
"""A robot that has not moved for so long reports that it makes no way [s]."""

MIN_MOVE, MIN_TURN = 0.1, 0.2
"""Less than this is no way [m, rad]."""


class DriveTo(Behaviour):
    """Succeeds at the point, fails when there is no way; `feedback_message` says how far it is or why not."""

    def __init__(
        self,
        course: Course,
        navigator: Navigator,
        situation: Situation,
        words: Callable[[Goal], str] = lambda goal: f"Heading for {goal.spoken}.",
    ) -> None:
        """`words` say where it goes, as one sentence."""
        super().__init__("drive to point")
        self._course, self._navigator, self._situation, self._words = course, navigator, situation, words
        self._was, self._since = situation.pose, situation.worked
        self._level = ReachHeight(navigator, situation)

    def initialise(self) -> None:
        """Set out for the course's point."""
        self._navigator.head_for(self._course.goal)
        self._level.begin(self._course.goal)
        self._was, self._since = self._situation.pose, self._situation.worked

    def update(self) -> Status:
        """Drive on."""
        now, goal = self._situation, self._course.goal
        leg = self._navigator.update(now.pose, now.points, now.now)
        self.feedback_message = self._sentence(leg)
        if self._navigator.waits_for or self._navigator.planning:
            self._was, self._since = now.pose, now.worked
        if self._navigator.waits_for:
            now.report("taking off", self._navigator.waits_for, place=goal.place)
            return LEG_STATUS[leg]
        if self._navigator.doubts:
            self._was, self._since = now.pose, now.worked
            now.report("unsure", f"Making sure that this is {goal.spoken}.", place=goal.place)
            return LEG_STATUS[leg]
        if self._navigator.blocked:
            self._was, self._since = now.pose, now.worked
            now.report("waiting", self._navigator.blocked, place=goal.place)
            return LEG_STATUS[leg]
        if self._navigator.planning:
            now.report("planning", f"Looking for a way to {goal.spoken}.", place=goal.place)
            return LEG_STATUS[leg]
        if leg is LegState.ARRIVED and (level := self._level.update(goal)) is not Status.SUCCESS:
            self._was, self._since = now.pose, now.worked
            self.feedback_message = self._navigator.reason
            return level
        said = f"Makes no way to {goal.spoken}; it goes on trying." if self._stands() else self._words(goal)
        now.report("turning" if self._navigator.turning else "driving", said, place=goal.place)
        return LEG_STATUS[leg]

    def _stands(self) -> bool:
        """It was to move and has not, for a while."""
        pose, clock = self._situation.pose, self._situation.worked
        turned = abs(math.remainder(pose.yaw - self._was.yaw, math.tau))
        if pose.distance(self._was.x, self._was.y) > MIN_MOVE or turned > MIN_TURN:
            self._was, self._since = pose, clock
        return clock - self._since > STANDING_TIMEOUT

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        self._navigator.rest()

    def _sentence(self, leg: LegState) -> str:
        goal = self._course.goal
        if leg is LegState.BLOCKED:
            return self._navigator.reason
        if leg is LegState.ARRIVED:
            return f"{goal.name} reached."
        if self._navigator.planning:
            return f"Looking for a way to {goal.spoken}."
        return f"Heading for {goal.name[0].lower()}{goal.name[1:]}, {self._navigator.remaining:.0f} m to go."
