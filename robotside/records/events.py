"""The log of events, as the operator reads it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event, GetEventsRequest, GetEventsResponse
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice, coded
from robotside.core.text import plain
from robotside.records.eventlog import EventLog

__all__ = ["Events", "Say"]

MAX_TEXT = 300
"""Characters kept of an event's sentence."""


class Say(Protocol):
    """Writes a sentence to the operator's log."""

    def __call__(
        self, kind: str, notice: Notice, level: str = "info", *, at: tuple[float, float] | None = None
    ) -> object:
        """One notice of a kind and level; `at` is where in `map` [m], None when it has no place."""


class Events:
    """Keeps events and passes each on once, as soon as it is on the disk."""

    def __init__(self, kept: EventLog, now: Callable[[], float], publish: Callable[[Event], None]) -> None:
        """`now` is the operators' clock [s], by which events are stamped."""
        self._log, self._now, self._publish = kept, now, publish

    @property
    def boot(self) -> str:
        """Identity of the log, over restarts."""
        return self._log.identity

    def say(
        self,
        kind: str,
        notice: Notice,
        level: str = "info",
        *,
        at: tuple[float, float] | None = None,
    ) -> Event:
        """Record one notice; `at` is where in `map` [m], None when it has no place."""
        position = Point(at[0], at[1], 0.0) if at else Point(math.nan, math.nan, math.nan)
        said = plain(notice, MAX_TEXT)
        event = Event(0, "", Time.at(self._now()), level, kind, said, position, **coded(notice))
        return self._log.add(event, self._publish)

    def since(self, number: int, boot: str) -> list[Event]:
        """The kept events after `number`, oldest first; the newest when `boot` is another log's, or `number` 0."""
        return self._log.since(number, boot)

    def answer(self, asked: GetEventsRequest) -> GetEventsResponse:
        """The events that a client has missed: later ones, and which of its `open` ones are acknowledged."""
        later = self._log.since(asked.since, asked.boot, asked.most)
        more = asked.most > 0 and bool(later) and self._log.more(later)
        seen = [event for event in self._log.seen(asked.open, asked.boot) if event.id <= asked.since]
        return GetEventsResponse([*seen, *later], more, self._log.oldest)
