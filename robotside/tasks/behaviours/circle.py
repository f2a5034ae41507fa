"""The circle round an intruder at a safe distance, with a look from every side that can be reached."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.core.pose2 import Points, Pose2
from robotside.navigation.navigator import Goal, LegState, Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.situation import Seen, Situation

__all__ = ["CLEARANCE", "SIDES", "Circle", "Side", "in_order"]

CLEARANCE = 1.5
"""Between the body and the middle of what it goes round, all the way [m]."""

ERROR = 0.2
"""The place of what it goes round, and its own, may be off by so much [m]."""

STANDING_ROOM = 0.25
"""It stands so much farther away than its way may lead [m]: it does not stop on a point."""

SIDES = ("east", "north-east", "north-west", "west", "south-west", "south-east")
"""From which it is looked at, anticlockwise, each as seen from what it goes round: `east` of the map is along x."""

SIGHT_STEP, THING_RADIUS = 0.1, 0.6
"""A line of sight is looked at in such steps, but for what stands at its end [m]."""


@dataclass(frozen=True, slots=True)
class Side:
    """One side that can be stood at."""

    number: int
    """Of `SIDES`, from 0."""
    goal: Goal

    @property
    def angle(self) -> float:
        """As seen from what it goes round [rad]."""
        return self.number * math.tau / len(SIDES)


def in_order(sides: Sequence[Side], start: Pose2, reach: float) -> list[Side]:
    """`sides` one after the other round the circle of radius `reach` [m], beginning where that makes the way shortest."""

    def way(order: Sequence[Side]) -> float:
        turns = [abs(math.remainder(b.angle - a.angle, math.tau)) for a, b in itertools.pairwise(order)]
        return start.distance(order[0].goal.x, order[0].goal.y) + reach * sum(turns)

    rounds = [
        [*ring[first:], *ring[:first]]
        for ring in (list(sides), list(reversed(sides)))
        for first in range(len(ring))
    ]
    return min(rounds, key=way, default=[])


class Circle(Behaviour):
    """Goes round each intruder that waits for it; fails when none is left, so that the task goes on.

    A side that cannot be reached, or from which a wall hides it, is left out and told.
    """

    def __init__(
        self, navigator: Navigator, situation: Situation, say: Say, fault: Callable[[float, float], str]
    ) -> None:
        """`fault` gives the reason why the robot cannot or may not stand at a place; empty when it can."""
        super().__init__("circle intruders")
        self._navigator, self._situation, self._say, self._fault = navigator, situation, say, fault
        discs = navigator.controller.discs
        self._body = max(map(abs, discs)) + navigator.radius
        """How far the body reaches from `base_link`, whichever way it points [m]."""
        self._round: Seen | None = None
        self._sides: list[Side] = []
        self._seen: set[int] = set()

    @property
    def _reach(self) -> float:
        """Of the circle that it stands on, from what it goes round to `base_link` [m]."""
        return CLEARANCE + ERROR + self._body + STANDING_ROOM

    def initialise(self) -> None:
        """Begin with the first one, if any."""
        self._next()

    def update(self) -> Status:
        """Go on round it."""
        now, seen = self._situation, self._round
        if seen is None:
            return Status.FAILURE
        left = len(self._sides)
        now.report("circling", f"Going round intruder {seen.id} and looking at it.", still=4.0 * left)
        if self._sides:
            points = np.concatenate([now.points, now.pose.inverse().apply(self._kept_off(seen))])
            leg = self._navigator.update(now.pose, points, now.now)
            if leg is LegState.UNDER_WAY:
                return Status.RUNNING
            side = self._sides.pop(0)
            if leg is LegState.ARRIVED:
                self._seen.add(side.number)
        if self._sides:
            self._head_for(seen, self._sides[0])
            return Status.RUNNING
        self._tell_end(seen)
        self._next()
        return Status.RUNNING if self._round else Status.FAILURE

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        if self._round is not None or new_status is Status.INVALID:
            self._navigator.rest()
        self._navigator.obstacles.keep_off(np.empty((0, 2)))
        self._round, self._sides = None, []

    def _next(self) -> None:
        waiting = self._situation.intruders
        self._round = waiting.popleft() if waiting else None
        self._navigator.obstacles.keep_off(np.empty((0, 2)))
        if self._round is None:
            return
        self._sides, self._seen = self._plan(self._round), set()
        if self._sides:
            self._head_for(self._round, self._sides[0])

    def _head_for(self, seen: Seen, side: Side) -> None:
        self._navigator.obstacles.keep_off(self._kept_off(seen))
        self._navigator.head_for(side.goal, patient=False)

    def _plan(self, seen: Seen) -> list[Side]:
        """The sides that can be stood at and that see it, in the order in which they are gone to."""
        sides = []
        for number in range(len(SIDES)):
            angle = number * math.tau / len(SIDES)
            x, y = seen.x + self._reach * math.cos(angle), seen.y + self._reach * math.sin(angle)
            if not self._fault(x, y) and self._sees(x, y, seen):
                yaw = math.remainder(angle + math.pi, math.tau)
                sides.append(Side(number, Goal(f"The {SIDES[number]} side of intruder {seen.id}", x, y, yaw)))
        return in_order(sides, self._situation.pose, self._reach)

    def _sees(self, x: float, y: float, seen: Seen) -> bool:
        """No wall of the map stands between a place and it; it may stand at one itself."""
        far = math.hypot(seen.x - x, seen.y - y)
        along = np.arange(0.0, max(far - THING_RADIUS, SIGHT_STEP), SIGHT_STEP)[:, None] / far
        line = np.array([x, y]) + along * np.array([seen.x - x, seen.y - y])
        return bool((self._navigator.planner.map.clearance(line) > 0).all())

    def _kept_off(self, seen: Seen) -> Points:
        """The ring that its body stays outside of; a smaller one for who stands within it already and has to come out."""
        pose = self._situation.pose
        radius = min(CLEARANCE + ERROR, pose.distance(seen.x, seen.y) - self._body - STANDING_ROOM)
        if radius <= 0:
            return np.empty((0, 2))
        angles = np.arange(0.0, math.tau, SIGHT_STEP / radius)
        return np.array([seen.x, seen.y]) + radius * np.column_stack([np.cos(angles), np.sin(angles)])

    def _tell_end(self, seen: Seen) -> None:
        looked, count = len(self._seen), len(SIDES)
        missing = ", ".join(name for number, name in enumerate(SIDES) if number not in self._seen)
        if looked == count:
            text, level = f"Intruder {seen.id} was seen from all {count} sides; going on.", "ok"
        elif looked:
            text = f"Intruder {seen.id} was seen from {looked} of {count} sides; not: {missing}."
            level = "info"
        else:
            text = f"There is no room to go round intruder {seen.id}; going on."
            level = "warn"
        circled = Notice(Code.INTRUDER_CIRCLED, text, id=seen.id, sides=looked, count=count, missing=missing)
        self._say("intruder", circled, level, at=(seen.x, seen.y))
