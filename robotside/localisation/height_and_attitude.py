"""What the plane leaves out of a pose: height, roll and pitch, each with the variance that its source deserves.

Pure. The height is the odometry's, corrected by a pressure gauge or a ranger that points down where odometry knows it worse; the
attitude is the inertial unit's. What nothing measures has a variance that says so, and never one of zero.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Transform,
    TransformStamped,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import FluidPressure, Imu, Range
from bridge.msgs.std_msgs import Header, Time
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import described

__all__ = ["HeightAndAttitude"]

MAX_ATTITUDE_AGE = 0.5
"""An attitude that was measured longer ago does not count [s]."""
UNTOLD_TILT, LEVEL_TILT, UNKNOWN_TILT = 0.05, 0.1, 0.5
"""Deviation of roll and pitch [rad]: of a unit that tells none, of ground that is taken for level, of nothing that measures them."""
LEVEL_HEIGHT, UNTOLD_HEIGHT, UNKNOWN_HEIGHT = 0.3, 1.0, 100.0
"""Deviation of the height [m]: of ground or water that is taken for level, of odometry that tells none, of nothing that measures it."""
AIR_PRESSURE, WATER_WEIGHT = 101_325.0, 1000.0 * 9.80665
"""On the water [Pa], and of it [N/m3], as the gauge on the glass has them."""
AIR_ERROR, WEIGHT_ERROR = 1500.0 / WATER_WEIGHT, 0.015
"""What weather does to a depth [m] and salt to a part of it: all readings share both, and no average takes them out."""
GROUND_ERROR, MAX_SIGMAS = 0.3, 3.0
"""What lies on the ground below one that flies [m]; a reading that is off by more deviations is of something that stands there."""
_HEIGHT, _ROLL, _PITCH = 14, 21, 28
"""Places of the variances in a covariance of six rows."""


class HeightAndAttitude:
    """Takes odometry, inertial unit, gauge and ranger; makes a pose in the plane one in space."""

    def __init__(self, info: RobotInfo) -> None:
        kind = described(info)
        self._dives, self._flies = kind.dives, kind.flies
        self._told: float | None = None
        self._reckoned = math.inf
        self._offset = 0.0
        self._variance = UNKNOWN_HEIGHT**2
        self._corrected = False
        self._attitude = (0.0, 0.0)
        self._tilts = self._unmeasured = (
            (UNKNOWN_TILT if kind.flies or kind.dives else LEVEL_TILT) ** 2,
        ) * 2
        self._measured_at = -math.inf
        self._turning = (0.0, 0.0)
        self._stamp = math.nan

    @property
    def height(self) -> float:
        """Above the map's origin, which for what floats is the water [m]; NaN while nothing measures it."""
        return math.nan if self._told is None else self._told + self._offset

    @property
    def spread(self) -> float:
        """Uncertainty of the height, one standard deviation [m]."""
        return math.sqrt(self._variance)

    def on_odometry(self, msg: Odometry) -> None:
        """Go on by odometry: its height, and its attitude where no inertial unit measures one."""
        self._stamp = msg.header.stamp.seconds
        place, covariance = msg.pose.pose.position, msg.pose.covariance
        if not math.isfinite(place.z):
            self._variance = UNKNOWN_HEIGHT**2
            return
        level = not (self._flies or self._dives)
        untold = LEVEL_HEIGHT if level and place.z == 0.0 else UNTOLD_HEIGHT
        reckoned = _told(covariance, _HEIGHT, untold**2)
        if self._told is None or reckoned < self._reckoned:  # it began, or it knows better than it did
            self._corrected = self._corrected and reckoned > self._variance
            self._offset = self._offset if self._corrected else 0.0
        self._variance = self._variance + max(0.0, reckoned - self._reckoned) if self._corrected else reckoned
        self._told, self._reckoned = place.z, reckoned
        if self._stamp - self._measured_at > MAX_ATTITUDE_AGE:
            self._level_by(msg)

    def on_imu(self, msg: Imu) -> None:
        """Take roll and pitch, unless the unit says that it measures none."""
        turned = msg.orientation
        if not msg.orientation_covariance[0] >= 0 or not math.isfinite(turned.roll + turned.pitch):
            return
        self._attitude, self._measured_at = (turned.roll, turned.pitch), msg.header.stamp.seconds
        told = msg.orientation_covariance
        self._tilts = (_told(told, 0, UNTOLD_TILT**2), _told(told, 4, UNTOLD_TILT**2))
        rates = (msg.angular_velocity.x, msg.angular_velocity.y)
        self._turning = rates if all(map(math.isfinite, rates)) else (0.0, 0.0)

    def on_depth(self, msg: FluidPressure) -> None:
        """Correct the height of one that dives by the pressure of water and air."""
        if not (self._dives and math.isfinite(msg.fluid_pressure)):
            return
        depth = max(0.0, (msg.fluid_pressure - AIR_PRESSURE) / WATER_WEIGHT)
        noise = msg.variance / WATER_WEIGHT**2 if msg.variance > 0 else 0.0
        shared = AIR_ERROR**2 + (WEIGHT_ERROR * depth) ** 2
        off = -depth - self.height
        if off * off > MAX_SIGMAS**2 * (self._variance + noise + shared):
            self._variance = (
                UNKNOWN_HEIGHT**2
            )  # however sure, odometry counts from where it began, not from the surface
        self._correct(-depth, noise, shared)

    def on_range(self, msg: Range) -> None:
        """Correct the height of one that flies by what is straight below, which is taken for the ground of the map."""
        if not (self._flies and math.isfinite(msg.range) and msg.range > 0):
            return
        roll, pitch = self._attitude
        height = msg.range * math.cos(roll) * math.cos(pitch)
        off = height - self.height
        if not off * off > MAX_SIGMAS**2 * (self._variance + GROUND_ERROR**2):
            self._correct(height, 0.0, GROUND_ERROR**2)

    def posed(self, pose: Pose2, covariance: list[float]) -> PoseWithCovariance:
        """`pose` in space, and `covariance` of x, y and yaw with its other variances filled in."""
        roll, pitch = self._attitude
        late = abs(self._stamp - self._measured_at) if self._measured_at > -math.inf else 0.0
        covariance[_HEIGHT] = self._variance
        for place, variance, rate in zip((_ROLL, _PITCH), self._tilts, self._turning, strict=True):
            covariance[place] = variance + (rate * late) ** 2
        height = self.height if self._told is not None else 0.0
        return PoseWithCovariance(
            Pose(Point(pose.x, pose.y, height), Quaternion.from_rpy(roll, pitch, pose.yaw)), covariance
        )

    def edges(self, stamp: Time, correction: Pose2, odom: Pose2) -> list[TransformStamped]:
        """`map` to `odom`, the `correction`, upright, and `odom` to `base_link`, which never jumps, as REP-105 has them."""
        roll, pitch = self._attitude
        turned = Quaternion.from_rpy(roll, pitch, odom.yaw)
        lifted = Vector3(correction.x, correction.y, self._offset if self._told is not None else 0.0)
        placed = Vector3(odom.x, odom.y, self._told or 0.0)
        return [
            TransformStamped(
                Header(stamp, "map"), "odom", Transform(lifted, Quaternion.from_yaw(correction.yaw))
            ),
            TransformStamped(Header(stamp, "odom"), "base_link", Transform(placed, turned)),
        ]

    def _correct(self, height: float, noise: float, shared: float) -> None:
        """A reading with a variance of its own and one that all readings `shared` [m2]; of no use where odometry knows better."""
        if self._told is None or self._variance <= shared:
            return
        gain = self._variance / (self._variance + noise + shared)
        self._offset += gain * (height - self.height)
        self._variance = max((1.0 - gain) * self._variance, shared)
        self._corrected = True

    def _level_by(self, msg: Odometry) -> None:
        """By odometry's own attitude, as far as that is one; that of wheels is none."""
        turned, covariance = msg.pose.pose.orientation, msg.pose.covariance
        self._turning = (0.0, 0.0)
        self._attitude = turned.roll, turned.pitch
        untold = self._unmeasured if self._attitude == (0.0, 0.0) else (UNTOLD_TILT**2,) * 2
        self._tilts = (_told(covariance, _ROLL, untold[0]), _told(covariance, _PITCH, untold[1]))


def _told(covariance: Sequence[float], place: int, untold: float) -> float:
    """The variance at a place; `untold` for zero, which says nothing, and for what is no variance."""
    said = covariance[place]
    return said if said > 0 and math.isfinite(said) else untold
