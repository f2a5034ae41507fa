"""Subscriptions, publishers and latched messages of all topics of one server."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Protocol

from msgspec import Raw

from bridge.codec import Unread, check_paths
from bridge.core.errors import BridgeError, ProtocolError
from bridge.core.topics import CAMERA as CAMERA_TOPIC
from bridge.core.topics import Topic, camera_topics
from bridge.msgs import TYPES, Msg, ros1_name
from bridge.protocol import Subscribed
from bridge.protocol.merging import MAX_FIELDS
from bridge.server.flow.outgoing_messages import OutgoingMessage, Reduce
from bridge.server.flow.priority_lanes import Lane, Stream
from bridge.server.flow.quality_levels import Picture

__all__ = ["CAMERA_TOPIC", "MAX_TOPICS", "Channel", "Listener", "Switchboard", "Watcher"]

MAX_TOPICS = 2000
"""Most topics of clients."""
MAX_LATCHED_BYTES = 67_108_864
"""Most bytes that one client may have latched."""
MAX_LATCHED_BYTES_IN_ALL = 268_435_456
"""Most bytes that all clients may have latched."""
LARGE = frozenset(
    {
        "nav_msgs/OccupancyGrid",
        "sensor_msgs/CompressedImage",
        "sensor_msgs/Image",
        "sensor_msgs/PointCloud",
        "sensor_msgs/PointCloud2",
    }
)
"""Types of large messages, which are sent after the others."""
MAX_QUEUED = 100
"""Most messages of a client's topic that wait for a slow subscriber when they are no samples of a stream."""


MsgClass = type[Msg]


class Listener(Protocol):
    """A subscriber of topics."""

    def deliver(self, stream: Stream, message: OutgoingMessage) -> None:
        """Handle one message; returns at once."""


class Watcher(Protocol):
    """A watcher of one camera."""

    def offer(self, picture: Picture) -> None:
        """Handle one picture; returns at once."""


class Channel:
    """One topic: the robot's own, or one of clients."""

    def __init__(self, name: str, type: str, entry: Topic | None = None) -> None:
        self.name = name
        self.type = type
        """ROS 1 name."""
        self.entry = entry
        """Its line in the robot's table; None for a topic of clients."""
        self.cls: MsgClass | None = entry.type if entry else TYPES.get(type)
        """None when the type is not known here: its messages are passed on as they are."""
        self.streams: dict[Listener, Stream] = {}
        """Subscribers, each with its stream."""
        self.publishers: set[object] = set()
        """Clients that advertised it."""
        self.last: dict[object, OutgoingMessage] = {}
        """The last message of each publisher that latches; the robot itself is None."""
        self.latched = entry is not None and entry.latched and entry.to != "robot"
        """Whether the robot's last message is kept for later subscribers."""
        self.lane, self.keep = _manner(self)

    @property
    def idle(self) -> bool:
        """Whether it is a client's topic without publishers and subscribers."""
        return self.entry is None and not self.streams and not self.publishers


def _manner(channel: Channel) -> tuple[Lane, int]:
    """The lane of its messages, and the number of them that may wait; 0 for all."""
    entry, cls = channel.entry, channel.cls
    if channel.type in LARGE:
        return Lane.BULK, 1
    if entry is not None:
        return (Lane.TELEMETRY, 1) if entry.rate > 0 else (Lane.EVENT, 0)
    sampled = cls is not None and "header" in cls.__struct_fields__
    return Lane.TELEMETRY, 1 if sampled else MAX_QUEUED


