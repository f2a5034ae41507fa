"""Bringing the robot to a place: plans the way, follows it, evades, plans anew, and knows when it is stuck."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

import numpy as np

from bridge.msgs.geometry_msgs import Twist
from robotside.avoidance import Avoidance
from robotside.follow import Follower
from robotside.grid import Grid
from robotside.obstacles import Obstacles
from robotside.planner import Planner, Unreachable, place_sentence
from robotside.pose2 import Points, Pose2
from robotside.robot import Robot

__all__ = ["Goal", "Guide", "Leg"]

CRUISE = 0.9
"""Part of the robot's greatest speed that it travels with by itself."""

UNSURE_SPEED = 0.15
"""Speed while the position is unsure [m/s]."""

LOOK = 6.0
"""How far along the path something new makes it plan anew [m]."""

REPLAN = 1.0
"""Least time between two plans [s]."""

STUCK = 10.0
"""Without getting 0.1 m nearer or turning for this long, the way is blocked [s]."""

GIVE_UP = 3
"""Times stuck on one leg before it is given up."""


class Leg(Enum):
    """How the way to the goal stands."""

    UNDER_WAY = "under way"
    ARRIVED = "arrived"
    BLOCKED = "blocked"


class Goal:
    """A place to go to."""

    def __init__(self, name: str, x: float, y: float, yaw: float = math.nan, place: str = "") -> None:
        self.name = name
        """As a sentence begins with it: `Point 3`."""
        self.place = place
        """The name that people gave to it; empty when it has none."""
        self.x, self.y = x, y
        """In `map` [m]."""
        self.yaw = yaw
        """Direction to stand in [rad]; NaN when any will do."""

    @property
    def spoken(self) -> str:
        """As it stands within a sentence: `point 3`, but `Office 12`."""
        name = self.name.rstrip(",")
        return name if name == self.place else f"{name[0].lower()}{name[1:]}"


