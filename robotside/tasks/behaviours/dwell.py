"""A stop at a point for a while."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation

__all__ = ["Dwell"]


class Dwell(Behaviour):
    """Stands as long as the course says, or for `duration` [s]; a pause does not count."""

    def __init__(self, duration: float, situation: Situation, course: Course | None = None) -> None:
        """`course` gives time and place instead, each time anew."""
        super().__init__("dwell")
        self._duration, self._situation, self._course = duration, situation, course
        self._until = -math.inf

    def initialise(self) -> None:
        """Begin to wait; the robot is at rest already."""
        if self._course is not None:
            self._duration = self._course.dwell
        self._until = self._situation.worked + self._duration

    def update(self) -> Status:
        """Wait."""
        left = self._until - self._situation.worked
        self.feedback_message = f"Standing for another {max(left, 0.0):.0f} s."
        if left <= 1e-6:
            return Status.SUCCESS
        self._report(left)
        return Status.RUNNING

    def _report(self, left: float) -> None:
        goal = self._course.goal if self._course else None
        where = f" at {goal.spoken}" if goal else ""
        text = f"Standing{where} for {self._duration:.0f} s."
        self._situation.report("dwelling", text, place=goal.place if goal else "", still=left)
