"""The paths that messages take inside the robot's computer."""

from __future__ import annotations

from collections.abc import Callable

from bridge.msgs import Msg

__all__ = ["Bus", "Publish"]

Publish = Callable[[str, Msg], None]
"""Sends a message on a topic."""

Subscriber = Callable[[str, Msg], None]


class Bus:
    """Publish and subscribe within one thread; the last message of every topic is kept for later comers."""

    def __init__(self) -> None:
        self._last: dict[str, Msg] = {}
        self._by_topic: dict[str, list[Subscriber]] = {}
        self._to_all: list[Subscriber] = []

    def publish(self, topic: str, msg: Msg) -> None:
        """Give `msg` to everyone who subscribed to `topic`, in the order they came."""
        self._last[topic] = msg
        for subscriber in (*self._by_topic.get(topic, ()), *self._to_all):
            subscriber(topic, msg)

    def subscribe(
        self, topic: str | None, subscriber: Subscriber, *, replay: bool = True
    ) -> Callable[[], None]:
        """Call `subscriber(topic, msg)` for each message of `topic`, None meaning every topic.

        The last message of before comes first, with `replay`. Returns the call that ends it.
        """
        listeners = self._to_all if topic is None else self._by_topic.setdefault(topic, [])
        listeners.append(subscriber)
        for name, msg in list(self._last.items()) if replay else ():
            if topic in (None, name):
                subscriber(name, msg)
        return lambda: listeners.remove(subscriber) if subscriber in listeners else None

    def last(self, topic: str) -> Msg | None:
        """The newest message of `topic`; None when there was none."""
        return self._last.get(topic)
