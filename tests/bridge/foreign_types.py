"""What the server that is not ours knows of ROS's types; made for it alone, so that it shares no mistake with `bridge`.

A message is a dict in ROS 1's spelling (secs, nsecs) with every field filled and uint8[] as bytes.
"""

from __future__ import annotations

import base64
import math
import re
import struct
import time
from typing import Any

import cbor2

TEXT = """
std_msgs/Header: uint32 seq, time stamp, string frame_id
std_msgs/String: string data
std_msgs/Bool: bool data
std_msgs/Float64: float64 data
std_msgs/Int32: int32 data
std_msgs/UInt8MultiArray: uint8[] data
geometry_msgs/Vector3: float64 x, float64 y, float64 z
geometry_msgs/Point: float64 x, float64 y, float64 z
geometry_msgs/Quaternion: float64 x, float64 y, float64 z, float64 w
geometry_msgs/Pose: geometry_msgs/Point position, geometry_msgs/Quaternion orientation
geometry_msgs/PoseStamped: std_msgs/Header header, geometry_msgs/Pose pose
geometry_msgs/PoseWithCovariance: geometry_msgs/Pose pose, float64[36] covariance
geometry_msgs/PoseWithCovarianceStamped: std_msgs/Header header, geometry_msgs/PoseWithCovariance pose
geometry_msgs/Twist: geometry_msgs/Vector3 linear, geometry_msgs/Vector3 angular
geometry_msgs/TwistStamped: std_msgs/Header header, geometry_msgs/Twist twist
geometry_msgs/TwistWithCovariance: geometry_msgs/Twist twist, float64[36] covariance
nav_msgs/Odometry: std_msgs/Header header, string child_frame_id, geometry_msgs/PoseWithCovariance pose, geometry_msgs/TwistWithCovariance twist
nav_msgs/MapMetaData: time map_load_time, float32 resolution, uint32 width, uint32 height, geometry_msgs/Pose origin
nav_msgs/OccupancyGrid: std_msgs/Header header, nav_msgs/MapMetaData info, int8[] data
nav_msgs/Path: std_msgs/Header header, geometry_msgs/PoseStamped[] poses
sensor_msgs/Imu: std_msgs/Header header, geometry_msgs/Quaternion orientation, float64[9] orientation_covariance, geometry_msgs/Vector3 angular_velocity, float64[9] angular_velocity_covariance, geometry_msgs/Vector3 linear_acceleration, float64[9] linear_acceleration_covariance
sensor_msgs/LaserScan: std_msgs/Header header, float32 angle_min, float32 angle_max, float32 angle_increment, float32 time_increment, float32 scan_time, float32 range_min, float32 range_max, float32[] ranges, float32[] intensities
sensor_msgs/BatteryState: std_msgs/Header header, float32 voltage, float32 temperature, float32 current, float32 charge, float32 capacity, float32 design_capacity, float32 percentage, uint8 power_supply_status, uint8 power_supply_health, uint8 power_supply_technology, bool present, float32[] cell_voltage, float32[] cell_temperature, string location, string serial_number
sensor_msgs/CompressedImage: std_msgs/Header header, string format, uint8[] data
acme_msgs/Finger: string name, float32 force, float32 opening, bool touching
acme_msgs/Gripper: std_msgs/Header header, uint8 mode, acme_msgs/Finger[] fingers, geometry_msgs/Vector3 tip, float64[3] limits, int16[] raw, duration since_closed
std_srvs/EmptyRequest:
std_srvs/EmptyResponse:
std_srvs/TriggerRequest:
std_srvs/TriggerResponse: bool success, string message
std_srvs/SetBoolRequest: bool data
std_srvs/SetBoolResponse: bool success, string message
example_interfaces/FibonacciGoal: int32 order
example_interfaces/FibonacciResult: int32[] sequence
example_interfaces/FibonacciFeedback: int32[] sequence
"""
CONSTANTS = {"acme_msgs/Gripper": {"MODE_OPEN": 0, "MODE_CLOSED": 1}}

FORMATS = {
    "bool": "?",
    **{f"{sign}int{bits}": code for bits, pair in zip((8, 16, 32, 64), ("bB", "hH", "iI", "qQ"), strict=True)
       for sign, code in zip(("", "u"), pair, strict=True)},
    "float32": "f",
    "float64": "d",
}  # fmt: skip
TAGS = {"uint16": 69, "uint32": 70, "uint64": 71, "int8": 72, "int16": 77, "int32": 78, "int64": 79,
        "float32": 85, "float64": 86}  # fmt: skip
