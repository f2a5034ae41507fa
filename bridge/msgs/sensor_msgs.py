"""sensor_msgs: made by `python -m bridge.generate`; change the ROS text, not this file."""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, TypeAlias

from msgspec import Meta, field

from bridge.msgs.arrays import Float32Array, Float64Array, Int32Array
from bridge.msgs.base import Msg, int8, uint8, uint16, uint32
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import Point32, Quaternion, Transform, Twist, Vector3, Wrench
from bridge.msgs.std_msgs import Header

__all__ = [
    "BatteryState",
    "CameraInfo",
    "ChannelFloat32",
    "CompressedImage",
    "FluidPressure",
    "Illuminance",
    "Image",
    "Imu",
    "JointState",
    "Joy",
    "JoyFeedback",
    "JoyFeedbackArray",
    "LaserEcho",
    "LaserScan",
    "MagneticField",
    "MultiDOFJointState",
    "MultiEchoLaserScan",
    "NavSatFix",
    "NavSatStatus",
    "PointCloud",
    "PointCloud2",
    "PointField",
    "Range",
    "RegionOfInterest",
    "RelativeHumidity",
    "SetCameraInfoRequest",
    "SetCameraInfoResponse",
    "Temperature",
    "TimeReference",
]

_Float64x12: TypeAlias = Annotated[list[float], Meta(min_length=12, max_length=12)]
_Float64x9: TypeAlias = Annotated[list[float], Meta(min_length=9, max_length=9)]


class BatteryState(Msg, frozen=True, gc=False):
    """The state of the battery. What is not measured is NaN."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/BatteryState"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "uint8",
        "uint8",
        "uint8",
        "bool",
        "float32[]",
        "float32[]",
        "string",
        "string",
    )
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 21
    UNITS: ClassVar[dict[str, str]] = {
        "voltage": "V",
        "temperature": "degC",
        "current": "A",
        "charge": "Ah",
        "capacity": "Ah",
        "design_capacity": "Ah",
        "cell_voltage": "V",
        "cell_temperature": "degC",
    }

    POWER_SUPPLY_STATUS_UNKNOWN: ClassVar[int] = 0
    POWER_SUPPLY_STATUS_CHARGING: ClassVar[int] = 1
    POWER_SUPPLY_STATUS_DISCHARGING: ClassVar[int] = 2
    POWER_SUPPLY_STATUS_NOT_CHARGING: ClassVar[int] = 3
    POWER_SUPPLY_STATUS_FULL: ClassVar[int] = 4
    POWER_SUPPLY_HEALTH_UNKNOWN: ClassVar[int] = 0
    POWER_SUPPLY_HEALTH_GOOD: ClassVar[int] = 1
    POWER_SUPPLY_HEALTH_OVERHEAT: ClassVar[int] = 2
    POWER_SUPPLY_HEALTH_DEAD: ClassVar[int] = 3
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: ClassVar[int] = 4
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: ClassVar[int] = 5
    POWER_SUPPLY_HEALTH_COLD: ClassVar[int] = 6
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: ClassVar[int] = 7
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: ClassVar[int] = 8
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: ClassVar[int] = 0
    POWER_SUPPLY_TECHNOLOGY_NIMH: ClassVar[int] = 1
    """Nickel metal hydride."""
    POWER_SUPPLY_TECHNOLOGY_LION: ClassVar[int] = 2
    """Lithium ion."""
    POWER_SUPPLY_TECHNOLOGY_LIPO: ClassVar[int] = 3
    """Lithium polymer."""
    POWER_SUPPLY_TECHNOLOGY_LIFE: ClassVar[int] = 4
    """Lithium iron."""
    POWER_SUPPLY_TECHNOLOGY_NICD: ClassVar[int] = 5
    """Nickel cadmium."""
    POWER_SUPPLY_TECHNOLOGY_LIMN: ClassVar[int] = 6
    """Lithium manganese."""

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
    """When it was last full [Ah]."""
    design_capacity: float = math.nan
    """When it was new [Ah]."""
    percentage: float = math.nan
    """0 empty to 1 full."""
    power_supply_status: uint8 = 0
    """0 unknown, 1 charging, 2 discharging, 3 not charging, 4 full."""
    power_supply_health: uint8 = 0
    """One of POWER_SUPPLY_HEALTH_…."""
    power_supply_technology: uint8 = 0
    """One of POWER_SUPPLY_TECHNOLOGY_…."""
    present: bool = True
    """There is a battery."""
    cell_voltage: Float32Array = field(default_factory=Float32Array)
    """Of each cell [V]; empty when it is not known."""
    cell_temperature: Float32Array = field(default_factory=Float32Array)
    """Of each cell [degC]; empty when it is not known."""
    location: str = ""
    """Where it sits, as in a slot's name."""
    serial_number: str = ""


