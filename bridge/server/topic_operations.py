"""The topic operations of one client: publish, subscribe, advertise and their opposites."""

from __future__ import annotations

from typing import Protocol, cast

from msgspec import Raw

from bridge.codec import Unread, from_builtins, from_json, from_json_now, shown, unread
from bridge.core.errors import ProtocolError, Refused
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.protocol import (
    Advertise,
    BinaryPublish,
    Publish,
    ServerSession,
    Subscribe,
    Unadvertise,
    Unsubscribe,
    absolute,
    too_deep,
)
from bridge.server.flow.send_queue import SendQueue
from bridge.server.server_context import ServerContext
from bridge.server.switchboard import Channel, Listener

__all__ = ["MAX_READ_BYTES", "Subscriber", "TopicOperations"]

MAX_READ_BYTES = 1_048_576
"""Longest message that may have missing or unknown fields [byte]: those are looked for in Python, which is slow."""


class Subscriber(Listener, Protocol):
    """A client that receives messages."""

    protocol: ServerSession
    """Its subscriptions and advertisements."""


class TopicOperations:
    """The topics that one client publishes and subscribes."""

    def __init__(
        self, client: Subscriber, operator: Operator, queue: SendQueue, context: ServerContext
    ) -> None:
        """`queue` holds what waits to be sent to the client."""
        self._client = client
        self._protocol = client.protocol
        self._operator = operator
        self._queue = queue
        self._context = context
        self._switchboard = context.switchboard
        self._resubscribed: set[str] = set()

    def publish(self, op: Publish) -> None:
        """Pass a message on; ProtocolError when the topic does not take it or it does not fit its type."""
        channel = self._channel_to_robot(op.topic)
        if channel.cls is not None:
            msg = unread(op.msg, channel.cls) if channel.entry is None else None
            if msg is None and len(op.msg) > MAX_READ_BYTES:
                raise ProtocolError(
                    f"A message on {channel.name} over {MAX_READ_BYTES} bytes must have all fields of"
                    f" {channel.type} and no other."
                )
            self._pass_on(channel, msg or self._read(channel, op), op.stamp, latch=bool(op.latch))
        elif bytes(op.msg)[:1] != b"{" or too_deep(bytes(op.msg)):
            raise ProtocolError(f"A message on {channel.name} must be an object, and not nested too deeply.")
        else:
            self._pass_on(channel, Raw(bytes(op.msg)), op.stamp, latch=bool(op.latch))

    def _read(self, channel: Channel, op: Publish) -> Msg:
        """A message that is not passed on as it is.

        What the robot takes gets no time of now: by its header's stamp an order is judged, and one that was held up on its
        way would count as new.
        """
        cls = cast(type[Msg], channel.cls)
        if channel.entry is not None:
            return from_json(op.msg, cls)
        return from_json_now(op.msg, cls, self._context.now)

    def publish_binary(self, op: BinaryPublish) -> None:
        """As `publish`, for a message that came as CBOR."""
        channel = self._channel_to_robot(op.topic)
        if channel.cls is None:
            raise ProtocolError(
                f"The type of {channel.name} is not known here, so it cannot be read as CBOR."
            )
        self._pass_on(channel, from_builtins(op.msg, channel.cls), None, latch=False)

    def subscribe(self, op: Subscribe) -> None:
        """Subscribe the client; ProtocolError when the topic has another type or is not known."""
        topic, switchboard = absolute(op.topic), self._switchboard
        self._check("subscribe", topic)
        switchboard.check(topic, op.type)
        switchboard.check_fields(topic, op.reduce.fields if op.reduce else None)
        self._protocol.subscribe(op)
        if self._protocol.is_stale(topic):
            self._resubscribed.add(topic)
            return
        try:
            switchboard.subscribe(self._client, topic, self._protocol.subscriptions[topic], op.type or "")
        except ProtocolError:
            self._protocol.unsubscribe(Unsubscribe(topic=op.topic, id=op.id))
            raise

    def unsubscribe(self, op: Unsubscribe) -> None:
        """Take a subscription back; an unknown one is no error."""
        topic = self._protocol.unsubscribe(op)
        if not self._protocol.is_stale(topic):
            self._stop_delivery(topic)

    def apply_changes(self) -> None:
        """Pass changed subscriptions on to the switchboard, once for all operations of a frame."""
        resubscribed, self._resubscribed = self._resubscribed, set()
        for topic, wanted in self._protocol.changed_subscriptions().items():
            if topic in resubscribed:
                self._switchboard.subscribe(self._client, topic, wanted)
            else:
                self._switchboard.alter(self._client, topic, wanted)

    def advertise(self, op: Advertise) -> None:
        """The client is going to publish; ProtocolError for a topic that the robot itself publishes."""
        topic, switchboard = absolute(op.topic), self._switchboard
        self._check("advertise", topic)
        switchboard.check(topic, op.type)
        own = switchboard.topics.get(topic)
        if own is not None and own.to != "robot":
            raise ProtocolError(f"{topic} is this robot's own topic.")
        self._protocol.advertise(op)
        try:
            switchboard.advertise(self._client, topic, op.type or "")
        except ProtocolError:
            self._protocol.unadvertise(Unadvertise(topic=op.topic, id=op.id))
            raise

    def unadvertise(self, op: Unadvertise) -> None:
        """The client no longer publishes; an unknown topic is no error."""
        topic = self._protocol.unadvertise(op)
        if topic not in self._protocol.advertised:
            self._switchboard.unadvertise(self._client, topic)

    def close(self) -> None:
        """End all subscriptions and advertisements of the client."""
        for topic in list(self._protocol.subscriptions):
            self._stop_delivery(topic)
        for topic in list(self._protocol.advertised):
            self._switchboard.unadvertise(self._client, topic)

    def _stop_delivery(self, topic: str) -> None:
        stream = self._switchboard.unsubscribe(self._client, topic)
        if stream is not None:
            self._queue.remove(stream)

    def _channel_to_robot(self, topic: str) -> Channel:
        channels = self._switchboard.channels
        channel = channels.get(topic) or channels.get(absolute(topic))
        if channel is None:
            raise ProtocolError(f"This robot does not listen to {shown(topic)}, and no client advertised it.")
        if channel.entry is not None:
            try:
                self._context.door.check_listens(channel.name)
            except Refused as refusal:
                raise ProtocolError(str(refusal)) from refusal
            self._check("publish", channel.name)
        else:
            self._check("relay", channel.name)
        return channel

    def _check(self, verb: str, topic: str) -> None:
        """ProtocolError with the door's sentence when the role of the client is too small."""
        try:
            self._context.door.check(self._operator, verb, topic)
        except Refused as refusal:
            raise ProtocolError(str(refusal)) from refusal

    def _pass_on(
        self, channel: Channel, msg: Msg | Raw | Unread, stamp: float | None, *, latch: bool
    ) -> None:
        if channel.entry is not None:
            # a message that fits the table is decoded; the door gives it to the robot and to those who subscribe
            self._context.door.publish(self._operator, channel.name, cast(Msg, msg), stamp)
            return
        latch = self._client in channel.publishers and (latch or self._protocol.latches(channel.name))
        self._switchboard.pass_on(channel, msg, self._client, latch=latch)
