"""Which topics of a robot that is not ours stand for which of ours: by the usual names, else by type."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bridge.msgs import Msg, ros1_name
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import Following, RobotInfo, TagRead
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage, Imu, JointState, LaserScan, NavSatFix
from robotside.autonomy import CAMERA

__all__ = ["Found", "match", "usual"]


@dataclass(frozen=True)
class _Part:
    """Something that a robot may offer."""

    ours: str
    type: type[Msg]
    names: tuple[str, ...]
    """What robots usually call it, the likeliest first."""
    without: str = ""
    """What is said when there is none; empty when nobody will miss it."""


_PARTS = (
    _Part(
        "/odom",
        Odometry,
        ("/odom", "/odometry/filtered", "/odometry"),
        "There is no odometry: the speed is not known and it drives by hand only.",
    ),
    _Part("/scan", LaserScan, ("/scan", "/base_scan"), "There is no laser: it drives by hand only."),
    _Part("/map", OccupancyGrid, ("/map",), "There is no map: it drives by hand only."),
    _Part(CAMERA, CompressedImage, (CAMERA, "/image_raw/compressed"), "There is no camera."),
    _Part("/battery_state", BatteryState, ("/battery_state", "/battery"), "There is no word of the battery."),
    _Part("/imu/data", Imu, ("/imu/data", "/imu")),
    _Part("/fix", NavSatFix, ("/fix", "/gps/fix")),
    _Part("/joint_states", JointState, ("/joint_states",)),
    _Part("/robot/info", RobotInfo, ("/robot/info",)),
    _Part("/tag", TagRead, ("/tag",)),
    _Part("/following", Following, ("/following",)),
)

_COMMAND = "/cmd_vel"
_NO_COMMAND = f"No topic takes drive commands: they are sent on {_COMMAND}, where a drive may listen later."
_NOT_TOLD = "It does not tell its topics: the usual names are supposed."


@dataclass(frozen=True)
class Found:
    """What a robot offers."""

    topics: Mapping[str, tuple[str, type[Msg]]]
    """By our name, the robot's own name of the topic and its type."""
    command: str = _COMMAND
    """The topic that takes drive commands."""
    stamped: bool = False
    """It takes TwistStamped instead of Twist."""
    remarks: Sequence[str] = ()
    """What is missing or was guessed, one sentence each."""


def usual() -> Found:
    """What is supposed of a robot that does not tell."""
    topics = {part.ours: (part.names[0], part.type) for part in _PARTS}
    return Found(topics, remarks=(_NOT_TOLD,))


def match(offered: Mapping[str, str]) -> Found:
    """What fits of the topics `offered`, types by name, in ROS 1 or ROS 2 spelling."""
    types = {name: ros1_name(kind) for name, kind in offered.items()}
    topics: dict[str, tuple[str, type[Msg]]] = {}
    remarks: list[str] = []
    for part in _PARTS:
        name = _likeliest(types, part.type.MSGTYPE, part.names)
        if name:
            topics[part.ours] = name, part.type
        if name and name not in part.names:
            remarks.append(f"{name} is taken for {part.ours}, by its type.")
        elif not name and part.without:
            remarks.append(part.without)
    command, stamped = _command(types)
    if not command:
        remarks.append(_NO_COMMAND)
    elif command != _COMMAND:
        remarks.append(f"It is driven on {command}.")
    return Found(topics, command or _COMMAND, stamped, tuple(remarks))


def _command(types: Mapping[str, str]) -> tuple[str, bool]:
    """The topic of drive commands, empty when there is none, and whether they are stamped."""
    for kind, stamped in ((Twist.MSGTYPE, False), (TwistStamped.MSGTYPE, True)):
        if types.get(_COMMAND) == kind:
            return _COMMAND, stamped
    for kind, stamped in ((Twist.MSGTYPE, False), (TwistStamped.MSGTYPE, True)):
        # only what is called like it: other twists may be what the robot measures, or another's commands
        called = [name for name, its in types.items() if its == kind and name.endswith("cmd_vel")]
        if called:
            return _first(called), stamped
    return "", False


def _likeliest(types: Mapping[str, str], kind: str, names: Sequence[str]) -> str:
    for name in names:
        if types.get(name) == kind:
            return name
    return _first([name for name, its in types.items() if its == kind])


def _first(names: Sequence[str]) -> str:
    """The shortest, as the least special; by the alphabet among equals; empty of none."""
    return min(names, key=lambda name: (len(name), name), default="")