"""Typed arrays of RFC 8746, little end first."""
ROS2_NAMES = {"float32": "float", "float64": "double", "bool": "boolean", "time": "builtin_interfaces/Time",
              "duration": "builtin_interfaces/Duration"}  # fmt: skip


class Unfit(Exception):
    """A value is none of its type."""


Field = tuple[str, str, int]
"""Name, type, and how many: -1 one, 0 any number, else exactly so many."""


def _field(text: str) -> Field:
    kind, name = text.split()
    base, bracket, many = kind.partition("[")
    return name, base, int(many.rstrip("]") or 0) if bracket else -1


TYPES: dict[str, list[Field]] = {
    name: [_field(part) for part in rest.split(",") if part.strip()]
    for name, _, rest in (line.partition(":") for line in TEXT.strip().splitlines())
}


def internal(name: str, ros: int) -> str:
    """ROS 1's spelling of a type; Unfit for ROS 2's spelling where only ROS 1's is understood, or an unknown type."""
    short = re.sub(r"/(msg|srv|action)/", "/", name) if ros == 2 else name
    if short.count("/") != 1:
        raise Unfit(f"{name} is not a valid type name")
    return short


def spelled(name: str, ros: int, kind: str = "msg") -> str:
    """How a type is named to clients."""
    return name.replace("/", f"/{kind}/") if ros == 2 else name


def _one(base: str, value: Any) -> Any:
    if base in TYPES:
        return shaped(base, value)
    if base in ("time", "duration"):
        return _stamp(value)
    if base == "string" and isinstance(value, str):
        return value
    if base == "bool" and isinstance(value, bool):
        return value
    if base.startswith("float") and isinstance(value, int | float) and not isinstance(value, bool):
        return float(value)
    if "int" in base and isinstance(value, int) and not isinstance(value, bool):
        return _whole(base, value)
    raise Unfit(f"{value!r} is no {base}")


def _whole(base: str, value: int) -> int:
    try:
        struct.pack("<" + FORMATS[base], value)
    except struct.error as error:
        raise Unfit(f"{value} does not fit {base}") from error
    return value


