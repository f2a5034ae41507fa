"""sensor_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs.base import Msg, int8, uint8, uint16, uint32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import Point32, Transform, Twist, Wrench
from bridge.msgs.sensor_msgs.part1 import CameraInfo, ChannelFloat32, LaserEcho
from bridge.msgs.std_msgs import Header

__all__ = [
    "MultiDOFJointState",
    "MultiEchoLaserScan",
    "NavSatFix",
    "NavSatStatus",
    "PointCloud",
    "PointCloud2",
    "PointField",
    "Range",
    "RelativeHumidity",
    "SetCameraInfoRequest",
    "SetCameraInfoResponse",
    "Temperature",
    "TimeReference",
]

_Float64x9: TypeAlias = Annotated[list[float], Meta(min_length=9, max_length=9)]


class MultiDOFJointState(Msg, frozen=True, gc=False):
    """Joints that move in several ways, by name; each list is as long as joint_names or empty."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/MultiDOFJointState"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string[]",
        "geometry_msgs/Transform[]",
        "geometry_msgs/Twist[]",
        "geometry_msgs/Wrench[]",
    )
    header: Header = Header()
    joint_names: list[str] = []
    transforms: list[Transform] = []
    twist: list[Twist] = []
    wrench: list[Wrench] = []


class MultiEchoLaserScan(Msg, frozen=True, gc=False):
    """One sweep of a planar laser that hears several echoes of a beam."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/MultiEchoLaserScan"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "sensor_msgs/LaserEcho[]",
        "sensor_msgs/LaserEcho[]",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "angle_min": "rad",
        "angle_max": "rad",
        "angle_increment": "rad",
        "time_increment": "s",
        "scan_time": "s",
        "range_min": "m",
        "range_max": "m",
        "ranges": "m",
    }
    header: Header = Header()
    """When the first beam was measured."""
    angle_min: float = 0.0
    """Direction of the first beam [rad], 0 ahead, anticlockwise."""
    angle_max: float = 0.0
    """Direction of the last beam [rad]."""
    angle_increment: float = 0.0
    """From beam to beam [rad]."""
    time_increment: float = 0.0
    """From beam to beam [s]."""
    scan_time: float = 0.0
    """From sweep to sweep [s]."""
    range_min: float = 0.0
    """Shortest range that can be measured [m]."""
    range_max: float = 0.0
    """Longest range that can be measured [m]."""
    ranges: list[LaserEcho] = []
    """Of each beam [m]; +inf nothing in range, -inf too close, NaN invalid (REP-117)."""
    intensities: list[LaserEcho] = []
    """Of each beam, in the sensor's own unit; empty when it measures none."""


class NavSatStatus(Msg, frozen=True, gc=False):
    """What kind of fix it is."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/NavSatStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int8", "uint16")

    STATUS_NO_FIX: ClassVar[int] = -1
    STATUS_FIX: ClassVar[int] = 0
    STATUS_SBAS_FIX: ClassVar[int] = 1
    """Put right by a satellite."""
    STATUS_GBAS_FIX: ClassVar[int] = 2
    """Put right by a station on the ground."""
    SERVICE_GPS: ClassVar[int] = 1
    SERVICE_GLONASS: ClassVar[int] = 2
    SERVICE_COMPASS: ClassVar[int] = 4
    """BeiDou as well."""
    SERVICE_GALILEO: ClassVar[int] = 8

    status: int8 = 0
    """-1 no fix, 0 fix, 1 satellite-based, 2 ground-based augmentation."""
    service: uint16 = 1
    """Bit mask of the systems used: 1 GPS, 2 GLONASS, 4 COMPASS, 8 GALILEO."""


class NavSatFix(Msg, frozen=True, gc=False):
    """Position by satellite, WGS 84."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/NavSatFix"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "sensor_msgs/NavSatStatus",
        "float64",
        "float64",
        "float64",
        "float64[9]",
        "uint8",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "latitude": "deg",
        "longitude": "deg",
        "altitude": "m",
        "position_covariance": "m2",
    }

    COVARIANCE_TYPE_UNKNOWN: ClassVar[int] = 0
    COVARIANCE_TYPE_APPROXIMATED: ClassVar[int] = 1
    COVARIANCE_TYPE_DIAGONAL_KNOWN: ClassVar[int] = 2
    COVARIANCE_TYPE_KNOWN: ClassVar[int] = 3

    header: Header = Header()
    status: NavSatStatus = NavSatStatus()
    latitude: float = math.nan
    """[deg], north positive."""
    longitude: float = math.nan
    """[deg], east positive."""
    altitude: float = math.nan
    """[m] above the ellipsoid; NaN when it is not known."""
    position_covariance: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """3 x 3 [m2] in east, north, up."""
    position_covariance_type: uint8 = 0
    """One of COVARIANCE_TYPE_…."""


