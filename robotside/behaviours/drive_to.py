"""Driving to the point that a course heads for."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from robotside.behaviours.course import Course
from robotside.behaviours.situation import Situation
from robotside.guide import Guide, Leg

__all__ = ["DriveTo"]

_STATUS = {Leg.UNDER_WAY: Status.RUNNING, Leg.ARRIVED: Status.SUCCESS, Leg.BLOCKED: Status.FAILURE}


class DriveTo(Behaviour):
    """Succeeds at the point, fails when there is no way; `feedback_message` says how far it is or why not."""

    def __init__(self, course: Course, guide: Guide, situation: Situation) -> None:
        super().__init__("drive to point")
        self._course, self._guide, self._situation = course, guide, situation

    def initialise(self) -> None:
        """Set out for the course's point."""
        self._guide.head_for(self._course.goal)

    def update(self) -> Status:
        """Drive on."""
        now = self._situation
        leg = self._guide.update(now.pose, now.points, now.now)
        self.feedback_message = self._sentence(leg)
        return _STATUS[leg]

    def terminate(self, new_status: Status) -> None:
        """Stand still, whatever the reason."""
        self._guide.rest()

    def _sentence(self, leg: Leg) -> str:
        name = self._course.goal.name
        if leg is Leg.BLOCKED:
            return self._guide.reason
        if leg is Leg.ARRIVED:
            return f"{name} reached."
        return f"Heading for {name[0].lower()}{name[1:]}, {self._guide.remaining:.0f} m to go."
