"""HELLOs on their way from the network thread to the UI thread, the newest of each robot, however many come."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from dataclasses import dataclass

from bridge.discovery.hello import Hello

__all__ = ["MAX_NEW", "MAX_NEW_PER_SOURCE", "HeardHello", "HelloInbox"]

MAX_NEW = 100
"""So many robots that are not listed yet wait at most."""
MAX_NEW_PER_SOURCE = 50
"""So many of them from one address."""


@dataclass(frozen=True, slots=True)
class HeardHello:
    """One HELLO as it came."""

    hello: Hello
    source: str
    """The address that it came from."""
    received: float
    """When [s], our clock."""


class HelloInbox:
    """Any thread may put, and take. Robots that are listed always get in; others while there is room."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._listed: frozenset[str] = frozenset()
        self._waiting: dict[str, HeardHello] = {}
        self._new: dict[str, int] = {}
        """New robots that wait, by their source."""

    def expect(self, urls: Iterable[str]) -> None:
        """These robots are listed."""
        self._listed = frozenset(urls)

    def put(self, heard: HeardHello) -> None:
        """Take in a HELLO in place of the same robot's last one, or drop it where too many strangers wait."""
        url, source = heard.hello.url, heard.source
        with self._lock:
            if url not in self._waiting and url not in self._listed:
                of_source = self._new.get(source, 0)
                if of_source >= MAX_NEW_PER_SOURCE or sum(self._new.values()) >= MAX_NEW:
                    return
                self._new[source] = of_source + 1
            self._waiting[url] = heard

    def take(self) -> list[HeardHello]:
        """All that wait, and none of them again."""
        with self._lock:
            taken, self._waiting, self._new = self._waiting, {}, {}
        return list(taken.values())