class Guide:
    """Drives one robot on one map."""

    def __init__(self, robot: Robot, grid: Grid, show: Callable[[Points], None]) -> None:
        info = robot.info
        self._robot, self._show = robot, show
        self._radius = info.radius
        self.take_map(grid)
        self._avoidance = Avoidance(info.radius, max_yaw_rate=info.max_yaw_rate)
        self._clear = info.radius + 0.18
        self._cruise, self._turn = CRUISE * info.max_speed, info.max_yaw_rate
        self._follower: Follower | None = None
        self._goal: Goal | None = None
        self.reason = ""
        """Why the way is blocked, as one sentence; empty when it is not."""
        self.sure = True
        """The position is trusted; otherwise it creeps."""
        self._turning = False
        self._speed = 0.0
        self._planned = self._moved = -math.inf
        self._best = math.inf
        self._stuck = 0

    def take_map(self, grid: Grid) -> None:
        """Plan on `grid` from now on; only between two tasks."""
        self.planner = Planner(grid, self._radius)
        """What plans the ways on the map."""
        self.obstacles = Obstacles(grid)
        """What was seen that is not on the map."""

    @property
    def remaining(self) -> float:
        """Along the path to the goal [m]; NaN without one."""
        return self._left

    _left = math.nan

    @property
    def cruise(self) -> float:
        """The speed that it travels with [m/s]."""
        return self._cruise

    @property
    def radius(self) -> float:
        """Of the robot [m]."""
        return self._radius

    @property
    def turning(self) -> bool:
        """It is there and turns to the direction asked for."""
        return self._turning

    def move(self, twist: Twist) -> None:
        """Move so until the next `move`, `update` or `rest`, with nobody looking for obstacles but the caller."""
        self._robot.drive(twist)

    def head_for(self, goal: Goal) -> None:
        """Begin a new leg; the path is planned with the next `update`."""
        self._goal, self._follower, self.reason = goal, None, ""
        self._stuck, self._left, self._moved = 0, math.nan, -math.inf

    def rest(self) -> None:
        """Stand still and forget the path; a leg that goes on later is planned from wherever it is then."""
        self._robot.stop()
        self._follower, self._speed, self._left = None, 0.0, math.nan
        self._moved = -math.inf

    def finish(self) -> None:
        """Stand still; there is no goal any more."""
        self.rest()
        self._goal = None
        self._show(np.empty((0, 2)))

    def update(self, pose: Pose2, points: Points, now: float) -> Leg:
        """Drive on from `pose`, with the laser seeing `points` (in `base_link`); call it often."""
        goal = self._goal
        self._turning = False
        if goal is None:
            return Leg.ARRIVED
        if self._follower is None and not self._plan(pose, goal, now):
            return Leg.BLOCKED
        follower = self._follower
        if follower is None:
            return Leg.BLOCKED
        if follower.arrived(pose):
            return self._face(pose, goal)
        self._left = follower.remaining(pose)
        if not self._progresses(pose, now):
            return Leg.BLOCKED
        self._steer(follower, pose, points, now)
        return Leg.UNDER_WAY

    def _plan(self, pose: Pose2, goal: Goal, now: float) -> bool:
        self._planned = now
        known = self.obstacles.points(now)
        here, there = (pose.x, pose.y), (goal.x, goal.y)
        try:
            path = self.planner.plan(here, there, goal.name, known)
        except Unreachable as problem:
            self.reason = str(problem)
            return False
        self._follower = Follower(path, cruise=self._cruise)
        self._left = self._follower.length
        self._show(path)
        return True

    def _steer(self, follower: Follower, pose: Pose2, points: Points, now: float) -> None:
        distance, bearing = follower.aim(pose, self._speed)
        if now - self._planned >= REPLAN and self._in_the_way(follower, now):
            self._replan(pose, now)
        cruise = follower.speed(pose, bearing, distance)
        speed = cruise if self.sure else min(cruise, UNSURE_SPEED)
        way = self._avoidance.choose(distance, bearing, min(speed, self._speed + 0.08), points)
        self._speed = way.twist.linear.x
        self._robot.drive(way.twist)

    def _in_the_way(self, follower: Follower, now: float) -> bool:
        ahead = follower.ahead[: int(LOOK / 0.1)]
        return bool(len(self.obstacles.near(ahead, self._clear, now)))

    def _replan(self, pose: Pose2, now: float) -> None:
        if self._goal and not self._plan(pose, self._goal, now):
            self.reason = ""  # the old path stays; standing still on it is noticed

    def _face(self, pose: Pose2, goal: Goal) -> Leg:
        """At the place: turn to the direction asked for, if any."""
        error = 0.0 if math.isnan(goal.yaw) else math.remainder(goal.yaw - pose.yaw, math.tau)
        if abs(error) < 0.05:
            self._left = 0.0
            return Leg.ARRIVED
        rate = math.copysign(min(0.6 * self._turn, max(0.15, 1.5 * abs(error))), error)
        self._turning, self._left = True, 0.0
        self._robot.drive(Twist.planar(0.0, rate))
        return Leg.UNDER_WAY

    def _progresses(self, pose: Pose2, now: float) -> bool:
        """False when it has stood too long, after some plans anew; `reason` says where."""
        if self._moved == -math.inf or self._left < self._best - 0.1:
            self._moved, self._best = now, self._left
            return True
        if now - self._moved < STUCK:
            return True
        self._stuck += 1
        self._moved = now
        if self._stuck < GIVE_UP and self._goal:
            self._best = math.inf
            self._replan(pose, now)
            return True
        name = self._goal.name if self._goal else "the goal"
        self.reason = f"Stuck at ({pose.x:.1f}, {pose.y:.1f}): the way to {place_sentence(name, *self._at())} is blocked."
        return False

    def _at(self) -> tuple[float, float]:
        return (self._goal.x, self._goal.y) if self._goal else (math.nan, math.nan)
