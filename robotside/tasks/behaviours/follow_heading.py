"""A drive in one direction, up to the next obstacle."""

from __future__ import annotations

import math

import numpy as np
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from robotside.core.notice import Notice
from robotside.core.pose2 import Points
from robotside.core.text import heading
from robotside.kinds.registry import kind_of
from robotside.navigation.ackermann_controller import AckermannController
from robotside.navigation.avoidance import BRAKING, GAP, HORIZON, free_lengths
from robotside.navigation.course_controller import CourseController
from robotside.navigation.navigator import UNSURE_SPEED, Navigator
from robotside.tasks.behaviours.course import Span
from robotside.tasks.behaviours.situation import Situation

__all__ = ["FollowHeading"]

MAX_BEARING = 0.5
"""Farther off than this it turns where it stands [rad]."""

MAX_YAW_RATE = 0.8
"""Greatest turn rate [rad/s]."""

MAX_BEND_SPEED = 1.0
"""The most while it comes round in a bend [m/s]."""

MIN_ROOM = 0.15
"""With less room than this it stands [m]."""

SAME_THING = 0.3
"""What the laser meets so much before a wall of the map at the most is that wall [m]: map and place are not exact, and more is kept of what is seen."""

BLOCKED_TIMEOUT = 10.0
"""So long it waits for something in the way to go [s]."""


class FollowHeading(Behaviour):
    """Succeeds when the time of `span` is over; fails before a wall or a fence, and before what does not go away."""

    def __init__(
        self,
        heading: float,
        speed: float,
        span: Span,
        navigator: Navigator,
        situation: Situation,
        *,
        throttle: float = math.nan,
    ) -> None:
        """`heading` [rad], NaN for where it points at the start; `speed` [m/s], NaN for the robot's own.

        `throttle`, -1 to 1, goes before a speed that is not given; NaN for none.
        """
        super().__init__("follow heading")
        self._heading, self._speed, self._span, self._throttle = heading, speed, span, throttle
        self._braking = min(BRAKING, kind_of(navigator.kind).handling.braking)
        fastest = navigator.cruise if math.isnan(speed) else speed
        self._horizon = max(HORIZON, fastest * fastest / (2 * self._braking) + 1.0)
        self._navigator, self._situation = navigator, situation
        self._blocked_since = math.nan

    def initialise(self) -> None:
        """Take the direction."""
        self._navigator.finish()
        self._navigator.reason = ""
        self._span.begin()
        if math.isnan(self._heading):
            self._heading = self._situation.pose.yaw
        self._blocked_since = math.nan

    def update(self) -> Status:
        """Go on."""
        if self._span.over:
            return Status.SUCCESS
        now = self._situation
        waits = self._navigator.ready(now.now)
        if waits:
            now.report("taking off", waits)
            return Status.FAILURE if self._navigator.reason else Status.RUNNING
        error = math.remainder(self._heading - now.pose.yaw, math.tau)
        towards = heading(self._heading)
        bends = self._navigator.controller.turning > 0
        if abs(error) > MAX_BEARING and not bends:
            now.report("turning", f"Turning to {towards}.")
            self._go(0.0, error)
            return Status.RUNNING
        wall, thing = self._wall(), self._thing()
        if min(wall, thing) < MIN_ROOM:
            return self._stand(wall < thing + SAME_THING)
        self._blocked_since = math.nan
        turns = abs(error) > MAX_BEARING
        said = f"Coming round to {towards}." if turns else f"Going straight at {towards}."
        now.report("turning" if turns else "driving", said)
        pace = self._pace(min(wall, thing))
        self._go(min(pace, MAX_BEND_SPEED) if turns else pace, error)
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        self._navigator.rest()

    def _go(self, speed: float, error: float) -> None:
        """Ahead at `speed` [m/s] and round by `error` [rad]."""
        controller = self._navigator.controller
        if isinstance(controller, CourseController):
            full = speed >= self._wanted and math.isnan(self._speed) and not math.isnan(self._throttle)
            controller.along(self._heading, math.nan if full else speed, self._throttle if full else math.nan)
            return
        most = min(MAX_YAW_RATE, speed / controller.turning) if controller.turning else MAX_YAW_RATE
        self._navigator.move(Twist.planar(speed, max(-most, min(most, 1.5 * error))))

    @property
    def _wanted(self) -> float:
        return self._navigator.cruise if math.isnan(self._speed) else self._speed

    def _pace(self, room: float) -> float:
        wanted = self._wanted
        safe = math.sqrt(2.0 * self._braking * max(0.0, room - MIN_ROOM / 2))
        return min(wanted, safe, wanted if self._navigator.sure else UNSURE_SPEED)

    def _stand(self, wall: bool) -> Status:
        now = self._situation
        self._go(0.0, 0.0)
        if math.isnan(self._blocked_since):
            self._blocked_since = now.worked
        waits = BLOCKED_TIMEOUT - (now.worked - self._blocked_since)
        where = f"at ({now.pose.x:.1f}, {now.pose.y:.1f})"
        if wall or waits <= 0:
            what = "a wall, the fence or the end of the map" if wall else "something that does not go away"
            said = f"The way straight on ended {where} before {what}."
            self._navigator.reason = Notice(Code.WAY_ENDED, said, x=now.pose.x, y=now.pose.y)
            return Status.FAILURE
        now.report("waiting", f"Waiting {where}: something is in the way.", still=waits)
        return Status.RUNNING

    def _wall(self) -> float:
        """Free way ahead by the map, fence included [m], up to the horizon."""
        need = self._navigator.radius + self._navigator.clearance
        along = np.arange(0.0, self._horizon, 0.05)
        places, yaws = self._way(along)
        looks = np.column_stack([np.cos(yaws), np.sin(yaws)])
        grid, discs = self._navigator.planner.grid, self._navigator.controller.discs
        room = np.min([grid.clearance(places + disc * looks) for disc in discs], axis=0)
        # who stands too close already may go where there is more room
        closed = np.flatnonzero((room < need) & (room < room[0] + 0.01))
        return float(along[closed[0]]) if len(closed) else self._horizon

    def _way(self, along: Points) -> tuple[Points, Points]:
        """Places so far along the way [m] and where it looks there [rad]: round to the heading, if it has to drive a bend for that, and straight on."""
        pose, radius = self._situation.pose, self._navigator.controller.turning
        error = math.remainder(self._heading - pose.yaw, math.tau)
        yaw = np.full(len(along), self._heading)
        if radius:
            yaw = pose.yaw + np.clip(along / radius, 0.0, abs(error)) * math.copysign(1.0, error)
        step = np.diff(along, prepend=0.0)
        places = [pose.x + np.cumsum(step * np.cos(yaw)), pose.y + np.cumsum(step * np.sin(yaw))]
        return np.column_stack(places), yaw

    def _thing(self) -> float:
        """Free way ahead as the laser sees it [m], up to the horizon."""
        controller, points = self._navigator.controller, self._situation.points
        if isinstance(controller, AckermannController):
            error = math.remainder(self._heading - self._situation.pose.yaw, math.tau)
            bend = max(-1.0, min(1.0, 2.0 * error)) / controller.turning
            return controller.free(bend, points)
        near = points[np.hypot(points[:, 0], points[:, 1]) < HORIZON]
        if not len(near):
            return self._horizon
        reach = self._navigator.radius + max(GAP, self._navigator.clearance)
        return float(free_lengths(np.zeros(1), near, reach)[0])
