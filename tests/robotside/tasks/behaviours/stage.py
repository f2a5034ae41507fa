"""Where behaviours are ticked by hand, with a robot that moves exactly as told."""

from __future__ import annotations

import random
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Mission
from robotside.core.pose2 import Pose2
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.patrol import patrol, patrol_course
from robotside.tasks.behaviours.situation import Situation
from tests.fakes import Box, FakeRobot, Pillar

__all__ = ["Stage"]


class Stage:
    """Robot, guide and situation, with time in hand and all that is said kept."""

    def __init__(self, *boxes: Box, pillars: tuple[Pillar, ...] = ()) -> None:
        self.robot = FakeRobot(boxes=boxes, pillars=pillars)
        self.situation = Situation()
        self.navigator = Navigator(self.robot, Grid.from_msg(self.robot.map()), lambda _: None)
        self.said: list[str] = []
        self.fault: Callable[[float, float], str] = lambda x, y: self.navigator.planner.fault("It", x, y)
        list(self.robot.read(0.0))

    def say(
        self, kind: str, text: str, level: str = "info", *, at: tuple[float, float] | None = None
    ) -> None:
        self.said.append(text)

    def patrol(self, mission: Mission) -> tuple[Course, Behaviour]:
        course = patrol_course(mission, random.Random(3))
        tree = patrol(course, self.navigator, self.situation, self.say, self.fault)
        return course, tree

    def tick(self, tree: Behaviour, seconds: float = 0.05) -> Status:
        """Go on for a while, or until the tree has come to its end."""
        for _ in range(round(seconds / 0.05)):
            self.situation.pose = Pose2(*self.robot.pose)
            tree.tick_once()
            self.situation.forget_confirmation()
            self.situation.now += 0.05
            list(self.robot.read(self.situation.now))
            if tree.status is not Status.RUNNING:
                break
        return tree.status

    def pause(self, seconds: float) -> None:
        """Let time pass with the task paused."""
        self.navigator.rest()
        self.situation.now += seconds
        self.situation.idle += seconds
        list(self.robot.read(self.situation.now))

    @property
    def phase(self) -> str:
        return self.situation.doing.phase
