"""What a robot offers, as its rosapi tells, and which of its topics take the place of the usual ones.

On a robot of ours every topic has its usual name. Any other has names of its own: `/scan_front`, `/imu`,
`/turtle1/cmd_vel`. There the type decides, and among several of one type the name that says most.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bridge.errors import BridgeError, NoReply, NotConnected
from bridge.msgs import Msg, ros1_name
from bridge.topics import TOPICS, Topic

__all__ = ["CAMERA", "DRIVE", "POSE", "Offer", "ask"]

DRIVE, POSE, CAMERA = "/cmd_vel", "/pose", "/camera/image/compressed"
"""Our names of the drive command, of where the robot is, and of the pictures."""
OURS = "pilothouse_msgs/"
UNFIT = {
    "sensor_msgs/CompressedImage": ("depth",),
    "nav_msgs/OccupancyGrid": ("costmap",),
    "nav_msgs/Path": ("local",),
}
"""Of some types, words in the names of topics that hold something else than the usual one does."""
FAVOURED = ("front", "rgb", "color", "filtered")
AVOIDED = ("ground_truth", "rear", "back", "raw")
"""Words that speak for one of several topics of a type, and against one."""
STEERS = ("teleop", "joy", "cmd_vel")
"""Words of which one must be in the name of a topic that drives: others of that type are measurements."""
PATIENCE = 3.0
"""For one answer about what there is [s]."""


@dataclass(frozen=True)
class Offer:
    """What one robot offers."""

    topics: Mapping[str, str]
    """ROS 1 type by name, in the order in which the robot tells them."""
    services: frozenset[str]
    rosapi: bool = True
    """The robot tells what it offers; else the usual names are tried."""
    names: Mapping[str, str] | None = None
    """The robot's topic for each of ours that it has; None for the usual names throughout."""
    drive: str | None = DRIVE
    """Topic of the drive command; None when the robot has none."""

    @classmethod
    def of(cls, topics: Mapping[str, str], services: frozenset[str], before: Offer | None = None) -> Offer:
        """Choose among what a robot told. What was chosen `before` is kept for as long as it is there.

        For who subscribes or advertises makes a topic of that name, so that later lists hold our own wishes too.
        """
        whole = cls(topics, services)
        if whole.ours:
            return whole
        kept = before.names if before is not None and before.names is not None else {}
        names = {}
        for entry in TOPICS:
            if entry.to == "handheld":
                old = kept.get(entry.name, "")
                found = old if topics.get(old) == entry.type.MSGTYPE else _source(entry, topics)
                if found:
                    names[entry.name] = found
        drive = before.drive if before is not None and before.names is not None else None
        return cls(topics, services, True, names, drive if drive in topics else _drive(topics))

    @property
    def ours(self) -> bool:
        """It is a robot with Pilothouse's own services: one with a STOP that it confirms."""
        return self.topics.get("/control/status") == f"{OURS}ControlStatus" and "/stop" in self.services

    def serves(self, service: str) -> bool:
        """Whether it has that service."""
        return service in self.services

    def source(self, topic: str) -> str | None:
        """The robot's name for one of our topics; None when it has none."""
        return topic if self.names is None else self.names.get(topic)

    @property
    def pose_by_odometry(self) -> bool:
        """It tells no place on a map, and has no map that the place by its wheels would be wrong on."""
        return self.names is not None and POSE not in self.names and "/map" not in self.names

    @property
    def sentence(self) -> str:
        """What is missing on a robot that is not ours; empty for one that is."""
        if self.ours:
            return ""
        if not self.rosapi:
            return "This robot does not tell what it offers (it runs no rosapi): the usual names are tried."
        told = "This robot has no Pilothouse services: no missions, no tasks, and STOP sends it zero speed."
        return f"{told} Its place is reckoned by its wheels." if self.pose_by_odometry else told


NOTHING = Offer({}, frozenset(), rosapi=False)
"""Of a robot that tells nothing."""


def _source(entry: Topic, topics: Mapping[str, str]) -> str:
    """The best topic of the wanted type; empty when there is none."""
    kind = entry.type.MSGTYPE
    if topics.get(entry.name) == kind:
        return entry.name
    if kind.startswith(OURS) or (entry.on_demand and entry.name != CAMERA):
        return ""
    taken = {other.name for other in TOPICS if other is not entry}
    words = UNFIT.get(kind, ())
    fit = [
        name
        for name, told in topics.items()
        if told == kind and name not in taken and not any(word in name.lower() for word in words)
    ]
    return min(fit, key=lambda name: _distance(name, entry.name), default="")


def _distance(name: str, usual: str) -> tuple[int, int, int, str]:
    """How far a name is from the usual one; the least is best."""
    low, own = name.lower(), usual.strip("/").split("/")[0].split("_")[0]
    favour = sum(word in low for word in AVOIDED) - sum(word in low for word in FAVOURED)
    return (0 if own in low else 1, favour, len(name), name)


def _drive(topics: Mapping[str, str]) -> str | None:
    """The topic that takes drive commands; None when no name of that type says that it does."""
    twists = [name for name, kind in topics.items() if kind == "geometry_msgs/Twist"]
    if DRIVE in twists:
        return DRIVE
    fit = [name for name in twists if any(word in name.lower() for word in STEERS)]
    return min(fit, key=lambda name: (not name.endswith(DRIVE), len(name), name), default=None)


class _Topics(Msg, frozen=True, gc=False):
    """What `/rosapi/topics` answers."""

    topics: list[str] = []
    types: list[str] = []


class _Services(Msg, frozen=True, gc=False):
    """What `/rosapi/services` answers."""

    services: list[str] = []


async def ask(call: Callable[..., Awaitable[Any]], before: Offer | None = None) -> Offer:
    """Find out what a robot offers, by a client's `call`. Raises NoReply or NotConnected."""
    found = await asyncio.gather(
        call("/rosapi/topics", None, _Topics, timeout=PATIENCE),
        call("/rosapi/services", None, _Services, timeout=PATIENCE),
        return_exceptions=True,
    )
    for one in found:
        if isinstance(one, NoReply | NotConnected) or not isinstance(one, Msg | BridgeError):
            raise one
    topics, services = found
    if not isinstance(topics, _Topics):
        return NOTHING
    known = {name: ros1_name(kind) for name, kind in zip(topics.topics, topics.types, strict=False)}
    return Offer.of(known, frozenset(services.services if isinstance(services, _Services) else ()), before)
