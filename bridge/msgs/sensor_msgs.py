"""sensor_msgs: what the sensors of a field robot say."""

from __future__ import annotations

import math
from typing import ClassVar

from msgspec import field

from bridge.msgs.arrays import Float32Array
from bridge.msgs.base import Msg
from bridge.msgs.geometry_msgs import Quaternion, Vector3
from bridge.msgs.std_msgs import Header

__all__ = [
    "BatteryState",
    "CompressedImage",
    "Imu",
    "JointState",
    "LaserScan",
    "NavSatFix",
    "NavSatStatus",
    "Range",
]


def _zeros9() -> list[float]:
    return [0.0] * 9


class Imu(Msg, frozen=True, gc=False):
    """Attitude, turn rate and specific force, as in REP-145: at rest the acceleration is +9.81 upward."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Imu"
    header: Header = Header()
    orientation: Quaternion = Quaternion()
    orientation_covariance: list[float] = field(default_factory=_zeros9)
    """3 x 3 [rad2]; a first element of -1 means that no orientation is measured."""
    angular_velocity: Vector3 = Vector3()
    """[rad/s]"""
    angular_velocity_covariance: list[float] = field(default_factory=_zeros9)
    linear_acceleration: Vector3 = Vector3()
    """[m/s2]"""
    linear_acceleration_covariance: list[float] = field(default_factory=_zeros9)


class NavSatStatus(Msg, frozen=True, gc=False):
    """What kind of fix it is."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/NavSatStatus"
    status: int = 0
    """-1 no fix, 0 fix, 1 satellite-based, 2 ground-based augmentation."""
    service: int = 1
    """Bit mask of the systems used: 1 GPS, 2 GLONASS, 4 COMPASS, 8 GALILEO."""


class NavSatFix(Msg, frozen=True, gc=False):
    """Position by satellite, WGS 84."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/NavSatFix"
    header: Header = Header()
    status: NavSatStatus = NavSatStatus()
    latitude: float = math.nan
    """[deg], north positive."""
    longitude: float = math.nan
    """[deg], east positive."""
    altitude: float = math.nan
    """[m] above the ellipsoid."""
    position_covariance: list[float] = field(default_factory=_zeros9)
    """3 x 3 [m2] in east, north, up."""
    position_covariance_type: int = 0


class LaserScan(Msg, frozen=True, gc=False):
    """One sweep of a planar laser."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/LaserScan"
    header: Header = Header()
    angle_min: float = 0.0
    """Direction of the first beam [rad], 0 ahead, anticlockwise."""
    angle_max: float = 0.0
    angle_increment: float = 0.0
    time_increment: float = 0.0
    scan_time: float = 0.0
    """[s]"""
    range_min: float = 0.0
    """Shortest range that can be measured [m]."""
    range_max: float = 0.0
    """Longest range that can be measured [m]."""
    ranges: Float32Array = field(default_factory=Float32Array)
    """[m]; +inf nothing in range, -inf too close, NaN invalid (REP-117). JSON turns all three into NaN."""
    intensities: Float32Array = field(default_factory=Float32Array)


class BatteryState(Msg, frozen=True, gc=False):
    """The state of the battery."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/BatteryState"
    header: Header = Header()
    voltage: float = math.nan
    """[V]"""
    temperature: float = math.nan
    """[degC]"""
    current: float = math.nan
    """[A], negative when discharging."""
    charge: float = math.nan
    """[Ah]"""
    capacity: float = math.nan
    """[Ah]"""
    design_capacity: float = math.nan
    """[Ah]"""
    percentage: float = math.nan
    """0 empty to 1 full."""
    power_supply_status: int = 0
    """0 unknown, 1 charging, 2 discharging, 3 not charging, 4 full."""
    power_supply_health: int = 0
    power_supply_technology: int = 0
    present: bool = True
    cell_voltage: Float32Array = field(default_factory=Float32Array)
    cell_temperature: Float32Array = field(default_factory=Float32Array)
    location: str = ""
    serial_number: str = ""


class CompressedImage(Msg, frozen=True, gc=False):
    """A picture as a file."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/CompressedImage"
    header: Header = Header()
    format: str = "jpeg"
    data: bytes = b""


class JointState(Msg, frozen=True, gc=False):
    """Joints by name; each list is as long as `name` or empty."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/JointState"
    header: Header = Header()
    name: list[str] = []
    position: list[float] = []
    """[rad] or [m]"""
    velocity: list[float] = []
    """[rad/s] or [m/s]"""
    effort: list[float] = []
    """[N m] or [N]"""


class Range(Msg, frozen=True, gc=False):
    """One distance along a cone."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Range"
    header: Header = Header()
    radiation_type: int = 0
    """0 ultrasound, 1 infrared."""
    field_of_view: float = 0.0
    """[rad]"""
    min_range: float = 0.0
    max_range: float = 0.0
    range: float = math.nan
    """[m]; +inf nothing in range, -inf too close (REP-117)."""
