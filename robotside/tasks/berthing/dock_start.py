"""Where going up to a dock begins: as far before it as there is room, and where that led to nothing, elsewhere."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Problem
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal

__all__ = ["Fault", "DockStarts", "before", "body_fault", "starts"]

ELSEWHERE = 0.5
"""Places to begin from that are no farther apart than this are the same one [m]."""

Fault = Callable[[str, float, float], Problem]
"""Why the robot cannot or may not stand at a place of that name [m, in `map`]; empty when it can."""


def before(dock: Place, docked: Pose2, distance: float, slant: float = 0.0) -> Goal:
    """Before the `dock`, so far from where the robot stands `docked` [m], on a line turned by `slant` about there [rad]."""
    line = Pose2(docked.x, docked.y, docked.yaw + slant)
    x, y, yaw = line.then(Pose2(-distance, 0.0, 0.0))
    return Goal(dock.name, x, y, yaw, dock.name, dock.height)


def body_fault(name: str, at: Goal, fault: Fault, discs: Sequence[float]) -> Problem:
    """Why a body that is covered by `discs` so far ahead of its middle [m] cannot stand `at` a place called `name`; empty when it can."""
    for disc in discs:
        x, y, _ = Pose2(at.x, at.y, at.yaw).then(Pose2(disc, 0.0, 0.0))
        problem = fault(name, x, y)
        if problem:
            return problem
    return ""


def starts(
    dock: Place,
    docked: Pose2,
    distances: Sequence[float],
    fault: Fault,
    *,
    slants: Sequence[float] = (0.0,),
    discs: Sequence[float] = (0.0,),
) -> list[Goal]:
    """Where the approach may begin, the best first; never none.

    They are so far from where it stands `docked` as one of the `distances` [m], on its line or on one turned by one of the
    `slants` [rad], and the body's `discs` have room there. Those from which it has room too at all lesser distances of
    the same line come first. Where none has room, the nearest on the line is left.
    """
    clear: list[Goal] = []
    narrow: list[Goal] = []
    for slant in slants:
        goals = {distance: before(dock, docked, distance, slant) for distance in distances}
        free = {far for far, goal in goals.items() if not body_fault(dock.name, goal, fault, discs)}
        for far in distances:
            if far in free:
                (clear if all(near in free for near in distances if near < far) else narrow).append(
                    goals[far]
                )
    return clear + narrow or [before(dock, docked, min(distances))]


class DockStarts:
    """From where one docking begins, one place after the other."""

    def __init__(self, goals: Callable[[Pose2], list[Goal]], *, varied: bool) -> None:
        """`goals` gives those for where it would stand docked, the best first, as `starts` does.

        `varied` where another place may do better; one that turns on the spot comes onto the line from the best as well as from any.
        """
        self._goals, self._varied = goals, varied
        self._begun: list[Goal] = []

    def forget(self) -> None:
        """It has begun nowhere yet."""
        self._begun = []

    def other(self, docked: Pose2) -> Goal | None:
        """The best one from where it has not begun yet; None when there is none left."""
        goals = self._goals(docked) if self._varied else self._goals(docked)[:1]
        goal = next((goal for goal in goals if not any(_same(goal, was) for was in self._begun)), None)
        if goal is not None:
            self._begun.append(goal)
        return goal

    def next(self, docked: Pose2) -> Goal:
        """The same; after the last the best again."""
        goal = self.other(docked)
        if goal is None:
            self.forget()
            goal = self._goals(docked)[0]
            self._begun.append(goal)
        return goal


def _same(one: Goal, other: Goal) -> bool:
    return math.hypot(one.x - other.x, one.y - other.y) <= ELSEWHERE
