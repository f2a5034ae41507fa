"""The path controller for wheels that turn the robot where it stands: pure pursuit along free arcs."""

from __future__ import annotations

import math

import numpy as np

from bridge.msgs.geometry_msgs import Twist
from robotside.core.pose2 import Points, Pose2
from robotside.core.robot import Robot
from robotside.kinds.registry import kind_of
from robotside.navigation.avoidance import Avoidance, free_lengths
from robotside.navigation.path_controller import CRUISE_SHARE, UNSURE_SPEED, GroundBound, SinglePath
from robotside.navigation.planner import CLEARANCE

__all__ = ["DifferentialController"]

MIN_SPEED = 0.03
"""Slower than this it gets nowhere [m/s]."""

MAX_STANDING_STEPS, BACKING_STEPS, BACKING_SPEED = 80, 50, 0.12
"""After so many times of getting nowhere it goes back for so many, at this speed [m/s]; there are about twenty a second."""

SIDE_REACH = 0.6
"""Farther beside the way it does not matter what stands there [m]."""

WAY_AHEAD = 12
"""So many points of the way are looked at for what stands beside it, which is a little more than it needs to brake."""

LOOK_ASIDE = 0.18
"""What is nearer than this to the body on its way makes it look for another one [m]."""

MIN_SIDE_GAP, MIN_BACK_ROOM = 0.04, 0.4
"""It goes back where it passes everything by this, and has so much room [m]."""


class DifferentialController(SinglePath, GroundBound):
    """`path_controller.PathController` of a robot that turns where it stands."""

    stands = False
    avoids = True
    keeps_courses = False
    discs: tuple[float, ...] = (0.0,)
    turning = 0.0
    look = 6.0

    def __init__(self, robot: Robot, clearance: float | None = None) -> None:
        """`clearance` is kept in narrow gaps [m]; None for the usual one."""
        info = robot.info
        super().__init__(kind_of(info.kind).pursuit)
        self._robot, self._turn = robot, info.max_yaw_rate
        kept = CLEARANCE if clearance is None else clearance
        self._avoidance = Avoidance(info.radius, max_yaw_rate=info.max_yaw_rate, clearance=kept)
        self.cruise, self.clear = CRUISE_SHARE * info.max_speed, info.radius + max(LOOK_ASIDE, kept)
        self._stood = 0
        """Times that it was to go on and could not, of late."""

    def forget(self) -> None:
        """Have no way any more."""
        super().forget()
        self._stood = 0

    def steer(self, pose: Pose2, points: Points, *, sure: bool) -> None:
        """Go on."""
        follower = self._follower
        if follower is None:
            return
        distance, bearing = follower.aim(pose, self._speed)
        cruise = follower.speed(pose, bearing, distance)
        speed = cruise if sure else min(cruise, UNSURE_SPEED)
        room = _room_beside(pose.inverse().apply(follower.ahead[:WAY_AHEAD]), points)
        way = self._avoidance.choose(distance, bearing, min(speed, self._speed + 0.08), points, room)
        self._speed = way.twist.linear.x
        self._stood = self._stood + 1 if self._speed < MIN_SPEED else max(self._stood - 2, 0)
        if self._stood > MAX_STANDING_STEPS and self._backs(points):
            self._robot.drive(Twist.planar(-BACKING_SPEED, 0.0))
            return
        self._robot.drive(way.twist)

    def _backs(self, points: Points) -> bool:
        """It makes room again where it has stood for a while, as long as there is some behind it."""
        if self._stood > MAX_STANDING_STEPS + BACKING_STEPS:
            self._stood = 0
        behind = points * np.array([-1.0, -1.0])
        return (
            float(free_lengths(np.zeros(1), behind, self._robot.info.radius + MIN_SIDE_GAP)[0])
            > MIN_BACK_ROOM
        )

    def face(self, pose: Pose2, yaw: float) -> bool:
        """Turn to `yaw` where it stands."""
        error = math.remainder(yaw - pose.yaw, math.tau)
        if abs(error) < 0.05:
            return True
        rate = math.copysign(min(0.6 * self._turn, max(0.15, 1.5 * abs(error))), error)
        self._robot.drive(Twist.planar(0.0, rate))
        return False

    def ready(self) -> str:
        """It always is."""
        return ""


def _room_beside(way: Points, points: Points) -> float:
    """From the `way` to the nearest of `points` beside it, both in `base_link` [m]; infinite where nothing is near.

    What stands before the body's own place counts; what it has passed does not.
    """
    low, high = way.min(axis=0) - SIDE_REACH, way.max(axis=0) + SIDE_REACH
    near = points[((points >= low) & (points <= high)).all(axis=1)]
    if not len(near):
        return math.inf
    gaps = near[:, None, :] - way
    return math.sqrt(float(np.einsum("ijk,ijk->ij", gaps, gaps).min()))
