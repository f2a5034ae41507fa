"""The log of what happened, as the operator reads it."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import Protocol

from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from robotside.words import plain

__all__ = ["KEPT", "Events", "Say"]

KEPT = 500
"""Events that can still be asked for."""

LONGEST = 300
"""Characters kept of an event's sentence."""


class Say(Protocol):
    """Tells the operator something."""

    def __call__(
        self, kind: str, text: str, level: str = "info", *, at: tuple[float, float] | None = None
    ) -> object:
        """One sentence of a kind and level; `at` is where in `map` [m], None when it has no place."""


class Events:
    """Numbers events from 1, keeps the newest and passes each on once."""

    def __init__(self, boot: str, now: Callable[[], float], publish: Callable[[Event], None]) -> None:
        """`now` is the operators' clock [s], by which events are stamped."""
        self.boot = boot
        """Identity of this run of the robot side."""
        self._now = now
        self._publish = publish
        self._kept: deque[Event] = deque(maxlen=KEPT)
        self._count = 0

    def say(
        self,
        kind: str,
        text: str,
        level: str = "info",
        *,
        at: tuple[float, float] | None = None,
    ) -> Event:
        """Record one sentence; `at` is where in `map` [m], None when it has no place."""
        self._count += 1
        position = Point(at[0], at[1], 0.0) if at else Point(math.nan, math.nan, math.nan)
        said = plain(text, LONGEST)
        event = Event(self._count, self.boot, Time.at(self._now()), level, kind, said, position)
        self._kept.append(event)
        self._publish(event)
        return event

    def since(self, number: int, boot: str) -> list[Event]:
        """The kept events after `number`, oldest first; all of them when `boot` is another run's."""
        after = number if boot == self.boot else 0
        return [event for event in self._kept if event.id > after]
