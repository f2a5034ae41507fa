"""Capabilities of a robot, as its rosapi lists them, and which of its topics take the place of the usual ones.

On a robot of ours every topic has its usual name. Any other has names of its own: `/scan_front`, `/imu`,
`/turtle1/cmd_vel`. Among them `bridge.core.topic_choice` chooses.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bridge.core.errors import BridgeError, NoReply, NotConnected
from bridge.core.topic_choice import CAMERA, DRIVE, OURS, command, source
from bridge.core.topics import TOPICS
from bridge.msgs import Msg, ros1_name
from bridge.msgs.geometry_msgs import TwistStamped
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.rosapi_msgs import ServicesResponse, TopicsResponse
from widgets.core.language import tr

__all__ = ["CAMERA", "DRIVE", "MANOEUVRE", "POSE", "Capabilities", "ask_capabilities"]

MANOEUVRE = "/cmd_manoeuvre"
"""Where a robot of ours is driven by what a twist does not say."""
POSE = "/pose"
"""Our name of where the robot is."""
ANSWER_TIMEOUT = 3.0
"""For one answer about what there is [s]."""


@dataclass(frozen=True)
class Capabilities:
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
    def of(
        cls, topics: Mapping[str, str], services: frozenset[str], before: Capabilities | None = None
    ) -> Capabilities:
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
                kind = entry.type.MSGTYPE
                found = old if topics.get(old) == kind else source(entry.name, kind, topics)
                if found:
                    names[entry.name] = found
        drive = before.drive if before is not None and before.names is not None else None
        if drive not in topics:
            told = command(topics)
            drive = told and told.topic
        return cls(topics, services, True, names, drive)

    @property
    def ours(self) -> bool:
        """It is a robot with Pilothouse's own services: one with a STOP that it confirms."""
        return self.topics.get("/control/status") == f"{OURS}ControlStatus" and "/stop" in self.services

    @property
    def stamped(self) -> bool:
        """It is driven by TwistStamped instead of Twist."""
        return self.topics.get(self.drive or "") == TwistStamped.MSGTYPE

    @property
    def steers(self) -> bool:
        """It takes manoeuvres, for what a twist does not say."""
        return self.ours and self.topics.get(MANOEUVRE) == Manoeuvre.MSGTYPE

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
            return tr("This robot lists no services (it runs no rosapi): trying the usual names.")
        told = tr("This robot has no Pilothouse services: no tasks, and STOP sends zero speed.")
        return tr("{told} Its place is by odometry.").format(told=told) if self.pose_by_odometry else told


NO_CAPABILITIES = Capabilities({}, frozenset(), rosapi=False)
"""Of a robot that tells nothing."""


async def ask_capabilities(
    call: Callable[..., Awaitable[Any]], before: Capabilities | None = None
) -> Capabilities:
    """Find out what a robot offers, by a client's `call`. Raises NoReply or NotConnected."""
    found = await asyncio.gather(
        call("/rosapi/topics", None, TopicsResponse, timeout=ANSWER_TIMEOUT),
        call("/rosapi/services", None, ServicesResponse, timeout=ANSWER_TIMEOUT),
        return_exceptions=True,
    )
    for one in found:
        if isinstance(one, NoReply | NotConnected) or not isinstance(one, Msg | BridgeError):
            raise one
    topics, services = found
    if not isinstance(topics, TopicsResponse):
        return NO_CAPABILITIES
    known = {name: ros1_name(kind) for name, kind in zip(topics.topics, topics.types, strict=False)}
    return Capabilities.of(
        known, frozenset(services.services if isinstance(services, ServicesResponse) else ()), before
    )