def stamp_now() -> dict[str, int]:
    """This moment."""
    nanoseconds = time.time_ns()
    return {"secs": nanoseconds // 10**9, "nsecs": nanoseconds % 10**9}


def _stamp(value: Any) -> dict[str, int]:
    if value == "now":
        return stamp_now()
    if not isinstance(value, dict):
        raise Unfit(f"{value!r} is no time")
    return {
        "secs": int(value.get("secs", value.get("sec", 0))),
        "nsecs": int(value.get("nsecs", value.get("nanosec", 0))),
    }


def _many(base: str, many: int, value: Any) -> Any:
    if base == "uint8":
        data = base64.b64decode(value) if isinstance(value, str) else bytes(value)
        if many > 0 and len(data) != many:
            raise Unfit(f"{len(data)} bytes for {many}")
        return data
    if not isinstance(value, list | tuple) or (many > 0 and len(value) != many):
        raise Unfit(f"{value!r:.40} is no {base}[{many or ''}]")
    return [_one(base, item) for item in value]


def _default(base: str, many: int) -> Any:
    if many >= 0:
        return bytes(many) if base == "uint8" else [_default(base, -1) for _ in range(many)]
    if base in TYPES:
        return {name: _default(kind, length) for name, kind, length in TYPES[base]}
    if base in ("time", "duration"):
        return {"secs": 0, "nsecs": 0}
    return {"string": "", "bool": False}.get(base, 0.0 if base.startswith("float") else 0)


def shaped(kind: str, value: Any) -> dict[str, Any]:
    """A message with every field, made of what a client sent; Unfit when it does not fit."""
    if not isinstance(value, dict):
        raise Unfit(f"{value!r} is no {kind}")
    fields = {name: (base, many) for name, base, many in TYPES[kind]}
    unknown = set(value) - set(fields)
    if unknown:
        raise Unfit(f"{kind} has no {unknown}")
    made = {}
    for name, (base, many) in fields.items():
        if name in value:
            made[name] = _many(base, many, value[name]) if many >= 0 else _one(base, value[name])
        elif (kind, name) == ("std_msgs/Header", "stamp"):
            made[name] = stamp_now()
        else:
            made[name] = _default(base, many)
    return made


def outward(kind: str, msg: dict[str, Any], ros: int) -> dict[str, Any]:
    """As it travels in JSON: base64, null for what is not finite, the names of `ros` for stamps."""

    def one(base: str, value: Any) -> Any:
        if base in TYPES:
            return outward(base, value, ros)
        if base in ("time", "duration") and ros == 2:
            return {"sec": value["secs"], "nanosec": value["nsecs"]}
        return None if isinstance(value, float) and not math.isfinite(value) else value

    made = {}
    for name, base, many in TYPES[kind]:
        if ros == 2 and (kind, name) == ("std_msgs/Header", "seq"):
            continue
        value = msg[name]
        if many >= 0:
            made[name] = (
                base64.b64encode(value).decode() if base == "uint8" else [one(base, v) for v in value]
            )
        else:
            made[name] = one(base, value)
    return made


def to_cbor(kind: str, msg: dict[str, Any], ros: int) -> dict[str, Any]:
    """As it travels in CBOR; Unfit for what the real servers lose: fixed arrays, in ROS 1 arrays of strings too."""
    made = {}
    for name, base, many in TYPES[kind]:
        if ros == 2 and (kind, name) == ("std_msgs/Header", "seq"):
            continue
        value = msg[name]
        if many > 0 or (many == 0 and base == "string" and ros == 1):
            raise Unfit(f"{kind}.{name} has no CBOR form")
        if many == 0 and base in TAGS:
            made[name] = cbor2.CBORTag(TAGS[base], struct.pack(f"<{len(value)}{FORMATS[base]}", *value))
        elif many == 0 and base in TYPES:
            made[name] = [to_cbor(base, item, ros) for item in value]
        elif base in TYPES:
            made[name] = to_cbor(base, value, ros)
        elif base in ("time", "duration") and ros == 2:
            made[name] = {"sec": value["secs"], "nanosec": value["nsecs"]}
        else:
            made[name] = value
    return made


def to_bytes(kind: str, msg: dict[str, Any]) -> bytes:
    """ROS 1's own serialisation."""

    def one(base: str, value: Any) -> bytes:
        if base in TYPES:
            return to_bytes(base, value)
        if base in ("time", "duration"):
            return struct.pack("<ii" if base == "duration" else "<II", value["secs"], value["nsecs"])
        if base == "string":
            return struct.pack("<I", len(value.encode())) + value.encode()
        return struct.pack("<" + FORMATS[base], value)

    parts = []
    for name, base, many in TYPES[kind]:
        value = msg[name]
        if many == 0:
            parts.append(struct.pack("<I", len(value)))
        if many >= 0:
            parts.append(value if base == "uint8" else b"".join(one(base, item) for item in value))
        else:
            parts.append(one(base, value))
    return b"".join(parts)


def typedefs(kind: str, ros: int) -> list[dict[str, Any]]:
    """A type and what it is made of, as `/rosapi/message_details` tells; Unfit for an unknown one."""
    if kind not in TYPES:
        raise Unfit(f"no type {kind}")
    told: dict[str, dict[str, Any]] = {}

    def tell(name: str, fields: list[Field]) -> None:
        if name in told:
            return
        shown = [field for field in fields if ros == 1 or (name, field[0]) != ("std_msgs/Header", "seq")]
        constants = CONSTANTS.get(name, {})
        told[name] = {
            "type": name,
            "fieldnames": [field[0] for field in shown],
            "fieldtypes": [ROS2_NAMES.get(field[1], field[1]) if ros == 2 else field[1] for field in shown],
            "fieldarraylen": [field[2] for field in shown],
            "examples": ["[]" if field[2] >= 0 else str(_default(field[1], -1)) for field in shown],
            "constnames": list(constants),
            "constvalues": [str(value) for value in constants.values()],
        }
        for _, base, _ in shown:
            if base in TYPES:
                tell(base, TYPES[base])
            elif base in ("time", "duration"):
                _tell_time(base)

    def _tell_time(base: str) -> None:
        if ros == 2:
            tell(ROS2_NAMES[base], [("sec", "int32", -1), ("nanosec", "uint32", -1)])
        else:
            tell(base, [("secs", "int32", -1), ("nsecs", "int32", -1)])

    tell(kind, TYPES[kind])
    return list(told.values())
