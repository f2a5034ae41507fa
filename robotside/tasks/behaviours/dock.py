"""Docking: to a place before the dock, turn to it, and creep on until the battery takes charge."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal, Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import LEG_STATUS
from robotside.tasks.behaviours.situation import Situation

__all__ = ["APPROACH_DISTANCE", "CHARGE_TIMEOUT", "Dock", "before"]

APPROACH_DISTANCE = 0.8
"""From where it stands at the dock back to where it turns to it [m]."""

CREEP_SPEED = 0.08
"""On the last bit [m/s]."""

MAX_BEYOND = 0.15
"""It creeps no farther than this beyond the dock's place [m]."""

CHARGE_TIMEOUT = 20.0
"""So long it creeps and waits for the charge [s]."""

MAX_ASIDE = 0.25
"""A robot farther than this from the line to the dock begins again [m]."""

MAX_ASKEW = 0.5
"""The same for the direction [rad]."""


def before(dock: Place) -> Goal:
    """Where it turns to the dock; `dock` has a direction."""
    x, y = dock.x - APPROACH_DISTANCE * math.cos(dock.yaw), dock.y - APPROACH_DISTANCE * math.sin(dock.yaw)
    return Goal(dock.name, x, y, dock.yaw, dock.name)


class Dock(Behaviour):
    """Succeeds when the battery takes charge; fails when there is no way or no charge in time, and says which."""

    def __init__(self, dock: Place, course: Course, navigator: Navigator, situation: Situation) -> None:
        """`course` has the one point that `before` gives."""
        super().__init__("dock")
        self._dock, self._course, self._navigator, self._situation = dock, course, navigator, situation
        self._place = Pose2(dock.x, dock.y, dock.yaw)
        self._began = math.nan

    def initialise(self) -> None:
        """Set out."""
        self._set_out()

    def update(self) -> Status:
        """Go on."""
        if math.isnan(self._began):
            return self._approach()
        return self._creep()

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        self._navigator.rest()

    def _set_out(self) -> None:
        self._began = math.nan
        self._navigator.head_for(self._course.goal)

    def _approach(self) -> Status:
        now, name = self._situation, self._dock.name
        if now.charging and now.pose.distance(self._dock.x, self._dock.y) < APPROACH_DISTANCE / 2:
            self._course.reached()
            return Status.SUCCESS
        leg = self._navigator.update(now.pose, now.points, now.now)
        phase = "turning" if self._navigator.turning else "driving"
        text = f"Turning to {name}." if self._navigator.turning else f"Heading for {name}."
        now.report(phase, text, place=name, still=APPROACH_DISTANCE / CREEP_SPEED)
        if LEG_STATUS[leg] is Status.SUCCESS:
            self._navigator.finish()
            self._began = now.worked
            return Status.RUNNING
        return LEG_STATUS[leg]

    def _creep(self) -> Status:
        now, name = self._situation, self._dock.name
        if now.charging:
            self._course.reached()
            return Status.SUCCESS
        here = now.pose.since(self._place)
        if abs(here.y) > MAX_ASIDE or abs(here.yaw) > MAX_ASKEW or here.x < -APPROACH_DISTANCE - MAX_ASIDE:
            self._set_out()  # it was moved meanwhile
            return Status.RUNNING
        left = CHARGE_TIMEOUT - (now.worked - self._began)
        if left <= 0:
            said = f"No charge at {name} within {CHARGE_TIMEOUT:.0f} s; the robot stands there."
            self._navigator.reason = Notice(Code.DOCK_DEAD, said, place=name, seconds=CHARGE_TIMEOUT)
            return Status.FAILURE
        at_end = now.touched or here.x > MAX_BEYOND
        text = f"Waiting for the charge at {name}." if at_end else f"Creeping to {name}."
        now.report("docking", text, place=name, still=left)
        turn = -1.5 * here.yaw - 2.0 * here.y
        self._navigator.move(Twist() if at_end else Twist.planar(CREEP_SPEED, max(-0.3, min(0.3, turn))))
        return Status.RUNNING
