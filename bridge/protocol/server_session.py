"""What a server remembers about one client, without I/O."""

from __future__ import annotations

from dataclasses import dataclass

from msgspec import UNSET

from bridge.codec import shown
from bridge.errors import ProtocolError
from bridge.protocol.names import absolute
from bridge.protocol.ops import (
    LEVELS,
    Advertise,
    Id,
    Reduction,
    SetLevel,
    Subscribe,
    Unadvertise,
    Unsubscribe,
)

__all__ = ["ServerSession", "Subscribed"]

NAMELESS = (None, UNSET)


@dataclass(frozen=True, slots=True)
class Subscribed:
    """What one client wants of one topic, all its subscriptions taken together."""

    name: str
    """The topic as the client wrote it."""
    period: float = 0.0
    """Shortest time between two messages [s]."""
    queue: int = 0
    """How many messages may wait; 0 as many as the server sees fit."""
    compression: str = "none"
    """One of `COMPRESSIONS`."""
    fragment_size: int | None = None
    """Longest text frame [characters]; None for no end. Binary frames are never cut."""
    reduction: Reduction | None = None
    """How much of each message it wants; None for all."""
    ros2: bool = False
    """It spells types as `pkg/msg/Type` and wants times as `sec` and `nanosec`."""


class ServerSession:
    """What a server remembers about one client."""

    def __init__(self) -> None:
        self.subscriptions: dict[str, Subscribed] = {}
        """By the topic's absolute name."""
        self.advertised: dict[str, set[Id]] = {}
        """Ids of the advertisements, by the topic's absolute name."""
        self.level = "none"
        """The least remark that the client wants: one of `LEVELS`."""
        self._asked: dict[str, dict[Id, Subscribe]] = {}

    def subscribe(self, op: Subscribe) -> str:
        """Take a subscription in; gives the topic's absolute name. The same id again replaces the first."""
        topic = absolute(op.topic)
        self._asked.setdefault(topic, {})[op.id] = op
        self._merge(topic)
        return topic

    def unsubscribe(self, op: Unsubscribe) -> str:
        """Take a subscription out; gives the topic's absolute name. An unknown one is no error."""
        topic = absolute(op.topic)
        asked = self._asked.get(topic, {})
        if op.id in NAMELESS:
            asked.clear()
        asked.pop(op.id, None)
        self._merge(topic)
        return topic

    def advertise(self, op: Advertise) -> None:
        """The client is going to publish."""
        self.advertised.setdefault(absolute(op.topic), set()).add(op.id)

    def unadvertise(self, op: Unadvertise) -> None:
        """The client no longer publishes."""
        ids = self.advertised.get(absolute(op.topic), set())
        ids.discard(op.id)
        if op.id in NAMELESS or not ids:
            self.advertised.pop(absolute(op.topic), None)

    def set_level(self, op: SetLevel) -> None:
        """The client wants remarks from this level on; ProtocolError when there is no such level."""
        if op.level not in LEVELS:
            raise ProtocolError(f"level must be one of {', '.join(LEVELS)}, not {shown(op.level)}.")
        self.level = op.level

    def wants(self, level: str) -> bool:
        """Whether a remark of this level is to be sent."""
        return self.level != "none" and LEVELS.index(level) >= LEVELS.index(self.level)

    def _merge(self, topic: str) -> None:
        asked = list(self._asked.get(topic, {}).values())
        if not asked:
            self._asked.pop(topic, None)
            self.subscriptions.pop(topic, None)
            return
        self.subscriptions[topic] = Subscribed(
            name=asked[0].topic,
            period=max(0.0, min(op.throttle_rate or 0 for op in asked) / 1000),
            compression="cbor" if any(op.compression == "cbor" for op in asked) else "none",
        )
