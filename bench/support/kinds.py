"""Robots of the kinds that no simulation exists of yet: a point that speeds up, brakes and turns as its kind does."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, Quaternion, Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.std_msgs import Header, Time
from robotside.tracks import HANDLING
from sim.robot import ROBOTS

__all__ = ["KINDS", "Body", "Kind"]

STEP = 0.05
"""Between two moves [s]; odometry comes with each, the battery once a second."""
MOST = 40
"""So many moves are made good at once: after a longer halt it goes on from where it was."""


@dataclass(frozen=True, slots=True)
class Kind:
    """What is driven."""

    model: str
    """For `--robot sim:MODEL`."""
    speed: float
    """At most [m/s]."""
    acceleration: float
    """[m/s2]"""
    braking: float
    """[m/s2]"""


def _kinds() -> dict[str, Kind]:
    """The simulated robot of each kind, else a body of our own; speeds are those of small robots of the kind."""
    speeds = {"ackermann": 1.5, "boat": 0.3, "hexapod": 0.2, "quadrotor": 2.0}
    found = {
        kind: Kind(kind, speed, 3 * HANDLING[kind].braking, HANDLING[kind].braking)
        for kind, speed in speeds.items()
    }
    for name, model in reversed(ROBOTS.items()):
        limits = model.parameters.limits
        kind = Kind(name, limits.speed, limits.acceleration, limits.braking)
        found[model.parameters.info.kind] = kind
    return dict(sorted(found.items()))


KINDS = _kinds()
"""By the kind that `/robot/info` tells."""


class Body:
    """Fits `robotside.robot.Robot`; knows no walls."""

    trouble = ""

    def __init__(self, kind: str) -> None:
        """`kind` is one of KINDS."""
        self._kind = KINDS[kind]
        self.info = RobotInfo(kind, kind, kind, f"A {kind} of the bench", "open", self._kind.speed, 1.0, 0.2)
        self._wanted, self._speed, self._pose = Twist(), [0.0, 0.0], (0.0, 0.0, 0.0)
        self._origin: float | None = None
        self._steps = 0

    def drive(self, twist: Twist) -> None:
        """Go for `twist`."""
        self._wanted = twist

    def stop(self) -> None:
        """Go for rest."""
        self._wanted = Twist()

    def want(self, topic: str, wanted: bool) -> None:
        """There is nothing on demand."""

    def close(self) -> None:
        """There is nothing to let go of."""

    def read(self, now: float) -> Iterator[tuple[str, Msg]]:
        """Move up to `now` [s] and tell of it."""
        self._origin = now if self._origin is None else self._origin
        due = int((now - self._origin) / STEP + 1e-6)
        self._steps = max(self._steps, due - MOST)
        while self._steps <= due:
            stamp = Time.at(self._origin + self._steps * STEP)
            x, y, yaw = self._pose
            pose = PoseWithCovariance(Pose(Point(x, y), Quaternion.from_yaw(yaw)))
            twist = TwistWithCovariance(Twist.planar(self._speed[0], self._wanted.angular.z))
            yield "/odom", Odometry(Header(stamp, "odom"), "base_link", pose, twist)
            if self._steps % 20 == 0:
                yield "/battery_state", BatteryState(Header(stamp), percentage=0.9)
            self._move()
            self._steps += 1

    def _move(self) -> None:
        kind, (x, y, yaw) = self._kind, self._pose
        wanted = (self._wanted.linear.x, self._wanted.linear.y)
        for axis, aim in enumerate(wanted):
            speed = self._speed[axis]
            faster = abs(aim) > abs(speed) and aim * speed >= 0
            most = (kind.acceleration if faster else kind.braking) * STEP
            self._speed[axis] += max(-most, min(most, aim - speed))
        ahead, aside = (speed * STEP for speed in self._speed)
        c, s = math.cos(yaw), math.sin(yaw)
        turned = math.remainder(yaw + self._wanted.angular.z * STEP, math.tau)
        self._pose = (x + ahead * c - aside * s, y + ahead * s + aside * c, turned)
