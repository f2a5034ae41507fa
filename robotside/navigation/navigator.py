"""The navigator: it plans a path, follows it, avoids obstacles, plans again, and notices when it is stuck."""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import Enum

import numpy as np

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Points, Pose2
from robotside.core.robot import Robot
from robotside.core.text import place_sentence
from robotside.core.worker import InLoopWorker, Worker
from robotside.kinds.registry import kind_of
from robotside.mapping.obstacle_memory import ObstacleMemory
from robotside.mapping.occupancy_grid import Grid
from robotside.motion.stopping_path import REST, PlanarVelocity, reach
from robotside.navigation.ackermann_controller import AckermannController, girth
from robotside.navigation.arrival_check import ArrivalCheck
from robotside.navigation.course_controller import CourseController
from robotside.navigation.differential_controller import DifferentialController
from robotside.navigation.height_orders import HeightOrders
from robotside.navigation.path_controller import CRUISE_SHARE, UNSURE_SPEED, PathController
from robotside.navigation.planner import CLEARANCE, STEP, Planner, Unreachable
from robotside.navigation.progress_watch import ProgressWatch, ReadyWatch
from robotside.navigation.way_search import WaySearch
from robotside.navigation.way_wait import WayWait

__all__ = ["CRUISE_SHARE", "UNSURE_SPEED", "Goal", "Navigator", "LegState"]

REPLAN_PERIOD = 1.0
"""Least time between two plans [s]."""


class LegState(Enum):
    """The state of the way to the goal."""

    UNDER_WAY = "under way"
    ARRIVED = "arrived"
    BLOCKED = "blocked"


class Goal:
    """A place to go to."""

    def __init__(
        self,
        name: str,
        x: float,
        y: float,
        yaw: float = math.nan,
        place: str = "",
        height: float = math.nan,
    ) -> None:
        self.name = name
        """As a sentence begins with it: `Point 3`."""
        self.place = place
        """The name that people gave to it; empty when it has none."""
        self.x, self.y = x, y
        """In `map` [m]."""
        self.yaw = yaw
        """Direction to stand in [rad]; NaN when any will do."""
        self.height = height or math.nan
        """To go there at, above the map's origin [m]; NaN for the one that is kept."""

    @property
    def spoken(self) -> str:
        """As it stands within a sentence: `point 3`, but `Office 12`."""
        name = self.name.rstrip(",")
        return name if name == self.place else f"{name[0].lower()}{name[1:]}"


PATH_CONTROLLERS: dict[str, Callable[[Robot, float | None], PathController]] = {
    "differential": DifferentialController,
    "lattice": AckermannController,
    "course": CourseController,
}
"""The path controllers, by `path_controller` of the robot's kind."""


def path_controller_of(robot: Robot, clearance: float | None = None) -> PathController:
    """The path controller of the robot's kind, which keeps a `clearance` [m]; None for the kind's own."""
    return PATH_CONTROLLERS[kind_of(robot.info.kind).path_controller](robot, clearance)


def required_radius(info: RobotInfo) -> float:
    """The room that a robot needs round its place, whichever way it points [m]."""
    return girth(info) if kind_of(info.kind).path_controller == "lattice" else info.radius


