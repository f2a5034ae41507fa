"""geometry_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs import additions
from bridge.msgs.additions import zeros36
from bridge.msgs.base import Msg
from bridge.msgs.std_msgs import Header

__all__ = [
    "Accel",
    "AccelStamped",
    "AccelWithCovariance",
    "AccelWithCovarianceStamped",
    "Inertia",
    "InertiaStamped",
    "Point",
    "Point32",
    "PointStamped",
    "Polygon",
    "PolygonStamped",
    "Pose",
    "Pose2D",
    "PoseArray",
    "PoseStamped",
    "PoseWithCovariance",
    "PoseWithCovarianceStamped",
    "Quaternion",
    "QuaternionStamped",
    "Transform",
    "TransformStamped",
    "Twist",
    "TwistStamped",
    "TwistWithCovariance",
    "TwistWithCovarianceStamped",
    "Vector3",
    "Vector3Stamped",
    "Wrench",
    "WrenchStamped",
    "zeros36",
]

_Float64x36: TypeAlias = Annotated[list[float], Meta(min_length=36, max_length=36)]


class Vector3(Msg, frozen=True, gc=False):
    """A free vector; its unit is that of the quantity it stands for."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Vector3"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64", "float64")
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Accel(Msg, frozen=True, gc=False):
    """An acceleration."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Accel"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Vector3", "geometry_msgs/Vector3")
    UNITS: ClassVar[dict[str, str]] = {"linear": "m/s2", "angular": "rad/s2"}
    linear: Vector3 = Vector3()
    """[m/s2]"""
    angular: Vector3 = Vector3()
    """[rad/s2]"""


class AccelStamped(Msg, frozen=True, gc=False):
    """An acceleration in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/AccelStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Accel")
    header: Header = Header()
    accel: Accel = Accel()


class AccelWithCovariance(Msg, frozen=True, gc=False):
    """An acceleration and how sure it is."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/AccelWithCovariance"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Accel", "float64[36]")
    accel: Accel = Accel()
    covariance: _Float64x36 = field(default_factory=lambda: [0.0] * 36)
    """6 x 6, row by row, of x, y, z [m/s2] and about x, y, z [rad/s2]."""


class AccelWithCovarianceStamped(Msg, frozen=True, gc=False):
    """An uncertain acceleration in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/AccelWithCovarianceStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/AccelWithCovariance")
    header: Header = Header()
    accel: AccelWithCovariance = field(default_factory=AccelWithCovariance)


class Inertia(Msg, frozen=True, gc=False):
    """Mass and inertia of a body."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Inertia"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "float64",
        "geometry_msgs/Vector3",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
        "float64",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "m": "kg",
        "com": "m",
        "ixx": "kg m2",
        "ixy": "kg m2",
        "ixz": "kg m2",
        "iyy": "kg m2",
        "iyz": "kg m2",
        "izz": "kg m2",
    }
    m: float = 0.0
    """Its mass [kg]."""
    com: Vector3 = Vector3()
    """Its centre of mass [m]."""
    ixx: float = 0.0
    """The tensor about the centre of mass [kg m2]."""
    ixy: float = 0.0
    """[kg m2]"""
    ixz: float = 0.0
    """[kg m2]"""
    iyy: float = 0.0
    """[kg m2]"""
    iyz: float = 0.0
    """[kg m2]"""
    izz: float = 0.0
    """[kg m2]"""


class InertiaStamped(Msg, frozen=True, gc=False):
    """An inertia in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/InertiaStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Inertia")
    header: Header = Header()
    inertia: Inertia = Inertia()


class Point(Msg, frozen=True, gc=False):
    """A position [m]."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Point"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "z": "m"}
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class Point32(Msg, frozen=True, gc=False):
    """A position [m] that is sent by the thousand; Point is meant for all else."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Point32"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float32", "float32", "float32")
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "z": "m"}
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0


class PointStamped(Msg, frozen=True, gc=False):
    """A position in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PointStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Point")
    header: Header = Header()
    point: Point = Point()


class Polygon(Msg, frozen=True, gc=False):
    """An area by its corners; the last one is joined to the first."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Polygon"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Point32[]",)
    points: list[Point32] = []


class PolygonStamped(Msg, frozen=True, gc=False):
    """An area in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PolygonStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Polygon")
    header: Header = Header()
    polygon: Polygon = field(default_factory=Polygon)


class Quaternion(additions.Quaternion, frozen=True, gc=False):
    """A rotation from the body's frame to the header's frame; unit length."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Quaternion"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64", "float64", "float64")
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0


