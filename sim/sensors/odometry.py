"""Wheel odometry: where the robot believes to be by its encoders alone, with the drift that real wheels have."""

from __future__ import annotations

import math

import msgspec

from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, Quaternion, Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import JointState
from bridge.msgs.std_msgs import Header, Time
from sim.core.noise import Noise
from sim.physics.backend_bullet import Joint

__all__ = ["OdometryParameters", "WheelOdometry"]


class OdometryParameters(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The `[odometry]` table of a vehicle's file."""

    rate: float
    radius_error: float
    mismatch: float
    base_error: float
    slip: float


class WheelOdometry:
    """Integrates two encoders by the mid-point rule, starting from a given pose.

    It believes slightly wrong sizes of its wheels, one draw a run, and its wheels slip a little.
    """

    def __init__(
        self,
        parameters: OdometryParameters,
        *,
        radius: float,
        base: float,
        ticks: float,
        pose: tuple[float, float, float],
        noise: Noise,
    ) -> None:
        """Wheels of `radius` [m], `base` [m] apart, `ticks` a turn; `pose` is x, y [m], yaw [rad] in `odom`."""
        self._slip, self._noise = parameters.slip, noise
        common = 1 + noise.normal(parameters.radius_error)
        self._radii = tuple(radius * (common + noise.normal(parameters.mismatch)) for _ in range(2))
        self._base = base * (1 + noise.normal(parameters.base_error))
        self._tick = math.tau / ticks
        self._angles = (0.0, 0.0)
        self._speeds = (0.0, 0.0)
        self.pose = pose
        """x, y [m], yaw [rad] in `odom`; yaw is not wrapped."""
        self._driven = 0.0
        self._turned = 0.0

    def restart(self, pose: tuple[float, float, float]) -> None:
        """Believe to be at x, y [m], yaw [rad] in `odom`, wherever it was until now."""
        self.pose = pose
        self._driven = self._turned = 0.0

    def update(self, left: Joint, right: Joint) -> None:
        """Take in the wheels as they stand now; call it often, for the arc between two calls is taken as straight."""
        angles = tuple(math.floor(joint.angle / self._tick) * self._tick for joint in (left, right))
        way = [
            radius * (now - then) for radius, now, then in zip(self._radii, angles, self._angles, strict=True)
        ]
        way = [part + self._noise.normal(self._slip * math.sqrt(abs(part))) if part else 0.0 for part in way]
        self._angles, self._speeds = (angles[0], angles[1]), (left.speed, right.speed)
        ahead, turn = (way[0] + way[1]) / 2, (way[1] - way[0]) / self._base
        x, y, yaw = self.pose
        middle = yaw + turn / 2
        self.pose = (x + ahead * math.cos(middle), y + ahead * math.sin(middle), yaw + turn)
        self._driven += abs(ahead)
        self._turned += abs(turn)

    def odometry(self, stamp: float) -> Odometry:
        """The belief as a message, `odom` to `base_link`."""
        x, y, yaw = self.pose
        left, right = (radius * speed for radius, speed in zip(self._radii, self._speeds, strict=True))
        twist = Twist.planar((left + right) / 2, (right - left) / self._base)
        return Odometry(
            Header(Time.at(stamp), "odom"),
            "base_link",
            PoseWithCovariance(Pose(Point(x, y), Quaternion.from_yaw(yaw)), self._covariance()),
            TwistWithCovariance(twist, _diagonal(1e-4, 1e-4)),
        )

    def joint_state(self, stamp: float) -> JointState:
        """The wheels as a message; efforts are not measured."""
        return JointState(
            Header(Time.at(stamp), "base_link"),
            ["wheel_left_joint", "wheel_right_joint"],
            Float64Array(self._angles),
            Float64Array(self._speeds),
        )

    def _covariance(self) -> list[float]:
        """Grows with the way driven and turned, as the drift does."""
        yaw = (0.01 * self._turned) ** 2 + 1e-4 * self._driven
        return _diagonal((0.01 * self._driven) ** 2 + 1e-6, yaw + 1e-6)


def _diagonal(position: float, yaw: float) -> list[float]:
    covariance = [0.0] * 36
    covariance[0] = covariance[7] = position
    covariance[35] = yaw
    return covariance
