"""Where docking at a jetty is ticked by hand: a boat that turns only while its propeller works, carried by a stream, before a jetty that is where geometry has it."""

from __future__ import annotations

import math

import numpy as np
from py_trees.common import Status

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, Place
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.navigation.navigator import Goal, LegState
from robotside.perception.cage_finder import CageSighting, FrontView
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.berthing.dock_start import before
from robotside.tasks.berthing.jetty_docking import JettyDocking
from robotside.tasks.berthing.jetty_line import RECESS

__all__ = ["FRONT", "JETTY", "TICK", "Harbour"]

TICK = 0.05
FRONT = 0.425
"""From the boat's middle to its bow [m]."""
HALF = 0.23
"""Half its beam [m]."""
JETTY = Place(1, "Jetty", "dock", x=4.0, y=1.0, yaw=0.5)
"""As the map has it: where the boat is docked."""
SLOT, FINGERS, DECK = 0.42, 0.6, 1.1
"""Half the breadth between the fingers, their length, and half the breadth over all [m]."""


class Harbour:
    """The boat and its navigator in one, with all that moves it kept."""

    def __init__(
        self,
        off: Pose2 = ORIGIN,
        start: Pose2 = Pose2(-7.5, 0.0, 0.0),  # noqa: B008  # a tuple of numbers
        *,
        stream: tuple[float, float] = (0.0, 0.0),
        drift: tuple[float, float] = (0.0, 0.0),
        gives: int = 1,
    ) -> None:
        """The jetty lies `off` from where the map has it, and the boat begins at `start` in that frame, in which the `stream` is too.

        Its log errs by `drift` along its axes [m/s]. With contact the battery tells `gives`; 2 is no contact.
        """
        self.jetty = Pose2(JETTY.x, JETTY.y, JETTY.yaw).then(off)
        self.here = self.believed = self.jetty.then(start)
        turned = Pose2(0.0, 0.0, self.jetty.yaw).then(Pose2(*stream, 0.0))
        self.stream, self.drift = np.array(turned[:2]), drift
        self.surge, self.turning = 0.0, 0.0
        self.velocity = np.zeros(2)
        self.gives, self.hidden, self.stuck = gives, False, False
        self.reason, self.waits_for = "", ""
        self.touches: list[float] = []
        """How fast it was over ground, at each touch of the jetty [m/s]."""
        self.hits = 0
        """Touches that no report had said may come."""
        self.orders: list[Manoeuvre | Twist] = []
        self.goals: list[Goal] = []
        self._order: Manoeuvre | Twist = Manoeuvre(kind="rest")
        self._pressed = False
        self.situation = Situation()
        self.situation.power = 2

    def make(self) -> JettyDocking:
        place = Pose2(JETTY.x, JETTY.y, JETTY.yaw)
        course = Course([before(JETTY, place, 7.5)])
        course.index = 0
        return JettyDocking(
            JETTY,
            course,
            self,  # type: ignore[arg-type]  # what it calls of a navigator
            self.situation,
            self.look,
            FRONT,
            lambda docked: before(JETTY, docked, 7.5),
        )

    @property
    def within(self) -> Pose2:
        """The boat in the frame of where it is docked."""
        return self.here.since(self.jetty)

    @property
    def at_rest(self) -> bool:
        return isinstance(self._order, Manoeuvre) and self._order.kind == "rest"

    def look(self, view: FrontView) -> list[CageSighting]:
        tag = self.jetty.then(Pose2(FRONT + RECESS, 0.0, 0.0)).since(self.here)
        away = math.hypot(tag.x - 0.245, tag.y)
        seen = 0.5 < away < 5.5 and abs(math.atan2(tag.y, tag.x - 0.245)) < 0.6 and abs(tag.yaw) < 1.2
        return [CageSighting(tag, 0.2, 0.02, 0.3)] if seen and not self.hidden else []

    def head_for(self, goal: Goal) -> None:
        self.goals.append(goal)

    def update(self, pose: Pose2, points: object, now: float) -> LegState:
        goal = self.goals[-1]
        if math.hypot(goal.x - pose.x, goal.y - pose.y) < 1.0:
            return LegState.ARRIVED
        bearing = math.atan2(goal.y - pose.y, goal.x - pose.x)
        self.command(Manoeuvre(kind="course", yaw=bearing, speed=0.5))
        return LegState.UNDER_WAY

    def finish(self) -> None:
        self.rest()

    def rest(self) -> None:
        self._order = Manoeuvre(kind="rest")

    def command(self, order: Manoeuvre) -> None:
        self._order = order
        self.orders.append(order)

    def move(self, twist: Twist) -> None:
        self._order = twist
        self.orders.append(twist)

    def tick(self, tree: JettyDocking) -> Status:
        self._measure()
        tree.tick_once()
        self.situation.now += TICK
        self._go()
        return tree.status

    def run(self, tree: JettyDocking, seconds: float) -> Status:
        for _ in range(round(seconds / TICK)):
            if self.tick(tree) is not Status.RUNNING:
                break
        return tree.status

    def until(self, tree: JettyDocking, words: str, seconds: float = 200.0) -> None:
        """Until it says so."""
        for _ in range(round(seconds / TICK)):
            assert self.tick(tree) is Status.RUNNING, self.reason
            if self.situation.doing.text.startswith(words):
                return
        raise AssertionError(f"never: {words}")

    def alone(self, seconds: float) -> None:
        """The task is paused: boat at rest, behaviour not ticked."""
        self.rest()
        self.surge = 0.0
        self.situation.now += seconds
        self.situation.idle += seconds

    def _measure(self) -> None:
        now = self.situation
        now.pose = now.odom = self.believed
        cosine, sine = math.cos(self.here.yaw), math.sin(self.here.yaw)
        vx, vy = self.velocity
        now.moving = Pose2(
            cosine * vx + sine * vy + self.drift[0], cosine * vy - sine * vx + self.drift[1], self.turning
        )
        now.ahead = FrontView(b"", now.now, self.believed)
        now.battery_heard = now.now
        at = self.within
        meets = -0.15 <= at.x <= 0.06 and abs(at.y + FRONT * math.sin(at.yaw)) < 0.2 and abs(at.yaw) < 0.35
        now.power = self.gives if meets else 2
        now.charging = now.power == 1
        now.touched = self._pressed

    def _told(self) -> tuple[float, float]:
        """Speed through the water [m/s] and turn [rad/s] that the order wants."""
        order = self._order
        if isinstance(order, Twist):
            return order.linear.x, order.angular.z
        if order.kind == "course":
            off = wrap(order.yaw - self.here.yaw)
            kick = 0.25 if abs(off) > 0.05 and abs(order.speed) < 0.2 else order.speed
            return kick, max(-0.6, min(0.6, 0.9 * off))
        return (order.speed, 0.0) if order.kind == "steer" else (0.0, 0.0)

    def _go(self) -> None:
        """Propeller and rudder do what they are told, the rudder as far as water flows past it; the jetty stops it."""
        speed, turn = self._told()
        self.surge += 3.0 * TICK * (speed - self.surge)
        grip = min(1.0, 4.0 * max(0.05, abs(self.surge)))
        self.turning += 2.0 * TICK * (turn * grip - self.turning)
        yaw = wrap(self.here.yaw + self.turning * TICK)
        axis = np.array([math.cos(yaw), math.sin(yaw)])
        self.velocity = self.stream + self.surge * axis
        there = Pose2(self.here.x + self.velocity[0] * TICK, self.here.y + self.velocity[1] * TICK, yaw)
        if self.stuck or self._meets(there.since(self.jetty)):
            self._touch()
            there = Pose2(self.here.x, self.here.y, yaw)
            self.velocity[:] = 0.0
            self.surge = min(self.surge, 0.0)
        else:
            self._pressed = False
        self.here = there
        erred = Pose2(0.0, 0.0, yaw).then(Pose2(self.drift[0] * TICK, self.drift[1] * TICK, 0.0))
        self.believed = Pose2(
            self.believed.x + self.velocity[0] * TICK + erred.x,
            self.believed.y + self.velocity[1] * TICK + erred.y,
            yaw,
        )

    def _touch(self) -> None:
        if not self._pressed:
            self.touches.append(float(np.hypot(*self.velocity)))
            self.hits += not self.situation.touches
        self._pressed = True

    @staticmethod
    def _meets(at: Pose2) -> bool:
        """Its bow meets the deck or a finger."""
        for side in (-HALF, HALF):
            x = at.x + FRONT * (math.cos(at.yaw) - 1.0) - side * math.sin(at.yaw)
            y = at.y + FRONT * math.sin(at.yaw) + side * math.cos(at.yaw)
            if (x > 0.03 and abs(y) < DECK) or (x > -FINGERS and SLOT < abs(y) < DECK):
                return True
        return False
