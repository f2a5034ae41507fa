"""Where docking in a cage is ticked by hand: a robot that pushes only the way it looks and glides on, before a cage that is where geometry has it."""

from __future__ import annotations

import math

import numpy as np
from py_trees.common import Status

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.navigation.navigator import Goal, LegState
from robotside.perception.cage_finder import CageSighting, FrontView
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.cage_docking import ENTRANCE, CageDocking
from robotside.tasks.berthing.cage_line import TAG_ABOVE
from robotside.tasks.berthing.dock_start import before

__all__ = ["CAGE", "FRONT", "TICK", "Water"]

TICK = 0.05
FRONT = 0.3
"""From the robot's middle to its coil [m]."""
CAGE = Place(1, "Cage", "dock", x=4.0, y=1.0, yaw=0.5, height=-1.5)
"""As the map has it: where the robot is docked, and its depth."""
WITHIN, WALL = 0.15, 0.25
"""The coils meet so far aside [m]; the cage's walls leave so much to each side [m]."""


class Water:
    """The robot and its navigator in one, with all that moves it kept."""

    def __init__(
        self,
        off: Pose2 = ORIGIN,
        start: Pose2 = Pose2(-2.0, 0.0, 0.0),  # noqa: B008  # a tuple of numbers
        *,
        stream: tuple[float, float] = (0.0, 0.0),
        drift: tuple[float, float] = (0.0, 0.0),
        current: bool = True,
        deeper: float = 0.0,
    ) -> None:
        """The cage lies `off` from where the map has it, and the robot begins at `start` in that frame; the `stream` is in `map`.

        Its log errs by `drift` along its axes [m/s]. Without `current` its coils meet and give nothing; the cage is `deeper` than the map says [m].
        """
        self.cage = Pose2(CAGE.x, CAGE.y, CAGE.yaw).then(off)
        self.here = self.cage.then(start)
        self.believed = self.here
        self.z, self.depth = CAGE.height, CAGE.height - deeper
        self.velocity = np.zeros(2)
        self.stream, self.drift = np.array(stream), np.array(drift)
        self.current, self.hidden, self.meets = current, False, True
        self.mute = False
        """Its battery says nothing."""
        self.reason, self.waits_for = "", ""
        self.hits = 0
        """Times that its body met the cage's walls."""
        self.entered: list[float] = []
        """How far off the line it went in, each time [m]."""
        self.orders: list[Manoeuvre] = []
        self.heights = (-3.0, 0.0)
        self.kept_height = math.nan
        self._order = Manoeuvre(kind="rest")
        self._goal: Goal | None = None
        self._yaw = self.here.yaw
        self.situation = Situation()
        self.situation.power = 2

    def make(self) -> CageDocking:
        course = Course([before(CAGE, Pose2(CAGE.x, CAGE.y, CAGE.yaw), 2.0)])
        course.index = 0
        return CageDocking(CAGE, course, self, self.situation, self.look, FRONT)  # type: ignore[arg-type]  # what it calls of a navigator

    @property
    def within(self) -> Pose2:
        """The robot in the frame of where it is docked."""
        return self.here.since(self.cage)

    def look(self, view: FrontView) -> list[CageSighting]:
        coil = self.cage.then(Pose2(FRONT, 0.0, 0.0)).since(self.here)
        away = coil.x - FRONT
        seen = 0.5 < away < 3.5 and abs(math.atan2(coil.y, away)) < 0.6 and abs(coil.yaw) < 1.2
        rise = self.depth + TAG_ABOVE - self.z
        if self.hidden or not seen or abs(rise) > 0.5 * away:
            return []
        return [CageSighting(coil, rise, 0.02, 0.1)]

    @property
    def view(self) -> FrontView:
        return FrontView(b"", self.situation.now, self.believed, 0.0, 0.0, self.z)

    @property
    def height(self) -> float:
        return self.z

    def keep_height(self, height: float) -> None:
        self.kept_height = height

    def head_for(self, goal: Goal) -> None:
        self._goal = goal

    def update(self, pose: Pose2, points: object, now: float) -> LegState:
        assert self._goal is not None
        if math.hypot(self._goal.x - pose.x, self._goal.y - pose.y) < 0.4:
            return LegState.ARRIVED
        bearing = math.atan2(self._goal.y - pose.y, self._goal.x - pose.x)
        turned = abs(wrap(bearing - pose.yaw)) > 0.6
        self.command(
            Manoeuvre(kind="course", yaw=bearing, speed=0.0 if turned else 0.3, height=self.kept_height)
        )
        return LegState.UNDER_WAY

    def finish(self) -> None:
        self.rest()
        self._goal = None

    def rest(self) -> None:
        self._order = Manoeuvre(kind="rest")

    def command(self, order: Manoeuvre) -> None:
        self._order = order
        self.orders.append(order)

    def tick(self, tree: CageDocking) -> Status:
        self._measure()
        tree.tick_once()
        self.situation.now += TICK
        self._go()
        return tree.status

    def run(self, tree: CageDocking, seconds: float) -> Status:
        for _ in range(round(seconds / TICK)):
            if self.tick(tree) is not Status.RUNNING:
                break
        return tree.status

    def until(self, tree: CageDocking, words: str, seconds: float = 200.0) -> None:
        """Until it says so."""
        for _ in range(round(seconds / TICK)):
            assert self.tick(tree) is Status.RUNNING
            if self.situation.doing.text.startswith(words):
                return
        raise AssertionError(f"never: {words}")

    def alone(self, tree: CageDocking, seconds: float) -> None:
        """The task is paused: robot at rest, behaviour not ticked."""
        self.rest()
        self.velocity[:] = 0.0
        self.situation.now += seconds
        self.situation.idle += seconds

    def _measure(self) -> None:
        now = self.situation
        now.pose = now.odom = self.believed
        cosine, sine = math.cos(self.here.yaw), math.sin(self.here.yaw)
        vx, vy = self.velocity
        ahead, left = cosine * vx + sine * vy, cosine * vy - sine * vx
        now.moving = Pose2(ahead + self.drift[0], left + self.drift[1], 0.0)
        now.ahead = self.view
        at = self.within
        nose = at.y + FRONT * math.sin(at.yaw)
        met = (
            -0.15 <= at.x <= 0.06 and abs(nose) < WITHIN and abs(self.z - self.depth) < WITHIN and self.meets
        )
        if not self.mute:
            now.power = (1 if self.current else 3) if met else 2
            now.charging, now.battery_heard = now.power == 1, now.now

    def _go(self) -> None:
        """Its axis takes on the speed that is told, its side only loses what drag takes; walls stop it."""
        order, before_x = self._order, self.within.x
        if order.kind in ("course", "hover"):
            self._yaw = self._yaw if math.isnan(order.yaw) else order.yaw
            wanted = self.z if math.isnan(order.height) else order.height
            self.z += max(-0.2, min(0.2, wanted - self.z)) * TICK
        turn = max(-0.6, min(0.6, 1.5 * wrap(self._yaw - self.here.yaw)))
        yaw = wrap(self.here.yaw + turn * TICK)
        axis, side = np.array([math.cos(yaw), math.sin(yaw)]), np.array([-math.sin(yaw), math.cos(yaw)])
        through = self.velocity - self.stream
        surge, sway = float(axis @ through), float(side @ through)
        told = order.speed if order.kind == "course" and not math.isnan(order.speed) else 0.0
        surge += (0.7 * (told - surge) + 0.6 * (abs(told) * told - abs(surge) * surge)) * TICK
        sway -= abs(sway) * sway / 0.7 * TICK
        self.velocity = self.stream + surge * axis + sway * side
        x, y = self.here.x + self.velocity[0] * TICK, self.here.y + self.velocity[1] * TICK
        there = Pose2(x, y, yaw).since(self.cage)
        inside = there.x > -ENTRANCE and abs(there.y) > WALL
        if inside or there.x > 0.05:
            self.hits += inside and np.hypot(*self.velocity) > 0.02
            self.velocity[:] = 0.0
            x, y = self.here.x, self.here.y
        if before_x <= -ENTRANCE < there.x:
            self.entered.append(abs(there.y))
        self.here = Pose2(x, y, yaw)
        erred = Pose2(0.0, 0.0, yaw).then(Pose2(self.drift[0] * TICK, self.drift[1] * TICK, 0.0))
        self.believed = Pose2(
            self.believed.x + self.velocity[0] * TICK + erred.x,
            self.believed.y + self.velocity[1] * TICK + erred.y,
            yaw,
        )