class Pose(Msg, frozen=True, gc=False):
    """Where something is and how it is turned."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Pose"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Point", "geometry_msgs/Quaternion")
    position: Point = Point()
    orientation: Quaternion = Quaternion()


class Pose2D(Msg, frozen=True, gc=False):
    """A place on a plane and a direction there. ROS has given it up for Pose."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Pose2D"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float64", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"x": "m", "y": "m", "theta": "rad"}
    x: float = 0.0
    """[m]"""
    y: float = 0.0
    """[m]"""
    theta: float = 0.0
    """[rad], anticlockwise."""


class PoseArray(Msg, frozen=True, gc=False):
    """Poses in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Pose[]")
    header: Header = Header()
    poses: list[Pose] = []


class PoseStamped(Msg, frozen=True, gc=False):
    """A pose in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Pose")
    header: Header = Header()
    pose: Pose = Pose()


class PoseWithCovariance(Msg, frozen=True, gc=False):
    """A pose and how sure it is."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseWithCovariance"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Pose", "float64[36]")
    pose: Pose = Pose()
    covariance: _Float64x36 = field(default_factory=lambda: [0.0] * 36)
    """6 x 6, row by row, of x, y, z [m] and the rotations about x, y, z [rad]."""


class PoseWithCovarianceStamped(Msg, frozen=True, gc=False):
    """An uncertain pose in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/PoseWithCovarianceStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/PoseWithCovariance")
    header: Header = Header()
    pose: PoseWithCovariance = field(default_factory=PoseWithCovariance)


class QuaternionStamped(Msg, frozen=True, gc=False):
    """A rotation in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/QuaternionStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Quaternion")
    header: Header = Header()
    quaternion: Quaternion = Quaternion()


class Transform(Msg, frozen=True, gc=False):
    """The pose of a child frame in its parent."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Transform"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Vector3", "geometry_msgs/Quaternion")
    UNITS: ClassVar[dict[str, str]] = {"translation": "m"}
    translation: Vector3 = Vector3()
    """[m]"""
    rotation: Quaternion = Quaternion()


class TransformStamped(Msg, frozen=True, gc=False):
    """A transform from the header's frame to child_frame_id."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/TransformStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "string", "geometry_msgs/Transform")
    header: Header = Header()
    """Its frame_id is the parent."""
    child_frame_id: str = ""
    transform: Transform = Transform()


class Twist(additions.Twist, frozen=True, gc=False):
    """A velocity in base_link, x forward, y left, z up."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Twist"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Vector3", "geometry_msgs/Vector3")
    UNITS: ClassVar[dict[str, str]] = {"linear": "m/s", "angular": "rad/s"}
    linear: Vector3 = Vector3()
    """[m/s]"""
    angular: Vector3 = Vector3()
    """[rad/s]"""


class TwistStamped(Msg, frozen=True, gc=False):
    """A velocity in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/TwistStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Twist")
    header: Header = Header()
    twist: Twist = Twist()


class TwistWithCovariance(Msg, frozen=True, gc=False):
    """A velocity and how sure it is."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/TwistWithCovariance"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Twist", "float64[36]")
    twist: Twist = Twist()
    covariance: _Float64x36 = field(default_factory=lambda: [0.0] * 36)
    """6 x 6, row by row, of x, y, z [m/s] and about x, y, z [rad/s]."""


class TwistWithCovarianceStamped(Msg, frozen=True, gc=False):
    """An uncertain velocity in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/TwistWithCovarianceStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/TwistWithCovariance")
    header: Header = Header()
    twist: TwistWithCovariance = field(default_factory=TwistWithCovariance)


class Vector3Stamped(Msg, frozen=True, gc=False):
    """A free vector in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Vector3Stamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Vector3")
    header: Header = Header()
    vector: Vector3 = Vector3()


class Wrench(Msg, frozen=True, gc=False):
    """A force and what turns."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/Wrench"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("geometry_msgs/Vector3", "geometry_msgs/Vector3")
    UNITS: ClassVar[dict[str, str]] = {"force": "N", "torque": "N m"}
    force: Vector3 = Vector3()
    """[N]"""
    torque: Vector3 = Vector3()
    """[N m]"""


class WrenchStamped(Msg, frozen=True, gc=False):
    """A wrench in the header's frame."""

    MSGTYPE: ClassVar[str] = "geometry_msgs/WrenchStamped"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Wrench")
    header: Header = Header()
    wrench: Wrench = Wrench()
