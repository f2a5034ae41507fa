"""Messages of a robot on their way out: the newest of each topic, as often as asked for, and each event once."""

from __future__ import annotations

import math
from collections import deque

from bridge.core.topics import Topic
from bridge.msgs import Msg

__all__ = ["MAX_EVENTS", "Outbox"]

MAX_EVENTS = 256
"""Events that wait; beyond them the oldest are left out, `/events/get` has them."""


class Outbox:
    """What waits to be sent. Pure: every call is told the time [s], of a clock that only goes forward."""

    def __init__(self, period: float) -> None:
        """Two messages of one topic with a rate are at least `period` apart [s]."""
        self._period = period
        self._newest: dict[str, Msg] = {}
        self._due: dict[str, float] = {}
        self._each: deque[tuple[str, Msg]] = deque(maxlen=MAX_EVENTS)

    def put(self, topic: Topic, msg: Msg) -> None:
        """A message to be sent; of all topics but those of single happenings a newer one replaces it."""
        if topic.once:
            self._each.append((topic.name, msg))
            return
        self._newest[topic.name] = msg
        if not topic.rate:
            self._due[topic.name] = -math.inf

    def take(self, now: float) -> tuple[str, Msg] | None:
        """The topic and message to be sent next; None when nothing is due."""
        if self._each:
            return self._each.popleft()
        name = self._next()
        if name is None or self._due.get(name, -math.inf) > now:
            return None
        self._due[name] = now + self._period
        return name, self._newest.pop(name)

    def wait(self, now: float) -> float:
        """How long nothing will be due unless something is put in [s]; infinite when it is empty."""
        if self._each:
            return 0.0
        name = self._next()
        return math.inf if name is None else max(0.0, self._due.get(name, -math.inf) - now)

    def _next(self) -> str | None:
        """The topic that is due first."""
        return min(self._newest, key=lambda name: self._due.get(name, -math.inf), default=None)

    def clear(self) -> None:
        """Nothing waits any more."""
        self._newest.clear()
        self._each.clear()