class RegionOfInterest(Msg, frozen=True, gc=False):
    """A part of a picture."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/RegionOfInterest"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint32", "uint32", "uint32", "uint32", "bool")
    UNITS: ClassVar[dict[str, str]] = {
        "x_offset": "pixel",
        "y_offset": "pixel",
        "height": "pixel",
        "width": "pixel",
    }
    x_offset: uint32 = 0
    """Of its left edge [pixel]."""
    y_offset: uint32 = 0
    """Of its top edge [pixel]."""
    height: uint32 = 0
    """[pixel]"""
    width: uint32 = 0
    """[pixel]"""
    do_rectify: bool = False
    """It is also to be cut out of the rectified picture."""


class CameraInfo(Msg, frozen=True, gc=False):
    """How a camera maps directions to pixels. Names and models are those of ROS's image pipeline
    (REP-104).
    """

    MSGTYPE: ClassVar[str] = "sensor_msgs/CameraInfo"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "uint32",
        "uint32",
        "string",
        "float64[]",
        "float64[9]",
        "float64[9]",
        "float64[12]",
        "uint32",
        "uint32",
        "sensor_msgs/RegionOfInterest",
    )
    UNITS: ClassVar[dict[str, str]] = {"height": "pixel", "width": "pixel", "k": "pixel", "p": "pixel"}
    header: Header = Header()
    height: uint32 = 0
    """Of the full picture [pixel]."""
    width: uint32 = 0
    """Of the full picture [pixel]."""
    distortion_model: str = ""
    """As in plumb_bob."""
    d: Float64Array = field(default_factory=Float64Array)
    """The distortion's coefficients; plumb_bob has k1, k2, t1, t2, k3."""
    k: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """Camera matrix of the raw picture, 3 x 3 row by row [pixel]; k[0] of 0 means uncalibrated."""
    r: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """Rectifying rotation, 3 x 3 row by row."""
    p: _Float64x12 = field(default_factory=lambda: [0.0] * 12)
    """Projection of the rectified picture, 3 x 4 row by row [pixel]."""
    binning_x: uint32 = 0
    """Columns put together in one; 0 and 1 mean none."""
    binning_y: uint32 = 0
    """Rows put together in one; 0 and 1 mean none."""
    roi: RegionOfInterest = RegionOfInterest()
    """Which part of the full picture is sent; all 0 means the whole."""


class ChannelFloat32(Msg, frozen=True, gc=False):
    """One more value for each point of a PointCloud."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/ChannelFloat32"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("string", "float32[]")
    name: str = ""
    """As in intensity, rgb, u or v."""
    values: Float32Array = field(default_factory=Float32Array)
    """As many as there are points."""


class CompressedImage(Msg, frozen=True, gc=False):
    """A picture as a file."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/CompressedImage"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "string", "uint8[]")
    header: Header = Header()
    """When it was taken, in the camera's optical frame (z ahead, x right, y down)."""
    format: str = "jpeg"
    """jpeg or png, where it matters with the pixels' encoding before it."""
    data: bytes = b""


class FluidPressure(Msg, frozen=True, gc=False):
    """The pressure of air or water round the sensor."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/FluidPressure"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"fluid_pressure": "Pa", "variance": "Pa2"}
    header: Header = Header()
    fluid_pressure: float = 0.0
    """[Pa], absolute."""
    variance: float = 0.0
    """[Pa2]; 0 when it is not known."""


class Illuminance(Msg, frozen=True, gc=False):
    """Illuminance of the surroundings."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Illuminance"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float64", "float64")
    UNITS: ClassVar[dict[str, str]] = {"illuminance": "lux", "variance": "lux2"}
    header: Header = Header()
    illuminance: float = 0.0
    """[lux]"""
    variance: float = 0.0
    """[lux2]; 0 when it is not known."""


class Image(Msg, frozen=True, gc=False):
    """A picture, pixel by pixel."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Image"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "uint32",
        "uint32",
        "string",
        "uint8",
        "uint32",
        "uint8[]",
    )
    UNITS: ClassVar[dict[str, str]] = {"height": "pixel", "width": "pixel", "step": "byte"}
    header: Header = Header()
    """When it was taken, in the camera's optical frame (z ahead, x right, y down)."""
    height: uint32 = 0
    """[pixel]"""
    width: uint32 = 0
    """[pixel]"""
    encoding: str = ""
    """As in rgb8, bgr8, mono8, 16UC1."""
    is_bigendian: uint8 = 0
    """Order of the bytes in a wider value."""
    step: uint32 = 0
    """Length of a row [byte]."""
    data: bytes = b""
    """Row by row from the top, height times step bytes."""


