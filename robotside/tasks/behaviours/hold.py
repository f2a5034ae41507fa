"""Holding the place."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.kinds.registry import kind_of
from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.tasks.behaviours.course import Span
from robotside.tasks.behaviours.fly import TakeOff
from robotside.tasks.behaviours.situation import Situation

__all__ = ["Hold"]


class Hold(Behaviour):
    """Stands until the time of `span` is over, for ever when it has none; a pause does not count.

    What swims or flies keeps its heading and its height, or goes to the one that is asked for; what drifts comes back.
    """

    def __init__(
        self, span: Span, navigator: Navigator, situation: Situation, height: float = math.nan
    ) -> None:
        """`height` above the map's origin [m]; NaN for the present one."""
        super().__init__("hold")
        self._span, self._navigator, self._situation, self._height = span, navigator, situation, height
        self._rise = TakeOff(navigator, situation, height)
        self._place: Goal | None = None
        self._returns = False

    def initialise(self) -> None:
        """Come to rest."""
        pose = self._situation.pose
        self._navigator.rest()
        self._place, self._returns = Goal("The place to hold", pose.x, pose.y), False
        self._span.begin()

    def update(self) -> Status:
        """Stay."""
        lasts = self._span.duration
        text = "until it is stopped" if math.isnan(lasts) else f"for {lasts:.0f} s"
        self.feedback_message = f"Holding here {text}."
        if self._navigator.controller.keeps_courses:
            self._keep()
        if not self._returns:
            self._situation.report("holding", self.feedback_message)
        return Status.SUCCESS if self._span.over else Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        """Rest."""
        if self._navigator.controller.keeps_courses:
            self._navigator.rest()

    def _keep(self) -> None:
        """Keep heading and height, and the place as far as the kind can."""
        navigator, now, place = self._navigator, self._situation, self._place
        if now.flight in ("landed", "taking_off"):
            if not math.isnan(self._height):
                self._rise.tell_robot()
            return  # it stands on the ground
        astray = kind_of(navigator.kind).astray
        if place and not self._returns and now.pose.distance(place.x, place.y) > astray:
            self._returns = True
            navigator.head_for(place)
        if self._returns:
            now.report("driving", "Coming back to where it holds: it was carried away.")
            self._returns = navigator.update(now.pose, now.points, now.now) is LegState.UNDER_WAY
            if not self._returns:
                navigator.rest()
            return
        navigator.command(Manoeuvre(kind="hover", height=self._height))
