"""Who wants which topic, and what the last message of each latched one was."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Protocol

from bridge.errors import BridgeError
from bridge.levels import Picture
from bridge.msgs import Msg
from bridge.outbox import Outgoing
from bridge.topics import Topic

__all__ = ["CAMERA_TOPIC", "Listener", "Switchboard", "Watcher"]

CAMERA_TOPIC = "/camera/image/compressed"
"""Counts as wanted while somebody watches a camera."""


class Listener(Protocol):
    """Takes the messages of the topics it subscribed to."""

    def deliver(self, entry: Topic, message: Outgoing) -> None:
        """Take one message; returns at once."""


class Watcher(Protocol):
    """Takes the frames of one camera."""

    def offer(self, picture: Picture) -> None:
        """Take one picture; returns at once."""


class Switchboard:
    """Passes messages on to listeners and frames on to watchers, and says which topics are wanted at all."""

    def __init__(self, topics: Iterable[Topic], on_demand: Callable[[str, bool], None]) -> None:
        """`on_demand(topic, wanted)` hears that the first one came who wants `topic`, or that the last one left."""
        self.topics = {entry.name: entry for entry in topics}
        self._on_demand = on_demand
        self._latched: dict[str, Outgoing] = {}
        self._listeners: dict[str, set[Listener]] = {}
        self._watchers: dict[str, set[Watcher]] = {}

    def publish(self, topic: str, msg: Msg) -> None:
        """Pass a message on; BridgeError for a topic that is not in the table."""
        entry = self.topics.get(topic)
        if entry is None:
            raise BridgeError(f"There is no topic {topic} in the table.")
        message = Outgoing(topic, msg)
        if entry.latched:
            self._latched[topic] = message
        for listener in self._listeners.get(topic, ()):
            listener.deliver(entry, message)

    def publish_frame(self, camera: str, picture: Picture) -> None:
        """Pass a picture on to whoever watches `camera`."""
        for watcher in self._watchers.get(camera, ()):
            watcher.offer(picture)

    def subscribe(self, listener: Listener, topic: str) -> None:
        """`listener` wants `topic` from now on, and at once its last message if it is a latched one."""
        if not self.wanted(topic):
            self._on_demand(topic, True)
        self._listeners.setdefault(topic, set()).add(listener)
        if topic in self._latched:
            listener.deliver(self.topics[topic], self._latched[topic])

    def unsubscribe(self, listener: Listener, topic: str) -> None:
        """`listener` no longer wants `topic`; no error when it never did."""
        listeners = self._listeners.get(topic, set())
        if listener in listeners:
            listeners.discard(listener)
            self._left(topic)

    def watch(self, watcher: Watcher, camera: str) -> None:
        """`watcher` wants the frames of `camera` from now on."""
        if not self.wanted(CAMERA_TOPIC):
            self._on_demand(CAMERA_TOPIC, True)
        self._watchers.setdefault(camera, set()).add(watcher)

    def unwatch(self, watcher: Watcher, camera: str) -> None:
        """`watcher` no longer wants the frames of `camera`."""
        self._watchers[camera].discard(watcher)
        if not self._watchers[camera]:
            del self._watchers[camera]
        self._left(CAMERA_TOPIC)

    def wanted(self, topic: str) -> bool:
        """Whether anybody wants `topic`."""
        return bool(self._listeners.get(topic)) or (topic == CAMERA_TOPIC and bool(self._watchers))

    def _left(self, topic: str) -> None:
        if not self.wanted(topic):
            self._on_demand(topic, False)
