"""The subscriptions of one client of a server, those to one topic merged into one delivery."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from msgspec import UNSET

from bridge.core.compat import Compat
from bridge.protocol.merging import Subscribed, merged, wish
from bridge.protocol.names import absolute, checked_id, checked_name, wrong
from bridge.protocol.ops import Id, Subscribe, Unsubscribe

__all__ = ["MAX_SUBSCRIPTIONS", "NO_IDS", "ClientSubscriptions"]

MAX_SUBSCRIPTIONS = 1000
"""Subscriptions of one client, each id counted."""
NO_IDS = (None, UNSET)
"""An operation with one of these for its id means all ids."""


class ClientSubscriptions:
    """Subscriptions by topic and id, and the merged delivery of each topic."""

    def __init__(self, compat: Compat) -> None:
        self.fragment_size: int | None = None
        """Longest text frame [characters] of all deliveries; None for no limit."""
        self.compat = compat
        self._by_topic: dict[str, dict[Id, Subscribed]] = {}
        self._merged: dict[str, Subscribed] = {}
        self._stale: dict[str, None] = {}
        self._changed: dict[str, None] = {}
        self._count = 0

    def subscribe(self, op: Subscribe, *, ros2: bool) -> str:
        """Add a subscription; returns the topic's absolute name. The same id again replaces the first.

        `ros2` is the client's spelling of types where `op` names none. ProtocolError when it asks for what cannot be had,
        or is one too many.
        """
        topic = checked_name(op.topic, op, "topic")
        id = checked_id(op)
        known = self._by_topic.get(topic, {})
        if id not in known and self._count >= MAX_SUBSCRIPTIONS:
            raise wrong(op, f"A client may have at most {MAX_SUBSCRIPTIONS} subscriptions.")
        wanted = wish(op, self.compat, ros2)
        again = id in known
        self._by_topic.setdefault(topic, {})[id] = wanted
        self._count += not again
        if again or topic in self._stale:
            self._stale[topic] = None
        else:
            both = merged((self._merged[topic], wanted), self.compat) if known else wanted
            self._merged[topic] = self._cut(both)
        return topic

    def unsubscribe(self, op: Unsubscribe) -> str:
        """Remove a subscription; returns the topic's absolute name. An unknown one is no error."""
        topic = absolute(op.topic)
        known = self._by_topic.get(topic, {})
        before = len(known)
        if op.id in NO_IDS:
            known.clear()
        known.pop(op.id, None)
        self._count -= before - len(known)
        if known:
            self._stale[topic] = None
        else:
            for table in (self._by_topic, self._merged, self._stale):
                table.pop(topic, None)
        return topic

    def set_fragment_size(self, size: int | None) -> None:
        """Cut all deliveries from now on into frames of at most `size` [characters]; None for no limit."""
        self.fragment_size = size
        self._stale = dict.fromkeys(self._by_topic)

    @property
    def deliveries(self) -> Mapping[str, Subscribed]:
        """The merged delivery of each topic, by absolute name."""
        stale, self._stale = self._stale, {}
        for topic in stale:
            self._merged[topic] = self._cut(merged(self._by_topic[topic].values(), self.compat))
        self._changed |= stale
        return self._merged

    def is_stale(self, topic: str) -> bool:
        """Whether the delivery of a topic (absolute name) is still to be merged, and `changed` will name it.

        That is not done with each operation: a frame may hold a thousand of them, and a topic as many subscriptions.
        """
        return topic in self._stale

    def changed(self) -> dict[str, Subscribed]:
        """The deliveries that changed since the last call, by the topic's absolute name; new topics are not among them."""
        if not self._stale and not self._changed:
            return {}
        deliveries = self.deliveries
        changed, self._changed = self._changed, {}
        return {topic: deliveries[topic] for topic in changed if topic in deliveries}

    def clear(self) -> None:
        """Remove all subscriptions."""
        for table in (self._by_topic, self._merged, self._stale, self._changed):
            table.clear()
        self._count = 0

    def _cut(self, wanted: Subscribed) -> Subscribed:
        if not self.compat.sticky_fragment_size:
            return wanted
        size = self.fragment_size
        if size is not None and wanted.fragment_size is not None:
            size = min(size, wanted.fragment_size)
        return dataclasses.replace(wanted, fragment_size=size)
