"""The choice of a foreign robot's topics for ours, one for the handheld and the robot side.

The usual names come first. Without one the type decides, and among several of one type the name that says most; a
topic that is known to be something else of that type is never taken.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from bridge.core.topics import TOPICS
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.msgs.std_msgs import Header, Time

__all__ = ["CAMERA", "DRIVE", "OURS", "USUAL", "Command", "command", "drive_message", "source"]

DRIVE, CAMERA = "/cmd_vel", "/camera/image/compressed"
"""Our names of the drive command and of the pictures."""

OURS = "pilothouse_msgs/"
"""Prefix of types that only our robots have: their topics have our names or are others."""

USUAL: Mapping[str, tuple[str, ...]] = {
    "/odom": ("/odometry/filtered", "/odometry"),
    "/scan": ("/base_scan",),
    CAMERA: ("/image_raw/compressed",),
    "/battery_state": ("/battery",),
    "/imu/data": ("/imu",),
    "/fix": ("/gps/fix",),
}
"""Usual names of our topics on other robots, the likeliest first."""

_UNFIT = {
    "sensor_msgs/CompressedImage": ("depth",),
    "nav_msgs/OccupancyGrid": ("costmap",),
    "nav_msgs/Path": ("local",),
}
"""By type, words in the names of topics that hold something else than the usual one does."""

_FAVOURED = ("front", "rgb", "color", "filtered")
_AVOIDED = ("ground_truth", "rear", "back", "raw")
"""Words that speak for one of several topics of a type, and against one."""

_SIDES = ("/range/left", "/range/right", "/range/rear")
"""Topics whose name alone says what is measured: a sensor that looks ahead cannot stand for them."""

_EXACT = frozenset({*(entry.name for entry in TOPICS if entry.on_demand and entry.name != CAMERA), *_SIDES})
"""Our topics that are taken by their name only."""

_STEERS = ("teleop", "joy", "cmd_vel")
"""The name of a topic that drives must contain one of these words: others of its types are measurements."""

_DRIVES = {Twist.MSGTYPE: False, TwistStamped.MSGTYPE: True}


class Command(NamedTuple):
    """The topic for drive commands."""

    topic: str
    """Name of the topic."""
    stamped: bool
    """Whether it takes TwistStamped instead of Twist."""


def source(ours: str, kind: str, topics: Mapping[str, str]) -> str:
    """The best of `topics` for our topic `ours` of type `kind`; empty when there is none. Types are ROS 1 names."""
    for name in (ours, *USUAL.get(ours, ())):
        if topics.get(name) == kind:
            return name
    if kind.startswith(OURS) or ours in _EXACT:
        return ""
    taken = {
        entry.name for entry in TOPICS if entry.name != ours and topics.get(entry.name) == entry.type.MSGTYPE
    }
    words = _UNFIT.get(kind, ())
    fit = [
        name
        for name, told in topics.items()
        if told == kind and name not in taken and not any(word in name.lower() for word in words)
    ]
    return min(fit, key=lambda name: _distance(name, ours), default="")


def command(topics: Mapping[str, str]) -> Command | None:
    """The topic of `topics` that drive commands go to; None when the name of none shows that it takes them."""
    found = [
        Command(name, _DRIVES[kind])
        for name, kind in topics.items()
        if kind in _DRIVES and any(word in name.lower() for word in _STEERS)
    ]
    return min(found, key=_far, default=None)


def drive_message(twist: Twist, now: float, *, stamped: bool) -> Twist | TwistStamped:
    """A drive command as the robot takes it; `now` is its clock [s], NaN while that is not known."""
    if not stamped:
        return twist
    stamp = Time.at(now) if math.isfinite(now) else Time()
    return TwistStamped(Header(stamp, "base_link"), twist)


def _far(one: Command) -> tuple[bool, bool, bool, int, str]:
    """Distance of a topic from the usual one; the least is best. Most tools send plain commands."""
    name = one.topic
    return (name != DRIVE, not name.endswith("cmd_vel"), one.stamped, len(name), name)


def _distance(name: str, usual: str) -> tuple[bool, int, int, str]:
    """Distance of a name from the usual one; the least is best."""
    low, own = name.lower(), usual.strip("/").split("/")[0].split("_")[0]
    favour = sum(word in low for word in _AVOIDED) - sum(word in low for word in _FAVOURED)
    return (own not in low, favour, len(name), name)
