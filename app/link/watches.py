"""Any number of the robot's topics, each listened to for as long as somebody on the handheld looks at it."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from typing import Any

from app.link.subscriptions import Peek, Seen
from bridge.client.client import BridgeClient

__all__ = ["MAX_WATCHED", "Watches"]

MAX_WATCHED = 64
"""Topics that are listened to at once, beside those that every screen shows."""


class Watches:
    """Who looks at what, and one `Peek` for each topic that anybody looks at."""

    def __init__(
        self,
        client: BridgeClient,
        tell: Callable[[Seen, float], object],
        spawn: Callable[[Coroutine[Any, Any, None]], object],
        hop: Callable[..., object],
    ) -> None:
        """`tell` takes what came and when [s], as that of `Peek`; `spawn` runs a coroutine in the network thread, `hop` calls there."""
        self._client, self._tell, self._spawn, self._hop = client, tell, spawn, hop
        self._wanted: dict[str, dict[str, str]] = {}
        """Who looks, to the topics and their types."""
        self._peeks: dict[str, tuple[str, Peek]] = {}
        self._failed: set[str] = set()

    # in any thread

    def look(self, who: str, topics: Mapping[str, str]) -> None:
        """`who` looks at these topics from now on, each with the name of its type, and at no others; nothing, to look away.

        What is seen comes by the channel `watched(topic)`. What anybody else looks at is listened to on; beyond
        `MAX_WATCHED` a topic is told as a problem.
        """
        self._hop(self._want, who, dict(topics))

    # in the network thread

    def _want(self, who: str, topics: dict[str, str]) -> None:
        if topics:
            self._wanted[who] = topics
        else:
            self._wanted.pop(who, None)
        self._follow()

    def renew(self) -> None:
        """Begin anew what failed: the robot may know by now what it did not before."""
        for topic in self._failed & set(self._peeks):
            self._peeks.pop(topic)[1].close()
        self._failed.clear()
        self._follow()

    def _follow(self) -> None:
        wanted: dict[str, str] = {}
        for topics in self._wanted.values():
            wanted.update(topics)
        for topic in [one for one, (kind, _) in self._peeks.items() if wanted.get(one) != kind]:
            self._peeks.pop(topic)[1].close()
            self._failed.discard(topic)
        for topic, kind in wanted.items():
            if topic in self._peeks:
                continue
            if len(self._peeks) >= MAX_WATCHED:
                sentence = f"{MAX_WATCHED} topics are shown already; take one away to see {topic}."
                self._tell(Seen(topic, problem=sentence), float("nan"))
                continue
            peek = Peek(self._client, self._take)
            self._peeks[topic] = kind, peek
            self._spawn(peek.open(topic, kind))

    def _take(self, seen: Seen, received: float) -> None:
        if seen.problem:
            self._failed.add(seen.topic)
        self._tell(seen, received)
