"""Rule of signals: which topics of a robot a control may send to, and who must listen there.

Whatever drives, stops or commands a robot has a way of its own, with limits, an expiry and a dead man; no signal goes there.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Protocol

from bridge.core.topic_choice import OURS
from bridge.core.topics import TOPICS
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from widgets.core.language import mark, tr

__all__ = ["Offer", "hearing_fault", "is_owned", "topic_fault"]

DRIVING = (Twist.MSGTYPE, TwistStamped.MSGTYPE)
"""Types that drive a robot; they go by the drive slot only."""
_TABLE = frozenset(entry.name for entry in TOPICS)
BRIDGES = ("rosbridge", "/client_")
"""Parts of the names of nodes that stand for handhelds and other clients, not for a part of the robot."""

NO_PROGRAM = mark(
    "A Pilothouse robot takes no switches: only a program connected to it could listen to {topic}, and none does."
)


class Offer(Protocol):
    """What a robot offers, as far as this needs it."""

    @property
    def topics(self) -> Mapping[str, str]:
        """ROS 1 type by name."""

    @property
    def services(self) -> Collection[str]:
        """Names of its services."""

    @property
    def names(self) -> Mapping[str, str] | None:
        """The robot's topic for each of ours that it has; None for the usual names."""

    @property
    def ours(self) -> bool:
        """It is a Pilothouse robot."""

    @property
    def drive(self) -> str | None:
        """Topic of the drive command; None when the robot has none."""


def is_owned(offer: Offer, topic: str, services: Collection[str] = ()) -> bool:
    """Pilothouse itself uses that name: a line of its table, what stands for one, the drive topic, a service, a type of its own."""
    kind = offer.topics.get(topic, "")
    return (
        topic in _TABLE
        or topic in (offer.names or {}).values()
        or topic == offer.drive
        or topic in services
        or topic in offer.services
        or kind.startswith(OURS)
        or kind in DRIVING
    )


def topic_fault(offer: Offer | None, topic: str, kind: type[Msg], services: Collection[str] = ()) -> str:
    """Why messages of that type may not be sent to a topic, in one sentence; empty where they may.

    `services` are those that Pilothouse calls of any robot.
    """
    if offer is None:
        return tr("The robot has not said yet which topics it has.")
    if is_owned(offer, topic, services):
        return tr("{topic} belongs to driving, STOP and commands: no switch sends there.").format(topic=topic)
    told = offer.topics.get(topic)
    if told is None and offer.ours:
        return tr(NO_PROGRAM).format(topic=topic)
    if told is None:
        return tr("This robot has no topic {topic}.").format(topic=topic)
    if told != kind.MSGTYPE:
        return tr("{topic} takes {told}, not {kind}.").format(topic=topic, told=told, kind=kind.MSGTYPE)
    return ""


def hearing_fault(
    topic: str, publishers: Collection[str], subscribers: Collection[str], *, ours: bool
) -> str:
    """Why nothing is sent to a topic whose publishers and subscribers are these nodes, in one sentence; empty where it may be.

    `ours` says that it is a Pilothouse robot, whose own topics are all in the table: only a program beside it can listen.
    """
    if any(_is_robot(node) for node in publishers):
        return tr("The robot itself publishes {topic}: nothing else is sent there.").format(topic=topic)
    if ours and not any(node.startswith("/client_") for node in subscribers):
        return tr(NO_PROGRAM).format(topic=topic)
    if not ours and not any(_is_robot(node) for node in subscribers):
        return tr("Nothing on the robot listens to {topic}.").format(topic=topic)
    return ""


def _is_robot(node: str) -> bool:
    return not any(part in node for part in BRIDGES)
