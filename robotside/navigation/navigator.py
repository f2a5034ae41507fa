"""The navigator: it plans a path, follows it, avoids obstacles, plans again, and notices when it is stuck."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

import numpy as np

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Points, Pose2
from robotside.core.robot import Manoeuvrable, Robot
from robotside.core.text import place_sentence
from robotside.core.worker import InLoopWorker, Worker
from robotside.kinds.registry import kind_of
from robotside.mapping.obstacle_memory import ObstacleMemory
from robotside.mapping.occupancy_grid import Grid
from robotside.motion.stopping_path import REST, PlanarVelocity, reach
from robotside.navigation.ackermann_controller import AckermannController, girth
from robotside.navigation.course_controller import CourseController
from robotside.navigation.differential_controller import DifferentialController
from robotside.navigation.path_controller import CRUISE_SHARE, UNSURE_SPEED, PathController
from robotside.navigation.planner import STEP, Planner, Unreachable
from robotside.navigation.way_search import WaySearch

__all__ = ["CRUISE_SHARE", "UNSURE_SPEED", "Goal", "Navigator", "LegState"]

REPLAN_PERIOD = 1.0
"""Least time between two plans [s]."""

STUCK_TIMEOUT = 10.0
"""Without getting 0.1 m nearer or turning for this long, the way is blocked [s]."""

READY_TIMEOUT = 20.0
"""To get ready to go [s]."""

MAX_STUCK = 3
"""Times stuck on one leg before it is given up."""


class LegState(Enum):
    """The state of the way to the goal."""

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


PATH_CONTROLLERS: dict[str, Callable[[Robot], PathController]] = {
    "differential": DifferentialController,
    "lattice": AckermannController,
    "course": CourseController,
}
"""The path controllers, by `path_controller` of the robot's kind."""


def path_controller_of(robot: Robot) -> PathController:
    """The path controller of the robot's kind."""
    return PATH_CONTROLLERS[kind_of(robot.info.kind).path_controller](robot)


def required_radius(info: RobotInfo) -> float:
    """The room that a robot needs round its place, whichever way it points [m]."""
    return girth(info) if kind_of(info.kind).path_controller == "lattice" else info.radius