class Imu(Msg, frozen=True, gc=False):
    """Attitude, turn rate and specific force, as in REP-145: at rest the acceleration is +9.81 upward."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Imu"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "geometry_msgs/Quaternion",
        "float64[9]",
        "geometry_msgs/Vector3",
        "float64[9]",
        "geometry_msgs/Vector3",
        "float64[9]",
    )
    UNITS: ClassVar[dict[str, str]] = {
        "orientation_covariance": "rad2",
        "angular_velocity": "rad/s",
        "angular_velocity_covariance": "(rad/s)2",
        "linear_acceleration": "m/s2",
        "linear_acceleration_covariance": "(m/s2)2",
    }
    header: Header = Header()
    orientation: Quaternion = Quaternion()
    orientation_covariance: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """3 x 3 [rad2]; a first element of -1 means that no orientation is measured."""
    angular_velocity: Vector3 = Vector3()
    """[rad/s]"""
    angular_velocity_covariance: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """3 x 3 [(rad/s)2]; a first element of -1 means that it is not measured."""
    linear_acceleration: Vector3 = Vector3()
    """[m/s2]"""
    linear_acceleration_covariance: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """3 x 3 [(m/s2)2]; a first element of -1 means that it is not measured."""


class JointState(Msg, frozen=True, gc=False):
    """Joints by name; each list is as long as name or empty."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/JointState"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "string[]",
        "float64[]",
        "float64[]",
        "float64[]",
    )
    header: Header = Header()
    name: list[str] = []
    position: Float64Array = field(default_factory=Float64Array)
    """[rad] or [m]"""
    velocity: Float64Array = field(default_factory=Float64Array)
    """[rad/s] or [m/s]"""
    effort: Float64Array = field(default_factory=Float64Array)
    """[N m] or [N]"""


class Joy(Msg, frozen=True, gc=False):
    """State of a gamepad's axes and buttons."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/Joy"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "float32[]", "int32[]")
    header: Header = Header()
    axes: Float32Array = field(default_factory=Float32Array)
    """-1 to 1 each."""
    buttons: Int32Array = field(default_factory=Int32Array)
    """1 pressed, 0 not."""


class JoyFeedback(Msg, frozen=True, gc=False):
    """Feedback of a gamepad, as its rumble."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/JoyFeedback"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("uint8", "uint8", "float32")
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 3

    TYPE_LED: ClassVar[int] = 0
    TYPE_RUMBLE: ClassVar[int] = 1
    TYPE_BUZZER: ClassVar[int] = 2

    type: uint8 = 0
    """One of TYPE_…."""
    id: uint8 = 0
    """Which one of its kind, from 0."""
    intensity: float = 0.0
    """0 to 1."""


class JoyFeedbackArray(Msg, frozen=True, gc=False):
    """Some of what a gamepad is to do."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/JoyFeedbackArray"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("sensor_msgs/JoyFeedback[]",)
    array: list[JoyFeedback] = []


class LaserEcho(Msg, frozen=True, gc=False):
    """All that came back from one beam."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/LaserEcho"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("float32[]",)
    echoes: Float32Array = field(default_factory=Float32Array)
    """Metres for ranges, in the sensor's own unit for intensities; the first is the nearest."""


class LaserScan(Msg, frozen=True, gc=False):
    """One sweep of a planar laser."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/LaserScan"
    ROSTYPES: ClassVar[tuple[str, ...]] = (
        "std_msgs/Header",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32",
        "float32[]",
        "float32[]",
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
    ranges: Float32Array = field(default_factory=Float32Array)
    """[m]; +inf nothing in range, -inf too close, NaN invalid (REP-117). JSON turns all three into NaN."""
    intensities: Float32Array = field(default_factory=Float32Array)
    """In the sensor's own unit; empty when it measures none."""


class MagneticField(Msg, frozen=True, gc=False):
    """The magnetic field at the sensor."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/MagneticField"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "geometry_msgs/Vector3", "float64[9]")
    UNITS: ClassVar[dict[str, str]] = {"magnetic_field": "T", "magnetic_field_covariance": "T2"}
    header: Header = Header()
    magnetic_field: Vector3 = Vector3()
    """[T]; NaN for what is not measured."""
    magnetic_field_covariance: _Float64x9 = field(default_factory=lambda: [0.0] * 9)
    """3 x 3 [T2]; all 0 when it is not known."""


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
    """Kind of a satellite fix."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/NavSatStatus"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("int8", "uint16")
    CONSTTYPES: ClassVar[tuple[str, ...]] = (
        "int8",
        "int8",
        "int8",
        "int8",
        "uint16",
        "uint16",
        "uint16",
        "uint16",
    )

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
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 4
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
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 8
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
    """Number of consecutive values of that name."""


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
    """Fields of each point."""
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
    CONSTTYPES: ClassVar[tuple[str, ...]] = ("uint8",) * 2
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
    """Relative humidity of the air."""

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
    """Time of another clock."""

    MSGTYPE: ClassVar[str] = "sensor_msgs/TimeReference"
    ROSTYPES: ClassVar[tuple[str, ...]] = ("std_msgs/Header", "time", "string")
    header: Header = Header()
    """Our clock at that moment."""
    time_ref: Time = Time()
    """The other clock."""
    source: str = ""
    """Which clock that is."""
