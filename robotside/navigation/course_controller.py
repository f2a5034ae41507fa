"""The path controller for boats, swimmers and drones, which keep a heading, a speed and a height by themselves."""

from __future__ import annotations

import math

from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.pose2 import Points, Pose2
from robotside.core.robot import Manoeuvrable, Robot
from robotside.kinds.registry import kind_of
from robotside.navigation.path_controller import CRUISE_SHARE, UNSURE_SPEED, SinglePath

__all__ = ["TAKE_OFF_HEIGHT", "CourseController"]

TAKE_OFF_HEIGHT = 2.0
"""Above where it stands, which is over people's heads [m]."""

MAX_SPEED = 2.0
"""It goes by itself no faster than this [m/s]."""

MAX_BEARING = 0.6
"""Farther off its course than this, what turns where it is does so before it goes [rad]."""

TURNING_SPEED = 0.4
"""The speed at which a boat, which turns only by going, comes about [m/s]."""

TURNING_RADIUS = 3.0
"""Of the bend in which a boat comes about [m]."""

LOOK_ASIDE = 0.18
"""What is nearer than this to the body on its way is in it [m]."""

YAW_TOLERANCE = 0.1
"""It looks to where it should within this [rad]."""


class CourseController(SinglePath):
    """`path_controller.PathController` of a robot that keeps courses."""

    stands = avoids = False
    keeps_courses = True
    discs: tuple[float, ...] = (0.0,)
    look = 10.0

    def __init__(self, robot: Robot, clearance: float | None = None) -> None:
        """`clearance` is that of its ways [m]; None for the usual one."""
        info = robot.info
        super().__init__(kind_of(info.kind).pursuit)
        self._robot, self._comes_about = robot, kind_of(info.kind).comes_about
        self.cruise, self.clear = (
            min(CRUISE_SHARE * info.max_speed, MAX_SPEED),
            info.radius + max(LOOK_ASIDE, clearance or 0.0),
        )
        self.turning = TURNING_RADIUS if kind_of(info.kind).comes_about else 0.0
        self.height = math.nan
        self.aloft = "take_off" not in info.manoeuvres
        self.measured = math.nan

    def steer(self, pose: Pose2, points: Points, *, sure: bool) -> None:
        """Go on."""
        follower = self._follower
        if follower is None:
            return
        distance, bearing = follower.aim(pose, self._speed)
        speed = follower.speed(pose, bearing, distance)
        if abs(bearing) > MAX_BEARING:
            speed = TURNING_SPEED if self._comes_about else 0.0
        self._speed = speed if sure else min(speed, UNSURE_SPEED)
        self.along(wrap(pose.yaw + bearing), self._speed)

    def face(self, pose: Pose2, yaw: float) -> bool:
        """Turn to `yaw`; a boat, which turns only by going, looks wherever it came from."""
        if self._comes_about or abs(wrap(yaw - pose.yaw)) < YAW_TOLERANCE:
            return True
        self.along(yaw, 0.0)
        return False

    def ready(self) -> str:
        """A robot that stands on the ground takes off first."""
        if self.aloft:
            return ""
        self.take_off()
        return "Taking off."

    def take_off(self, height: float = math.nan) -> None:
        """Rise to `height` above the map's origin [m], NaN for the usual one."""
        told = self.height if math.isnan(height) else height
        usual = TAKE_OFF_HEIGHT + (0.0 if math.isnan(self.measured) else self.measured)
        self._order(Manoeuvre(kind="take_off", height=usual if math.isnan(told) else told))

    def along(self, yaw: float, speed: float, throttle: float = math.nan) -> None:
        """Keep to `yaw` [rad] at a `speed` [m/s], NaN for what the `throttle`, -1 to 1, gives."""
        self._order(Manoeuvre(kind="course", yaw=yaw, speed=speed, throttle=throttle, height=self.height))

    def _order(self, order: Manoeuvre) -> None:
        if isinstance(self._robot, Manoeuvrable):
            self._robot.manoeuvre(order)