class Navigator:
    """Drives one robot on one map."""

    def __init__(
        self, robot: Robot, grid: Grid, show: Callable[[Points], None], worker: Worker | None = None
    ) -> None:
        """`worker` looks for ways; without one it is done in `update`, a bit in each."""
        info = robot.info
        self._robot, self._show = robot, show
        self.kind = info.kind
        """Of robot, as its information calls it."""
        self.controller: PathController = path_controller_of(robot)
        """Follows the path."""
        self._radius = required_radius(info)
        cruising = PlanarVelocity(self.controller.cruise, 0.0, 0.0)
        self._stopping_distance = reach(cruising, REST, kind_of(info.kind).handling) + self.controller.clear
        self._search = WaySearch(self.controller, worker or InLoopWorker())
        self.set_map(self.planner_on(grid))
        self._goal: Goal | None = None
        self.reason: Problem = ""
        """Why the way is blocked, as one sentence; empty when it is not."""
        self.waits_for = ""
        """What it does before it can go, as one sentence; empty when it goes."""
        self.sure = True
        """The position is trusted; otherwise it creeps."""
        self._turning = False
        self._waits_since = math.inf
        self._planned = self._moved = -math.inf
        self._best = math.inf
        self._stuck = 0

    def planner_on(self, grid: Grid) -> Planner:
        """For `set_map`: what takes its time on a large map, and may be done in another thread."""
        return Planner(grid, self._radius)

    def set_map(self, planner: Planner) -> None:
        """Plan by `planner` on its map from now on; only between two tasks."""
        self._search.drop()
        self.planner = planner
        """Plans paths on the map."""
        self.obstacles = ObstacleMemory(planner.map)
        """Obstacles that the map does not show."""

    @property
    def remaining(self) -> float:
        """Along the path to the goal [m]; NaN without one."""
        return self._left

    _left = math.nan

    @property
    def cruise(self) -> float:
        """The speed that it travels with [m/s]."""
        return self.controller.cruise

    @property
    def radius(self) -> float:
        """Of the room that the robot needs round its place [m]."""
        return self._radius

    @property
    def planning(self) -> bool:
        """It stands and looks for a way."""
        return self._search.active

    @property
    def turning(self) -> bool:
        """It is there and turns to the direction asked for."""
        return self._turning

    def move(self, twist: Twist) -> None:
        """Move so until the next order, `update` or `rest`, with no one but the caller avoiding obstacles."""
        self._robot.drive(twist)

    def measured(self, height: float) -> None:
        """The robot is at a `height` above the map's origin [m]."""
        self.controller.measured = height

    def flies(self, phase: str) -> None:
        """Take over the phase of flight of a robot that flies, as in `FlightState`."""
        self.controller.aloft = phase in ("flying", "landing")

    @property
    def height(self) -> float:
        """Of the robot above the map's origin [m]; NaN while not known."""
        return self.controller.measured

    def keep_height(self, height: float) -> None:
        """Go at a `height` above the map's origin [m] from now on; NaN for the one that it is at."""
        self.controller.height = height

    def take_off(self, height: float) -> None:
        """Rise from the ground to a `height` above the map's origin [m], NaN for the usual one."""
        self.controller.take_off(height)

    def command(self, manoeuvre: Manoeuvre) -> None:
        """The same for what a twist does not say, of a robot that knows manoeuvres; others stay as they are."""
        if isinstance(self._robot, Manoeuvrable):
            self._robot.manoeuvre(manoeuvre)

    def head_for(self, goal: Goal) -> None:
        """Begin a new leg; the path is planned with the next `update`."""
        self._goal, self.reason = goal, ""
        self.controller.forget()
        self._search.drop()
        self._waits_since = math.inf
        self._stuck, self._left, self._moved = 0, math.nan, -math.inf

    def rest(self) -> None:
        """Stand still and forget the path; a leg that goes on later is planned from wherever it is then."""
        self._robot.stop()
        self.controller.forget()
        self._search.drop()
        self._waits_since = math.inf
        self._left = math.nan
        self._moved = -math.inf

    def finish(self) -> None:
        """Stand still; there is no goal any more."""
        self.rest()
        self._goal = None
        self._show(np.empty((0, 2)))

    def update(self, pose: Pose2, points: Points, now: float) -> LegState:
        """Drive on from `pose`, with the laser seeing `points` (in `base_link`); call it often."""
        goal = self._goal
        self._turning = False
        if goal is None:
            return LegState.ARRIVED
        controller = self.controller
        self.waits_for = self.ready(now)
        if self.waits_for:
            return LegState.BLOCKED if self.reason else LegState.UNDER_WAY
        if not controller.under_way and not self.planning:
            self._ask(now)
        looks = self.planning and not self._search_on(pose, goal, now)
        if looks and (controller.stands or not controller.under_way):
            self._robot.stop()  # it may be rolling still, with no way to roll along
            return LegState.BLOCKED if self.reason else LegState.UNDER_WAY
        if controller.arrived(pose):
            return self._face(pose, goal)
        self._left = controller.remaining(pose)
        if not self._progresses(pose, now):
            return LegState.BLOCKED
        if now - self._planned >= REPLAN_PERIOD and self._in_the_way(now, controller.look):
            self._ask(now)
        if self.planning and not looks:
            looks = not self._search_on(pose, goal, now)
        if not looks or not controller.stands:
            self._steer(pose, points, now)
        return LegState.UNDER_WAY

    def _steer(self, pose: Pose2, points: Points, now: float) -> None:
        """Go on along the way, unless something new is so near on it that only its controller could keep off it."""
        if not self.controller.avoids and self._in_the_way(now, self._stopping_distance):
            self._robot.stop()
        else:
            self.controller.steer(pose, points, sure=self.sure)

    def ready(self, now: float) -> str:
        """Get ready to go: what it does for that, as one sentence, empty when it goes. After too long there is a `reason`."""
        waits = self.controller.ready()
        if not waits:
            self._waits_since = math.inf
            return ""
        self._waits_since = min(self._waits_since, now)
        if now - self._waits_since > READY_TIMEOUT:
            said = f"{waits[:-1]} took longer than {READY_TIMEOUT:.0f} s; the robot stays where it is."
            self.reason = Notice(Code.TASK_SLOW, said, seconds=READY_TIMEOUT)
        return waits

    def _ask(self, now: float) -> None:
        """A way is to be looked for; what cannot do that on the way stands for it."""
        self._search.ask(now)
        if self.controller.stands:
            self._robot.stop()

    def _search_on(self, pose: Pose2, goal: Goal, now: float) -> bool:
        """Have the way looked for that was asked for; True when there is one to go on."""
        at = (goal.x, goal.y, goal.yaw)
        try:
            way = self._search.poll(
                self.planner, pose, at, goal.name, lambda: self.obstacles.points(now), now
            )
            if way is None:
                return False
            self.controller.follow(way)
            self._left = self.controller.remaining(pose)
            self._show(np.concatenate([piece.points for piece in way]))
        except Unreachable as problem:
            # an old path stays; standing still on it is noticed
            self.reason = "" if self.controller.under_way else Notice(Code.WAY_MISSING, str(problem))
        self._moved += now - self._search.asked
        self._planned = now
        self._search.drop()
        return self.controller.under_way

    def _in_the_way(self, now: float, look: float) -> bool:
        """Something new is in the way that it has, nearer than `look` [m] along it."""
        ahead = self.controller.ahead[: int(look / STEP)]
        return bool(len(self.obstacles.near(ahead, self.controller.clear, now)))

    def _face(self, pose: Pose2, goal: Goal) -> LegState:
        """At the place: turn to the direction asked for, if any."""
        self._left = 0.0
        if math.isnan(goal.yaw) or self.controller.face(pose, goal.yaw):
            return LegState.ARRIVED
        self._turning = True
        return LegState.UNDER_WAY

    def _progresses(self, pose: Pose2, now: float) -> bool:
        """False when it has stood too long, after some plans anew; `reason` says where."""
        if self._moved == -math.inf or self._left < self._best - 0.1:
            self._moved, self._best = now, self._left
            return True
        if now - self._moved < STUCK_TIMEOUT:
            return True
        self._stuck += 1
        self._moved = now
        if self._stuck < MAX_STUCK and self._goal:
            self._best = math.inf
            self._ask(now)
            return True
        name = self._goal.name if self._goal else "the goal"
        where = f"({pose.x:.1f}, {pose.y:.1f})"
        said = f"Stuck at {where}: the way to {place_sentence(name, *self._at())} is blocked."
        self.reason = Notice(Code.WAY_BLOCKED, said, place=name, x=pose.x, y=pose.y)
        return False

    def _at(self) -> tuple[float, float]:
        return (self._goal.x, self._goal.y) if self._goal else (math.nan, math.nan)