class Switchboard:
    """Passes messages on to subscribers and pictures on to watchers, and reports the demand for each topic."""

    def __init__(
        self,
        topics: Iterable[Topic],
        on_demand: Callable[[str, bool], None],
        *,
        reduce: Reduce | None = None,
        now: Callable[[], float] = float,
        cameras: Iterable[str] = (),
    ) -> None:
        """`on_demand(topic, wanted)` is called when the first subscriber of `topic` comes and when the last one
        leaves.

        A watcher of one of `cameras` counts as a subscriber of its topic, and of any other camera as one of the first
        one's. `reduce` makes less of messages for those who ask for it; `now` is the operators' clock [s].
        """
        self.topics = {entry.name: entry for entry in topics}
        """The robot's own, by absolute name."""
        self.channels = {
            entry.name: Channel(entry.name, entry.type.MSGTYPE, entry) for entry in self.topics.values()
        }
        """All topics, by absolute name."""
        self._on_demand = on_demand
        self._reduce = reduce
        self._now = now
        self._cameras = camera_topics(cameras)
        self._watchers: dict[str, set[Watcher]] = {}
        self._latched: dict[object, int] = {}

    def publish(self, topic: str, msg: Msg) -> None:
        """Pass a message of the robot on; BridgeError for a topic that is not in its table."""
        channel = self.channels.get(topic)
        if channel is None or channel.entry is None:
            raise BridgeError(f"There is no topic {topic} in the table.")
        self.pass_on(channel, msg, None, latch=channel.latched)

    def pass_on(self, channel: Channel, msg: Msg | Raw | Unread, publisher: object, *, latch: bool) -> None:
        """Pass a message of `publisher`, None for the robot, on to all subscribers, and to later ones when latched.

        ProtocolError when clients have too much latched already: no subscriber gets it then.
        """
        if not channel.streams and not latch:
            return
        message = OutgoingMessage(channel.name, msg, self._reduce, self._now)
        if latch:
            self._latch(channel, message, publisher)
        for listener, stream in channel.streams.items():
            listener.deliver(stream, message)

    def subscribe(self, listener: Listener, topic: str, wanted: Subscribed, type: str = "") -> None:
        """Subscribe `topic` for `listener` in this form; what is latched there is delivered at once.

        ProtocolError when there is no such topic and no type is given, or too many topics.
        """
        channel = self.channels.get(topic) or self._make(topic, type)
        if not self.wanted(topic) and channel.entry is not None:
            self._on_demand(topic, True)
        stream = channel.streams.get(listener)
        if stream is None:
            stream = channel.streams[listener] = Stream(topic, channel.lane, wanted, channel.keep)
        else:
            stream.want(wanted, channel.keep)
        for message in list(channel.last.values()):
            listener.deliver(stream, message)

    def alter(self, listener: Listener, topic: str, wanted: Subscribed) -> None:
        """Change the form of a subscription; no error when there is none."""
        channel = self.channels.get(topic)
        if channel is not None and listener in channel.streams:
            channel.streams[listener].want(wanted, channel.keep)

    def unsubscribe(self, listener: Listener, topic: str) -> Stream | None:
        """End a subscription; returns its stream, None when there was none."""
        channel = self.channels.get(topic)
        stream = channel.streams.pop(listener, None) if channel else None
        if channel is not None and stream is not None:
            if channel.entry is not None:
                self._left(topic)
            self._tidy(channel)
        return stream

    def advertise(self, publisher: object, topic: str, type: str) -> Channel:
        """Note that `publisher` is going to publish on `topic`; ProtocolError as for `subscribe`."""
        channel = self.channels.get(topic) or self._make(topic, type)
        channel.publishers.add(publisher)
        return channel

    def unadvertise(self, publisher: object, topic: str) -> None:
        """Note that `publisher` no longer publishes on `topic`, and forget what it latched there."""
        channel = self.channels.get(topic)
        if channel is not None:
            channel.publishers.discard(publisher)
            forgotten = channel.last.pop(publisher, None)
            if forgotten is not None:
                self._count(publisher, -forgotten.size)
            self._tidy(channel)

    def check(self, topic: str, type: str | None) -> None:
        """ProtocolError when `topic` exists and has another type."""
        channel = self.channels.get(topic)
        if channel is not None and type and type != "*" and ros1_name(type) != channel.type:
            raise ProtocolError(f"{topic} is {channel.type}, not {type[:100]}.")

    def check_fields(self, topic: str, paths: Sequence[str] | None) -> None:
        """ProtocolError when `topic` is one of the robot's and lacks the fields of `paths`.

        More paths than a subscription may have are not checked.
        """
        entry = self.topics.get(topic)
        if entry is not None and paths is not None and len(paths) <= MAX_FIELDS:
            check_paths(entry.type, paths)

    def watch(self, watcher: Watcher, camera: str) -> None:
        """Note that `watcher` wants the frames of `camera`."""
        topic = self._topic_of(camera)
        if not self.wanted(topic):
            self._on_demand(topic, True)
        self._watchers.setdefault(camera, set()).add(watcher)

    def unwatch(self, watcher: Watcher, camera: str) -> None:
        """Note that `watcher` no longer wants the frames of `camera`."""
        self._watchers[camera].discard(watcher)
        if not self._watchers[camera]:
            del self._watchers[camera]
        self._left(self._topic_of(camera))

    def _topic_of(self, camera: str) -> str:
        return self._cameras.get(camera, CAMERA_TOPIC)

    def publish_frame(self, camera: str, picture: Picture) -> None:
        """Pass a picture on to the watchers of `camera`."""
        for watcher in self._watchers.get(camera, ()):
            watcher.offer(picture)

    def wanted(self, topic: str) -> bool:
        """Whether `topic` has a subscriber."""
        channel = self.channels.get(topic)
        subscribed = channel is not None and bool(channel.streams)
        return subscribed or any(self._topic_of(camera) == topic for camera in self._watchers)

    def _latch(self, channel: Channel, message: OutgoingMessage, publisher: object) -> None:
        """Keep a message for later subscribers in the place of the publisher's last one; the robot's own are not
        counted."""
        if publisher is not None:
            before = channel.last.get(publisher)
            freed = 0 if before is None else before.size
            own = self._latched.get(publisher, 0) - freed
            others = sum(self._latched.values()) - freed
            for held, most, whose in (
                (own, MAX_LATCHED_BYTES, "one client"),
                (others, MAX_LATCHED_BYTES_IN_ALL, "all clients"),
            ):
                if held + message.size > most:
                    raise ProtocolError(
                        f"A message of {message.size} bytes on {channel.name[:100]} cannot be latched: what {whose} latched"
                        f" may have at most {most} bytes, and {held} are taken."
                    )
            self._count(publisher, message.size - freed)
        channel.last[publisher] = message

    def _count(self, publisher: object, more: int) -> None:
        """Add to the latched bytes of `publisher`; the robot, None, is not counted."""
        if publisher is not None:
            self._latched[publisher] = self._latched.get(publisher, 0) + more
            if not self._latched[publisher]:
                del self._latched[publisher]

    def _make(self, topic: str, type: str) -> Channel:
        name = ros1_name(type)
        if "/" not in name:
            raise ProtocolError(f"There is no topic {topic[:100]} here, and a new one needs its type.")
        if len(self.channels) - len(self.topics) >= MAX_TOPICS:
            raise ProtocolError(
                f"There are {MAX_TOPICS} topics of clients already; {topic[:100]} is one too many."
            )
        channel = self.channels[topic] = Channel(topic, name)
        return channel

    def _tidy(self, channel: Channel) -> None:
        if channel.idle:
            self.channels.pop(channel.name, None)

    def _left(self, topic: str) -> None:
        if not self.wanted(topic):
            self._on_demand(topic, False)
