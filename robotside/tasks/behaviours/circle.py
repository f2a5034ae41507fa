"""The circle round an intruder at a safe distance, with a look from every side."""

from __future__ import annotations

import math
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.situation import Seen, Situation

__all__ = ["CLEARANCE", "Circle"]

CLEARANCE = 1.5
"""Between the body and what it goes round [m]."""

SIDES = 6
"""From which it is looked at."""


class Circle(Behaviour):
    """Goes round each intruder that waits for it; fails when none is left, so that the task goes on.

    A side that cannot be reached is left out.
    """

    def __init__(
        self, navigator: Navigator, situation: Situation, say: Say, fault: Callable[[float, float], str]
    ) -> None:
        """`fault` gives the reason why the robot cannot or may not stand at a place; empty when it can."""
        super().__init__("circle intruders")
        self._navigator, self._situation, self._say, self._fault = navigator, situation, say, fault
        self._round: Seen | None = None
        self._sides: list[Goal] = []
        self._looked = 0

    def initialise(self) -> None:
        """Begin with the first one, if any."""
        self._next()

    def update(self) -> Status:
        """Go on round it."""
        now, seen = self._situation, self._round
        if seen is None:
            return Status.FAILURE
        left = SIDES - self._looked
        now.report("circling", f"Going round intruder {seen.id} and looking at it.", still=4.0 * left)
        if self._sides:
            leg = self._navigator.update(now.pose, now.points, now.now)
            if leg is LegState.UNDER_WAY:
                return Status.RUNNING
            self._looked += leg is LegState.ARRIVED
            self._sides.pop(0)
        if self._sides:
            self._navigator.head_for(self._sides[0])
            return Status.RUNNING
        self._tell_end(seen)
        self._next()
        return Status.RUNNING if self._round else Status.FAILURE

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        if self._round is not None or new_status is Status.INVALID:
            self._navigator.rest()
        self._round, self._sides = None, []

    def _next(self) -> None:
        waiting = self._situation.intruders
        self._round = waiting.popleft() if waiting else None
        if self._round is None:
            return
        self._sides, self._looked = self._ring(self._round), 0
        if self._sides:
            self._navigator.head_for(self._sides[0])

    def _ring(self, seen: Seen) -> list[Goal]:
        """The sides that can be stood at, beginning with the nearest, each looking inwards."""
        pose, reach = self._situation.pose, self._navigator.radius + CLEARANCE
        first = math.atan2(pose.y - seen.y, pose.x - seen.x)
        sides = []
        for number in range(SIDES):
            angle = first + number * math.tau / SIDES
            x, y = seen.x + reach * math.cos(angle), seen.y + reach * math.sin(angle)
            if not self._fault(x, y):
                name = f"A place beside intruder {seen.id}"
                sides.append(Goal(name, x, y, math.remainder(angle + math.pi, math.tau)))
        return sides

    def _tell_end(self, seen: Seen) -> None:
        if self._looked == SIDES:
            text, level = f"Intruder {seen.id} was gone round; going on.", "ok"
        elif self._looked:
            text = f"Intruder {seen.id} was looked at from {self._looked} of {SIDES} sides; going on."
            level = "info"
        else:
            text = f"There is no room to go round intruder {seen.id}; going on."
            level = "warn"
        circled = Notice(Code.INTRUDER_CIRCLED, text, id=seen.id, sides=self._looked)
        self._say("intruder", circled, level, at=(seen.x, seen.y))
