"""The height of a point: one that swims or flies is there when it is at it as well."""

from __future__ import annotations

import math

from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.notice import Notice
from robotside.navigation.navigator import Goal, Navigator
from robotside.tasks.behaviours.fly import HEIGHT_TOLERANCE, MIN_RISE, RISE_TIMEOUT
from robotside.tasks.behaviours.situation import Situation

__all__ = ["ReachHeight"]


class ReachHeight:
    """Climbs or sinks over a point to the height that the robot is to keep; gives up where it comes no nearer to it."""

    def __init__(self, navigator: Navigator, situation: Situation) -> None:
        self._navigator, self._situation = navigator, situation
        self._nearest, self._since = math.inf, 0.0

    def begin(self, goal: Goal) -> None:
        """The robot sets out for `goal`, at its height if it has one; the time runs from when it is there."""
        self._nearest = math.inf
        if not math.isnan(goal.height):
            self._navigator.keep_height(goal.height)

    def update(self, goal: Goal) -> Status:
        """Go on over `goal`; succeeds at the height, and where none is to be kept or measured."""
        navigator, now = self._navigator, self._situation.worked
        wanted = navigator.kept_height
        off = abs(navigator.height - wanted)
        if math.isnan(off) or off <= HEIGHT_TOLERANCE:
            return Status.SUCCESS
        if off < self._nearest - MIN_RISE:
            self._nearest, self._since = off, now
        if now - self._since >= RISE_TIMEOUT:
            reached = navigator.height
            said = f"It comes no nearer to {wanted:g} m than {reached:.1f} m; it stays there."
            navigator.reason = Notice(Code.HEIGHT_UNREACHED, said, height=wanted, reached=reached)
            return Status.FAILURE
        navigator.command(Manoeuvre(kind="hover", height=wanted))
        verb = "Climbs" if wanted > navigator.height else "Sinks"
        self._situation.report("driving", f"{verb} to {wanted:g} m at {goal.spoken}.", place=goal.place)
        return Status.RUNNING
