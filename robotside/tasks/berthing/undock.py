"""Leaving a dock: slowly and straight back, before anything else moves the robot."""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Place
from bridge.msgs.sensor_msgs import BatteryState
from robotside.core.notice import Notice
from robotside.core.pose2 import ORIGIN
from robotside.navigation.navigator import Navigator
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.approach import DOCK_NEAR, Approach

__all__ = ["Undock"]

MIN_ROOM = 0.15
"""Behind it there is at least so much [m]; for less it waits."""

ROOM_TIMEOUT, UNDOCK_TIMEOUT = 15.0, 60.0
"""It waits for who stands behind it for so long, and takes no longer in all [s]."""

_IN_CONTACT = (
    BatteryState.POWER_SUPPLY_STATUS_CHARGING,
    BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING,
    BatteryState.POWER_SUPPLY_STATUS_FULL,
)


class Undock(Behaviour):
    """Succeeds at once for a robot that is in no dock, else when it is out of it; fails, at rest, when it cannot get out."""

    def __init__(
        self,
        docks: Callable[[], list[Place]],
        navigator: Navigator,
        situation: Situation,
        approach: Approach,
        near: float = DOCK_NEAR,
    ) -> None:
        """`docks` are the places of docks; with contact no farther than `near` from one of them it stands in it [m]."""
        super().__init__("undock")
        self._docks, self._navigator, self._situation, self._way = docks, navigator, situation, approach
        self._near = near
        self.dock = ""
        """The dock that it leaves or has left; empty when it was in none."""
        self._from = ORIGIN
        self._began = self._waited = 0.0

    def initialise(self) -> None:
        """Look whether it is in one."""
        now = self._situation
        self.dock, self._from = self._within(), now.odom
        self._began, self._waited = now.worked, 0.0
        self._last = now.worked

    def update(self) -> Status:
        """Go on back."""
        now = self._situation
        gone = now.odom.distance(self._from.x, self._from.y)
        if not self.dock or gone >= self._way.leave:
            return Status.SUCCESS
        behind = self._way.room_behind(now.points)
        step, self._last = now.worked - self._last, now.worked
        if behind < MIN_ROOM:
            self._waited += step
            self._navigator.move(Twist())
            now.report("undocking", f"Waiting: something stands behind at {self.dock}.", place=self.dock)
        else:
            left = (self._way.leave - gone) / self._way.retreat
            now.report(
                "undocking",
                f"Leaving {self.dock}.",
                place=self.dock,
                still=left,
                touches=gone < self._way.guided,
            )
            self._navigator.move(Twist.planar(-self._way.retreat, 0.0))
        if self._waited > ROOM_TIMEOUT or now.worked - self._began > UNDOCK_TIMEOUT:
            said = f"{self.dock} cannot be left: {'something stands behind' if behind < MIN_ROOM else 'the robot does not move'}."
            self._navigator.reason = Notice(Code.UNDOCK_BLOCKED, said, place=self.dock)
            return Status.FAILURE
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        """Stand still, if it moved."""
        if self.dock:
            self._navigator.rest()

    _last = 0.0

    def _within(self) -> str:
        """The dock whose contacts it touches, or touched when its battery was last heard; empty for none."""
        now = self._situation
        if now.last_power not in _IN_CONTACT:
            return ""
        near = [dock for dock in self._docks() if now.pose.distance(dock.x, dock.y) <= self._near]
        return min(near, key=lambda dock: now.pose.distance(dock.x, dock.y)).name if near else ""
