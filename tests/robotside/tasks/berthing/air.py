"""Where landing is ticked by hand: a robot in still air that moves exactly as told, over a pad that is where geometry has it."""

from __future__ import annotations

import math

from py_trees.common import Status

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.pose2 import Pose2
from robotside.navigation.navigator import Goal, LegState
from robotside.perception.pad_finder import GroundView
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.pad_landing import PadLanding, first_goal

__all__ = ["PAD", "TICK", "Air"]

TICK = 0.05
PAD = Place(1, "Pad", "dock", x=4.0, y=1.0)
"""As the map has it."""

SINKING = 0.4
"""Of a robot that lands [m/s]."""

VIEW = 0.33
"""Half of what its picture shows, for each metre of height."""


class Air:
    """The robot and its navigator in one, with all that moves it kept."""

    def __init__(self, off: tuple[float, float] = (0.0, 0.0), *, current: bool = True) -> None:
        """The pad lies `off` from where the map has it [m]; without `current` its contacts meet and give nothing."""
        self.x = self.y = self.z = 0.0
        self.pad = (PAD.x + off[0], PAD.y + off[1])
        self.current, self.reach, self.hidden = current, 0.25, False
        self.mute = False
        """Its battery says nothing."""
        self.flight, self.reason, self.waits_for = "landed", "", ""
        self.landings: list[float] = []
        """How far from the middle of the pad it came down, each time [m]."""
        self.lowest_unseen = math.inf
        """The lowest at which it went down by an order while no pad was in its picture [m]."""
        self.walls: list[tuple[float, float, float]] = []
        """Round things on the map: x, y and radius [m]."""
        self._goal: Goal | None = None
        self._twist, self._rises = Twist(), math.nan
        self.situation = Situation()
        self.situation.power = 2

    def make(self) -> PadLanding:
        course = Course([first_goal(PAD, self.fault)])
        course.index = 0
        return PadLanding(PAD, course, self, self.situation, self.find, self.fault)  # type: ignore[arg-type]  # what it calls of a navigator

    def fault(self, name: str, x: float, y: float) -> str:
        inside = any(math.hypot(x - a, y - b) < radius for a, b, radius in self.walls)
        return f"{name} is in a wall." if inside else ""

    @property
    def off(self) -> float:
        return math.hypot(self.x - self.pad[0], self.y - self.pad[1])

    @property
    def seen(self) -> bool:
        return not self.hidden and self.off < VIEW * self.z

    def find(self, view: GroundView) -> Pose2 | None:
        return Pose2(self.pad[0] - self.x, self.pad[1] - self.y, 0.0) if self.seen else None

    @property
    def height(self) -> float:
        return self.z

    def head_for(self, goal: Goal) -> None:
        self._goal = goal

    def update(self, pose: Pose2, points: object, now: float) -> LegState:
        self.waits_for = "" if self.flight == "flying" else "Taking off."
        if self.waits_for:
            self.take_off(2.0)
            return LegState.UNDER_WAY
        assert self._goal is not None
        away = math.hypot(self._goal.x - self.x, self._goal.y - self.y)
        if away < 0.3:
            return LegState.ARRIVED
        share = min(1.0, away) / away
        ahead, left = share * (self._goal.x - self.x), share * (self._goal.y - self.y)
        self._twist = Twist(Vector3(ahead, left))
        return LegState.UNDER_WAY

    def finish(self) -> None:
        self.rest()
        self._goal = None

    def rest(self) -> None:
        self._twist, self._rises = Twist(), math.nan
        if self.flight == "landing":
            self.flight = "flying"

    def move(self, twist: Twist) -> None:
        self._twist = twist
        if twist.linear.z < 0 and not self.seen:
            self.lowest_unseen = min(self.lowest_unseen, self.z)

    def command(self, order: Manoeuvre) -> None:
        assert order.kind == "land"
        if self.flight == "flying":
            self.flight = "landing"

    def take_off(self, height: float) -> None:
        if self.flight == "landed":
            self.flight, self._rises = "taking_off", height

    def tick(self, tree: PadLanding) -> Status:
        self._measure()
        tree.tick_once()
        self.situation.now += TICK
        self._go()
        return tree.status

    def run(self, tree: PadLanding, seconds: float) -> Status:
        for _ in range(round(seconds / TICK)):
            if self.tick(tree) is not Status.RUNNING:
                break
        return tree.status

    def until(self, tree: PadLanding, words: str, seconds: float = 120.0) -> None:
        """Until it says so."""
        for _ in range(round(seconds / TICK)):
            assert self.tick(tree) is Status.RUNNING
            if self.situation.doing.text.startswith(words):
                return
        raise AssertionError(f"never: {words}")

    def alone(self, tree: PadLanding, seconds: float) -> None:
        """The task is paused: robot at rest, behaviour not ticked."""
        self.rest()
        self.situation.now += seconds
        self.situation.idle += seconds

    def _measure(self) -> None:
        here = self.situation
        here.pose = here.odom = Pose2(self.x, self.y, 0.0)
        here.below, here.flight = self.z, self.flight
        here.ground = GroundView(b"", here.now, here.odom, 0.0, 0.0, self.z)
        met = self.flight == "landed" and self.off < self.reach
        if not self.mute:
            here.power = (1 if self.current else 3) if met else 2
            here.charging, here.battery_heard = here.power == 1, here.now

    def _go(self) -> None:
        if self.flight == "taking_off":
            self.z = min(self._rises, self.z + 0.5 * TICK)
            if self.z >= self._rises:
                self.flight = "flying"
        elif self.flight == "landing":
            self.z = max(0.0, self.z - SINKING * TICK)
            if self.z == 0.0:
                self.flight = "landed"
                self.landings.append(self.off)
        elif self.flight == "flying":
            v = self._twist.linear
            self.x, self.y, self.z = self.x + v.x * TICK, self.y + v.y * TICK, max(0.0, self.z + v.z * TICK)
