"""Going in one direction, whatever lies there, up to the next thing that it must not touch."""

from __future__ import annotations

import math

import numpy as np
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.msgs.geometry_msgs import Twist
from robotside.avoidance import BRAKING, GAP, HORIZON, free_lengths
from robotside.behaviours.course import Span
from robotside.behaviours.situation import Situation
from robotside.guide import UNSURE_SPEED, Guide
from robotside.planner import MARGIN

__all__ = ["FollowHeading"]

ALIGNED = 0.5
"""Farther off than this it turns where it stands [rad]."""

TURN = 0.8
"""Greatest turn rate [rad/s]."""

NEAR = 0.15
"""With less room than this it stands [m]."""

PATIENCE = 10.0
"""So long it waits for something in the way to go [s]."""


class FollowHeading(Behaviour):
    """Succeeds when the time of `span` is over; fails before a wall or a fence, and before what does not go away."""

    def __init__(self, heading: float, speed: float, span: Span, guide: Guide, situation: Situation) -> None:
        """`heading` [rad], NaN for where it points at the start; `speed` [m/s], NaN for the robot's own."""
        super().__init__("follow heading")
        self._heading, self._speed, self._span = heading, speed, span
        self._guide, self._situation = guide, situation
        self._blocked_since = math.nan

    def initialise(self) -> None:
        """Take the direction."""
        self._guide.finish()
        self._span.begin()
        if math.isnan(self._heading):
            self._heading = self._situation.pose.yaw
        self._blocked_since = math.nan

    def update(self) -> Status:
        """Go on."""
        if self._span.over:
            return Status.SUCCESS
        now = self._situation
        error = math.remainder(self._heading - now.pose.yaw, math.tau)
        rate = max(-TURN, min(TURN, 1.5 * error))
        degrees = math.degrees(self._heading) % 360.0
        if abs(error) > ALIGNED:
            now.tell("turning", f"Turning to the heading of {degrees:.0f} degrees.")
            self._guide.move(Twist.planar(0.0, rate))
            return Status.RUNNING
        wall, thing = self._wall(), self._thing()
        if min(wall, thing) < NEAR:
            return self._stand(wall < NEAR)
        self._blocked_since = math.nan
        now.tell("driving", f"Going straight at {degrees:.0f} degrees.")
        self._guide.move(Twist.planar(self._pace(min(wall, thing)), rate))
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:
        """Stand still."""
        self._guide.rest()

    def _pace(self, room: float) -> float:
        wanted = self._guide.cruise if math.isnan(self._speed) else self._speed
        safe = math.sqrt(2.0 * BRAKING * max(0.0, room - NEAR / 2))
        return min(wanted, safe, wanted if self._guide.sure else UNSURE_SPEED)

    def _stand(self, wall: bool) -> Status:
        now = self._situation
        self._guide.move(Twist())
        if math.isnan(self._blocked_since):
            self._blocked_since = now.worked
        waits = PATIENCE - (now.worked - self._blocked_since)
        where = f"at ({now.pose.x:.1f}, {now.pose.y:.1f})"
        if wall or waits <= 0:
            what = "a wall, the fence or the end of the map" if wall else "something that does not go away"
            self._guide.reason = f"The way straight on ended {where} before {what}."
            return Status.FAILURE
        now.tell("waiting", f"Waiting {where}: something is in the way.", still=waits)
        return Status.RUNNING

    def _wall(self) -> float:
        """Free way ahead as the map, fence included, tells [m], up to the horizon."""
        pose, need = self._situation.pose, self._guide.radius + MARGIN
        along = np.arange(0.0, HORIZON, 0.05)
        places = np.column_stack(
            [pose.x + along * math.cos(self._heading), pose.y + along * math.sin(self._heading)]
        )
        room = self._guide.planner.grid.clearance(places)
        # who stands too close already may go where there is more room
        closed = np.flatnonzero((room < need) & (room < room[0] + 0.01))
        return float(along[closed[0]]) if len(closed) else HORIZON

    def _thing(self) -> float:
        """Free way ahead as the laser sees it [m], up to the horizon."""
        points = self._situation.points
        near = points[np.hypot(points[:, 0], points[:, 1]) < HORIZON]
        return float(free_lengths(np.zeros(1), near, self._guide.radius + GAP)[0])
