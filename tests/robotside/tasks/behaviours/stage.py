"""Where behaviours are ticked by hand, with a robot that moves exactly as told."""

from __future__ import annotations

import random
from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Bumper, Mission
from bridge.msgs.sensor_msgs import BatteryState, LaserScan
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Navigator
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.patrol import patrol, patrol_course
from robotside.tasks.behaviours.situation import Situation
from tests.fakes import Box, FakeRobot, Pillar

__all__ = ["Stage"]


class Stage:
    """Robot, guide and situation, with time in hand and all that is said kept."""

    def __init__(self, *boxes: Box, pillars: tuple[Pillar, ...] = (), robot: FakeRobot | None = None) -> None:
        self.robot = robot or FakeRobot(boxes=boxes, pillars=pillars)
        self.off = ORIGIN
        """The error of where it believes to be, in its own frame."""
        self.mute = False
        """Its battery is silent."""
        self.blind = False
        """It has no laser."""
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
            self.situation.pose = Pose2(*self.robot.pose).then(self.off)
            tree.tick_once()
            self.situation.forget_confirmation()
            self.situation.now += 0.05
            self._hear()
            if tree.status is not Status.RUNNING:
                break
        return tree.status

    def pause(self, seconds: float) -> None:
        """Let time pass with the task paused."""
        self.navigator.rest()
        self.situation.now += seconds
        self.situation.idle += seconds
        list(self.robot.read(self.situation.now))
        self.situation.battery_heard = self.situation.now

    def _hear(self) -> None:
        """Take in what it measures that docking goes by."""
        here = self.situation
        for _, msg in self.robot.read(here.now):
            if isinstance(msg, Odometry):
                here.odom = Pose2.from_msg(msg.pose.pose)
            elif isinstance(msg, LaserScan) and not self.blind:
                here.scan, here.swept = msg, here.odom
                here.points = LaserProjection().points(msg)
            elif isinstance(msg, BatteryState) and not self.mute:
                here.battery_heard = here.now
                if self.robot.dock is None:
                    continue
                here.power = here.last_power = msg.power_supply_status
                here.charging = here.power in (1, 4)
            elif isinstance(msg, Bumper) and self.robot.dock is not None:
                here.touched = msg.pressed

    @property
    def phase(self) -> str:
        return self.situation.doing.phase
