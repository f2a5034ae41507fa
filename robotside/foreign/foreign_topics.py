"""The match of a foreign robot's topics with ours, as `bridge.core.topic_choice` chooses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from bridge.core.topic_choice import CAMERA, DRIVE, USUAL, command, source
from bridge.msgs import Msg, ros1_name
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus, Following, LineSensor, RobotInfo, TagRead
from bridge.msgs.sensor_msgs import (
    BatteryState,
    CompressedImage,
    Imu,
    JointState,
    LaserScan,
    NavSatFix,
    Range,
)

__all__ = ["CONTROL", "Found", "match", "usual"]

CONTROL = "/control/status"
"""Where a robot side of ours tells who drives the robot."""


@dataclass(frozen=True)
class _Part:
    """Something that a robot may offer."""

    ours: str
    type: type[Msg]
    without: str = ""
    """What is said when there is none; empty when nobody will miss it."""


_PARTS = (
    _Part(
        "/odom",
        Odometry,
        "There is no odometry: unknown speed, driving by hand only.",
    ),
    _Part("/scan", LaserScan, "There is no laser: driving by hand only."),
    _Part("/map", OccupancyGrid, "There is no map: driving by hand only."),
    _Part(CAMERA, CompressedImage, "There is no camera."),
    _Part("/battery_state", BatteryState, "There is no battery report."),
    _Part("/imu/data", Imu),
    _Part("/fix", NavSatFix),
    _Part("/joint_states", JointState),
    _Part("/line_sensor", LineSensor),
    *(_Part(f"/range/{side}", Range) for side in ("front", "left", "right", "rear")),
    _Part("/robot/info", RobotInfo),
    _Part("/tag", TagRead),
    _Part("/following", Following),
    _Part(CONTROL, ControlStatus),
)

_NO_COMMAND = f"No topic accepts drive commands; they are sent on {DRIVE}."
_NOT_TOLD = "It does not list its topics: the usual names are assumed."


@dataclass(frozen=True)
class Found:
    """What a robot offers."""

    topics: Mapping[str, tuple[str, type[Msg]]]
    """By our name, the robot's own name of the topic and its type."""
    command: str = DRIVE
    """The topic that takes drive commands."""
    stamped: bool = False
    """It takes TwistStamped instead of Twist."""
    remarks: Sequence[str] = ()
    """What is missing or was guessed, one sentence each."""


def usual() -> Found:
    """What is supposed of a robot that does not tell, which a robot side of ours always does.

    Our own types are not asked for: a server of ROS reports an error for each that it cannot import.
    """
    topics = {
        part.ours: (part.ours, part.type)
        for part in _PARTS
        if not part.type.MSGTYPE.startswith("pilothouse_msgs/")
    }
    return Found(topics, remarks=(_NOT_TOLD,))


def match(offered: Mapping[str, str]) -> Found:
    """What fits of the topics `offered`, types by name, in ROS 1 or ROS 2 spelling."""
    types = {name: ros1_name(kind) for name, kind in offered.items()}
    topics: dict[str, tuple[str, type[Msg]]] = {}
    remarks: list[str] = []
    for part in _PARTS:
        name = source(part.ours, part.type.MSGTYPE, types)
        if name:
            topics[part.ours] = name, part.type
        if name and name not in (part.ours, *USUAL.get(part.ours, ())):
            remarks.append(f"{name} is used as {part.ours}, by its type.")
        elif not name and part.without:
            remarks.append(part.without)
    told = command(types)
    if told is None:
        return Found(topics, remarks=(*remarks, _NO_COMMAND))
    if told.topic != DRIVE:
        remarks.append(f"Drive commands go to {told.topic}.")
    return Found(topics, told.topic, told.stamped, tuple(remarks))
