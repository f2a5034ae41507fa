"""A robot with a laser on a floor of equal rooms, and its pose estimator alone, in virtual time."""

from __future__ import annotations

from bridge.msgs import Msg
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import PlaceCandidates
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.localisation.field import Field
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from tests.fakes import Box, FakeRobot

__all__ = ["DOOR", "FLOOR", "Ride", "equal_rooms"]

DOOR = 4.0
"""From one door to the next [m]."""

FLOOR = Box(-8.0, -5.0, 8.0, 5.0)


def equal_rooms() -> list[Box]:
    """Walls of four equal rooms on each side of a corridor along x, with doors of 1.2 m; its east end looks as its west end does."""
    walls = []
    for room in range(4):
        west, east = -8.0 + DOOR * room, -4.0 + DOOR * room
        middle = (west + east) / 2
        for south, north in ((1.2, 1.4), (-1.4, -1.2)):
            walls += [Box(west, south, middle - 0.6, north), Box(middle + 0.6, south, east, north)]
        if room:
            walls += [Box(west - 0.1, 1.2, west + 0.1, 5.0), Box(west - 0.1, -5.0, west + 0.1, -1.2)]
    return walls


class Ride:
    """Drives, and hears what the estimator says; laser and odometry come as from a robot."""

    def __init__(self, robot: FakeRobot, believed: Pose2 | None, *, certain: bool = False) -> None:
        """The estimator is told that the robot is at `believed`; None tells it nothing."""
        self.robot, self.now = robot, 100.0
        self.said: list[Notice] = []
        self.wrong = 0.0
        """For how long it believed a place half a metre off or farther [s]."""
        self.asked: list[PlaceCandidates] = []
        self.estimator = PoseEstimator(
            robot.info, lambda _, notice, *__, **___: self.said.append(notice), self._hear
        )
        self._laser = LaserProjection()
        self.estimator.set_map(Field(Grid.from_msg(robot.map())))
        self._hear_robot()
        if believed is not None:
            self.estimator.place(believed, certain=certain)

    def _hear(self, _: str, msg: Msg) -> None:
        if isinstance(msg, PlaceCandidates):
            self.asked.append(msg)

    def run(self, seconds: float) -> None:
        """Let time pass, and count for how long it believed a wrong place."""
        end = self.now + seconds
        while self.now < end:
            self.now += 0.05
            if self.estimator.sure and self.error > 0.5:
                self.wrong += 0.05
            self._hear_robot()

    def _hear_robot(self) -> None:
        for _, msg in list(self.robot.read(self.now)):
            if isinstance(msg, Odometry):
                self.estimator.on_odometry(msg)
            elif isinstance(msg, LaserScan):
                points = self._laser.points(msg)
                self.estimator.on_scan(points, msg.header.stamp.seconds)

    @property
    def error(self) -> float:
        """Of the believed place [m]."""
        pose = self.estimator.pose
        assert pose is not None
        return pose.distance(*self.robot.pose[:2])

    @property
    def codes(self) -> list[str]:
        """Of all that was said."""
        return [notice.code for notice in self.said]