class PointCloud(Msg, frozen=True, gc=False):
    """Points in space. ROS has given it up for PointCloud2."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/PointCloud"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "geometry_msgs/Point32[]",
        "sensor_msgs/ChannelFloat32[]",
    )
    UNITS: ClassVar[dict[str, str]] = {"points": "m"}
    header: Header = Header()
    points: list[Point32] = []
    """[m]"""
    channels: list[ChannelFloat32] = []
    """More values for each point."""


class PointField(Msg, frozen=True, gc=False):
    """One value in each packed point of a PointCloud2."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/PointField"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "uint32", "uint8", "uint32")
    UNITS: ClassVar[dict[str, str]] = {"offset": "byte"}

    INT8: ClassVar[int] = 1
    UINT8: ClassVar[int] = 2
    INT16: ClassVar[int] = 3
    UINT16: ClassVar[int] = 4
    INT32: ClassVar[int] = 5
    UINT32: ClassVar[int] = 6
    FLOAT32: ClassVar[int] = 7
    FLOAT64: ClassVar[int] = 8

    name: str = ""
    """As in x, y, z, intensity, rgb."""
    offset: uint32 = 0
    """From the point's first byte [byte]."""
    datatype: uint8 = 0
    """1 int8, 2 uint8, 3 int16, 4 uint16, 5 int32, 6 uint32, 7 float32, 8 float64."""
    count: uint32 = 0
    """How many values of that name follow each other."""


class PointCloud2(Msg, frozen=True, gc=False):
    """Points in space, packed as fields says, in rows where they come from a picture."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/PointCloud2"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "uint32",
        "uint32",
        "sensor_msgs/PointField[]",
        "bool",
        "uint32",
        "uint32",
        "uint8[]",
        "bool",
    )
    UNITS: ClassVar[dict[str, str]] = {"point_step": "byte", "row_step": "byte"}
    header: Header = Header()
    height: uint32 = 0
    """Rows; 1 when they are in no order."""
    width: uint32 = 0
    """Points in a row."""
    fields: list[PointField] = []
    """What each point consists of."""
    is_bigendian: bool = False
    """Order of the bytes in a wider value."""
    point_step: uint32 = 0
    """Length of a point [byte]."""
    row_step: uint32 = 0
    """Length of a row [byte]."""
    data: bytes = b""
    """Row by row, height times row_step bytes."""
    is_dense: bool = False
    """No point is invalid."""


class Range(Msg, frozen=True, gc=False):
    """One distance along a cone."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Range"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "uint8",
        "float32",
        "float32",
        "float32",
        "float32",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "field_of_view": "rad",
        "min_range": "m",
        "max_range": "m",
        "range": "m",
    }

    ULTRASOUND: ClassVar[int] = 0
    INFRARED: ClassVar[int] = 1

    header: Header = Header()
    radiation_type: uint8 = 0
    """0 ultrasound, 1 infrared."""
    field_of_view: float = 0.0
    """Width of the cone [rad]."""
    min_range: float = 0.0
    """Shortest range that can be measured [m]."""
    max_range: float = 0.0
    """Longest range that can be measured [m]."""
    range: float = math.nan
    """[m]; +inf nothing in range, -inf too close (REP-117)."""


class RelativeHumidity(Msg, frozen=True, gc=False):
    """How damp the air is."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/RelativeHumidity"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64")
    header: Header = Header()
    relative_humidity: float = 0.0
    """0 dry to 1 saturated."""
    variance: float = 0.0
    """0 when it is not known."""


class SetCameraInfoRequest(Msg, frozen=True, gc=False):
    """Give a camera its calibration."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/SetCameraInfoRequest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("sensor_msgs/CameraInfo",)
    camera_info: CameraInfo = field(default_factory=CameraInfo)


class SetCameraInfoResponse(Msg, frozen=True, gc=False):
    """What `SetCameraInfo` answers."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/SetCameraInfoResponse"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("bool", "string")
    success: bool = False
    """It is stored."""
    status_message: str = ""
    """One sentence."""


class Temperature(Msg, frozen=True, gc=False):
    """One temperature."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Temperature"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"temperature": "degC", "variance": "degC2"}
    header: Header = Header()
    temperature: float = 0.0
    """[degC]"""
    variance: float = 0.0
    """[degC2]; 0 when it is not known."""


class TimeReference(Msg, frozen=True, gc=False):
    """What another clock shows."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/TimeReference"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "time", "string")
    header: Header = Header()
    """Our clock at that moment."""
    time_ref: Time = Time()
    """The other clock."""
    source: str = ""
    """Which clock that is."""
