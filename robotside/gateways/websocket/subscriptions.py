"""The topics that one client of the plain WebSocket is sent."""

from __future__ import annotations

from collections.abc import Callable, Collection

from bridge.core.errors import ProtocolError, Refused
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import CAMERA, Topic, camera_topics
from bridge.msgs import Msg
from bridge.msgs.nav_msgs import OccupancyGrid
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.protocol import Subscribed
from bridge.server.flow.priority_lanes import Lane, Stream
from bridge.server.flow.send_queue import SendQueue
from robotside.door.station_door import StationDoor
from robotside.gateways.gateway_url import MAX_RATE
from robotside.gateways.payloads.table import key_of
from robotside.gateways.websocket.plain_messages import NewestMessages

__all__ = ["Subscriptions"]

_LARGE = (CompressedImage, OccupancyGrid)


class Subscriptions:
    """One client's subscriptions, one for each topic at most."""

    def __init__(
        self,
        door: StationDoor,
        operator: Operator,
        queue: SendQueue,
        newest: NewestMessages,
        keys: Collection[str],
        rate: float,
    ) -> None:
        """`rate` is that of who asks for none [Hz]; only payloads among `keys` are carried."""
        self._door, self._operator, self._queue, self._newest = door, operator, queue, newest
        self._keys, self._rate = keys, rate
        self._ends: dict[str, Callable[[], None]] = {}
        self._streams: dict[str, Stream] = {}
        cameras = camera_topics(door.info.cameras)
        self._names = {f"/camera/{name}": topic for name, topic in cameras.items()} | {"/camera": CAMERA}

    def subscribe(self, name: str, rate: float | None) -> None:
        """Send a topic at `rate` [Hz] at most, None for the gateway's; again, it changes the rate. Raises BridgeError."""
        topic = self._topic(name)
        if rate is None:
            rate = self._rate
        if not 0 < rate <= MAX_RATE:
            raise ProtocolError(f"The rate is above 0 and at most {MAX_RATE:g} Hz, not {rate:g}.")
        self._door.check(self._operator, "subscribe", topic.name)
        self.unsubscribe(topic.name)
        sampled = topic.rate > 0
        wanted = Subscribed(topic.name, period=1 / rate if sampled else 0.0)
        stream = self._streams[topic.name] = Stream(topic.name, _lane(topic), wanted, 0 if topic.once else 1)

        def deliver(_: str, msg: Msg) -> None:
            self._queue.offer(stream, self._newest.of(topic.name, msg))

        self._ends[topic.name] = self._door.subscribe(self._operator, topic.name, deliver)

    def unsubscribe(self, name: str) -> None:
        """Send a topic no longer; nothing happens when it was not sent."""
        name = self._names.get(name, name)
        end, stream = self._ends.pop(name, None), self._streams.pop(name, None)
        if end is not None:
            end()
        if stream is not None:
            self._queue.remove(stream)

    def close(self) -> None:
        """Send nothing any more."""
        for name in list(self._ends):
            self.unsubscribe(name)

    def _topic(self, name: str) -> Topic:
        name = self._names.get(name, name)
        topic = self._door.topics.get(name)
        if topic is None or key_of(name) not in self._keys:
            raise Refused(f"This gateway does not carry {name[:100]}.")
        if topic.to == "robot":
            raise Refused(f"This robot listens to {name} and says nothing there.")
        return topic


def _lane(topic: Topic) -> Lane:
    if issubclass(topic.type, _LARGE):
        return Lane.BULK
    return Lane.TELEMETRY if topic.rate > 0 else Lane.EVENT