class Navigator(HeightOrders):
    """Drives one robot on one map."""

    def __init__(
        self,
        robot: Robot,
        grid: Grid,
        show: Callable[[Points], None],
        worker: Worker | None = None,
        clearance: float | None = None,
    ) -> None:
        """`worker` looks for ways; without one it is done in `update`, a bit in each.

        `clearance` is kept between the body and anything on the way at least [m]; None for what its kind keeps.
        """
        info = robot.info
        controller = path_controller_of(robot, clearance)
        super().__init__(robot, controller)
        self._show = show
        self.kind = info.kind
        """Of robot, as its information calls it."""
        self._radius = required_radius(info)
        self.clearance = CLEARANCE if clearance is None else clearance
        """Kept on the way where it is narrow [m]."""
        cruising = PlanarVelocity(controller.cruise, 0.0, 0.0)
        self._stopping_distance = reach(cruising, REST, kind_of(info.kind).handling) + controller.clear
        self._search = WaySearch(controller, worker or InLoopWorker())
        self.set_map(self.planner_on(grid))
        self._goal: Goal | None = None
        self.reason: Problem = ""
        """Why the way is blocked, as one sentence; empty when it is not."""
        self.waits_for = ""
        """What it does before it can go, as one sentence; empty when it goes."""
        self.sure = True
        """The position is trusted; otherwise it creeps."""
        self._arrival = ArrivalCheck()
        self._turning = False
        self._planned = -math.inf
        self._progress, self._wait, self._ready = ProgressWatch(), WayWait(), ReadyWatch()

    def planner_on(self, grid: Grid) -> Planner:
        """For `set_map`: what takes its time on a large map, and may be done in another thread."""
        return Planner(grid, self._radius, self.clearance)

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

    _left, _patient = math.nan, True

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
    def doubts(self) -> bool:
        """It stands where the goal should be, and is not sure of that."""
        return self._arrival.waits

    @property
    def blocked(self) -> str:
        """Why it stands and waits for a way that something blocks, as one sentence; empty when it does not."""
        return self._wait.text

    @property
    def turning(self) -> bool:
        """It is there and turns to the direction asked for."""
        return self._turning

    def move(self, twist: Twist) -> None:
        """Move so until the next order, `update` or `rest`, with no one but the caller avoiding obstacles."""
        self._robot.drive(twist)

    def skip(self, seconds: float) -> None:
        """The robot's clock jumped by `seconds` [s], in which nothing happened: it was none to get nowhere in."""
        self._planned += seconds
        for timed in (self._progress, self._wait, self._ready, self._arrival, self._search, self.obstacles):
            timed.skip(seconds)

    def head_for(self, goal: Goal, *, patient: bool = True) -> None:
        """Begin a new leg; the path is planned with the next `update`. One that is `patient` waits where something blocks the way."""
        self._goal, self.reason, self._patient = goal, "", patient
        self._progress.begin()
        self._forget()

    def rest(self) -> None:
        """Stand still and forget the path; a leg that goes on later is planned from wherever it is then."""
        self._robot.stop()
        self._progress.pause()
        self._forget()

    def _forget(self) -> None:
        """Have no way any more, look for none and wait for none."""
        self._arrival.forget()
        self._wait.forget()
        self.controller.forget()
        self._search.drop()
        self._ready, self._left = ReadyWatch(), math.nan

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
        if self._wait.holds(now, self.obstacles.cleared):
            self._robot.stop()
            return LegState.UNDER_WAY
        if not controller.under_way and not self.planning:
            self._ask(now)
        looks = self.planning and not self._search_on(pose, goal, now)
        if looks and (controller.stands or not controller.under_way):
            self._robot.stop()  # it may be rolling still, with no way to roll along
            return LegState.BLOCKED if self.reason else LegState.UNDER_WAY
        if controller.arrived(pose):
            return self._face(pose, goal, now)
        self._arrival.forget()
        return self._go_on(pose, goal, points, now, looks=looks)

    def _go_on(self, pose: Pose2, goal: Goal, points: Points, now: float, *, looks: bool) -> LegState:
        """Drive on along the way, while another one is looked for if it `looks`."""
        controller, self._left = self.controller, self.controller.remaining(pose)
        stands = self._progress.stands(self._left, now)
        if stands and self._progress.given_up:
            self.reason = _stuck(pose, goal)
            return LegState.BLOCKED
        if stands or (now - self._planned >= REPLAN_PERIOD and self._in_the_way(now, controller.look)):
            self._ask(now)
        if self.planning and not looks:
            looks = not self._search_on(pose, goal, now)
        if controller.under_way and not (looks and controller.stands):
            self._steer(pose, points, now)
        return LegState.BLOCKED if self.reason and not controller.under_way else LegState.UNDER_WAY

    def _steer(self, pose: Pose2, points: Points, now: float) -> None:
        """Go on along the way, unless something new is so near on it that only its controller could keep off it."""
        if not self.controller.avoids and self._in_the_way(now, self._stopping_distance):
            self._robot.stop()
        else:
            self.controller.steer(pose, points, sure=self.sure)

    def ready(self, now: float) -> str:
        """Get ready to go: what it does for that, as one sentence, empty when it goes. After too long there is a `reason`."""
        waits = self.controller.ready()
        self.reason = self._ready.late(waits, now) or self.reason
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
                self.planner, pose, at, goal.name, lambda: self.obstacles.planned(now), now
            )
            if way is None:
                return False
            self.controller.follow(way)
            self._left = self.controller.remaining(pose)
            self._wait.over(now)
            self._show(np.concatenate([piece.points for piece in way]))
        except Unreachable as problem:
            self._no_way(problem, goal, now)
        self._progress.wait(now - self._search.asked)
        self._planned = now
        self._search.drop()
        return self.controller.under_way

    def _no_way(self, problem: Unreachable, goal: Goal, now: float) -> None:
        """Give up where the map has no way; wait where something stands on it that may go."""
        if self.controller.under_way and not (problem.gap and problem.blocked):
            self.reason = ""  # an old path stays; standing still on it is noticed
        elif problem.blocked is None or not self._patient:
            self.reason = Notice(Code.WAY_MISSING, str(problem))
        else:
            self._robot.stop()
            self.controller.forget()
            self._progress.pause()
            self.reason = self._wait.blocked(problem, goal.name, now, self.obstacles.cleared)

    def _in_the_way(self, now: float, look: float) -> bool:
        """Something new is in the way that it has, nearer than `look` [m] along it."""
        ahead = self.controller.ahead[: int(look / STEP)]
        return bool(len(self.obstacles.near(ahead, self.controller.clear, now)))

    def _face(self, pose: Pose2, goal: Goal, now: float) -> LegState:
        """At the place: turn to the direction asked for, if any, and make sure that it is the place."""
        self._left = 0.0
        if not (math.isnan(goal.yaw) or self.controller.face(pose, goal.yaw)):
            self._turning = True
            return LegState.UNDER_WAY
        if self.sure:
            return LegState.ARRIVED
        self._robot.stop()
        refusal = self._arrival.refusal(goal.name.rstrip(","), now)
        if refusal is None:
            return LegState.UNDER_WAY
        self.reason = refusal
        return LegState.BLOCKED


def _stuck(pose: Pose2, goal: Goal) -> Notice:
    """Where it stood too long, after some plans anew."""
    where = f"({pose.x:.1f}, {pose.y:.1f})"
    said = f"Stuck at {where}: the way to {place_sentence(goal.name, goal.x, goal.y)} is blocked."
    return Notice(Code.WAY_BLOCKED, said, place=goal.name, x=pose.x, y=pose.y)
