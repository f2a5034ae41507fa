"""geometry_msgs: points, orientations, poses and twists. Frames as in REP-103: x forward or east, z up."""

from __future__ import annotations

import math
from typing import ClassVar

from msgspec import field

from bridge.msgs.base import Msg
from bridge.msgs.std_msgs import Header

__all__ = [
    "Point",
    "Pose",
    "PoseStamped",
    "PoseWithCovariance",
    "PoseWithCovarianceStamped",
    "Quaternion",
    "Transform",
    "TransformStamped",
    "Twist",
    "TwistWithCovariance",
    "Vector3",
    "zeros36",
]


def zeros36() -> list[float]:
    """An empty 6 x 6 covariance, row by row."""
    return [0.0] * 36


class Vector3(Msg, frozen=True, gc=False):
    """A free vector; its unit is that of the quantity it stands for."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Vector3"
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Point(Msg, frozen=True, gc=False):
    """A position [m]."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Point"
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Quaternion(Msg, frozen=True, gc=False):
    """A rotation from the body's frame to the header's frame; unit length."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Quaternion"
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0

    @property
    def roll(self) -> float:
        """Rotation about x [rad], -pi to pi."""
        x, y, z, w = self.x, self.y, self.z, self.w
        return math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))

    @property
    def pitch(self) -> float:
        """Rotation about y [rad], -pi/2 to pi/2; positive is nose down (REP-103)."""
        return math.asin(max(-1.0, min(1.0, 2 * (self.w * self.y - self.z * self.x))))

    @property
    def yaw(self) -> float:
        """Rotation about z [rad], -pi to pi; 0 is east, anticlockwise."""
        x, y, z, w = self.x, self.y, self.z, self.w
        return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))

    @classmethod
    def from_yaw(cls, yaw: float) -> Quaternion:
        """The level orientation that points to `yaw` [rad]."""
        return cls(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))

    @classmethod
    def from_rpy(cls, roll: float, pitch: float, yaw: float) -> Quaternion:
        """The orientation after turning by roll, pitch and yaw [rad] about fixed x, y and z."""
        cr, sr = math.cos(roll / 2), math.sin(roll / 2)
        cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
        cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
        return cls(
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
            cr * cp * cy + sr * sp * sy,
        )


class Pose(Msg, frozen=True, gc=False):
    """Where something is and how it is turned."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Pose"
    position: Point = Point()
    orientation: Quaternion = Quaternion()


class PoseStamped(Msg, frozen=True, gc=False):
    """A pose in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseStamped"
    header: Header = Header()
    pose: Pose = Pose()


class PoseWithCovariance(Msg, frozen=True, gc=False):
    """A pose and how sure it is."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseWithCovariance"
    pose: Pose = Pose()
    covariance: list[float] = field(default_factory=zeros36)
    """6 x 6, row by row, of x, y, z [m] and the rotations about x, y, z [rad]."""


class PoseWithCovarianceStamped(Msg, frozen=True, gc=False):
    """An uncertain pose in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseWithCovarianceStamped"
    header: Header = Header()
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)


class Twist(Msg, frozen=True, gc=False):
    """A velocity in `base_link`: linear [m/s], x forward, y left, z up; angular [rad/s]."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Twist"
    linear: Vector3 = Vector3()
    angular: Vector3 = Vector3()

    @classmethod
    def planar(cls, forward: float, turn: float) -> Twist:
        """A ground robot's twist: `forward` [m/s] along x and `turn` [rad/s] about z."""
        return cls(Vector3(forward), Vector3(0.0, 0.0, turn))


class TwistWithCovariance(Msg, frozen=True, gc=False):
    """A velocity and how sure it is."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/TwistWithCovariance"
    twist: Twist = Twist()
    covariance: list[float] = field(default_factory=zeros36)


class Transform(Msg, frozen=True, gc=False):
    """The pose of a child frame in its parent."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Transform"
    translation: Vector3 = Vector3()
    rotation: Quaternion = Quaternion()


class TransformStamped(Msg, frozen=True, gc=False):
    """A transform from the header's frame to `child_frame_id`."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/TransformStamped"
    header: Header = Header()
    child_frame_id: str = ""
    transform: Transform = Transform()
