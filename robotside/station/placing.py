"""Placement of the robot on its map by an operator."""

from __future__ import annotations

import math
from collections.abc import Callable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from robotside.autonomy.autonomy import Autonomy
from robotside.control.command_gate import CommandGate
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.records.events import Say
from robotside.station.fitness import Fitness

__all__ = ["Placing"]


class Placing:
    """Places the robot for who has control or takes it: tasks and the fence go by where the robot is."""

    def __init__(
        self,
        controls: CommandGate,
        autonomy: Autonomy,
        fitness: Fitness,
        say: Say,
        clock: Callable[[], float],
    ) -> None:
        """`clock` is the operators' [s]."""
        self._controls, self._autonomy, self._fitness = controls, autonomy, fitness
        self._say, self._clock = say, clock

    def place(self, client: Operator, pose: Pose2, *, certain: bool = False) -> Problem:
        """Take `pose` in `map` for where the robot is; an event says so, or why not, which is returned too."""
        problem = self._problem(client, pose)
        if problem:
            self._say("command", problem, "warn")
            return problem
        self._autonomy.place(pose, certain=certain)
        name, who = self._controls.name(client), self._controls.id(client)
        text = f"{name} placed the robot at ({pose.x:.1f}, {pose.y:.1f})."
        placed = Notice(Code.POSITION_PLACED, text, actor_id=who, name=name, x=pose.x, y=pose.y)
        self._say("localisation", placed, at=(pose.x, pose.y))
        return ""

    def choose(self, client: Operator, candidate: int) -> Problem:
        """Take the place of the robot's own `candidate`, by its number, for where the robot is; why not, empty when it is done."""
        known = self._autonomy.pose_estimator.candidates
        chosen = next((each for each in known if each.id == candidate), None)
        if chosen is None:
            numbers = ", ".join(str(each.id) for each in known) or "none"
            said = f"The robot has no candidate {candidate} for its place; it has {numbers}."
            if not candidate:  # numbers begin at 1: the request lacks its field
                said = f"The request lacks `id`, the number of a candidate for the robot's place; it has {numbers}."
            return Notice(Code.POSITION_CANDIDATE_UNKNOWN, said, candidate=candidate)
        return self.place(client, Pose2(chosen.x, chosen.y, chosen.yaw), certain=True)

    def _problem(self, client: Operator, pose: Pose2) -> Problem:
        if not all(map(math.isfinite, pose)):
            return Notice(Code.POSITION_INVALID, "The pose to place the robot at is not all numbers.")
        planner = self._autonomy.navigator.planner
        return (
            self._fitness.mapless
            or planner.off_map("The place", pose.x, pose.y)
            or self._controls.acquire(client, self._clock())  # last: what is refused takes no control
        )
