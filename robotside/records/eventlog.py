"""The numbered log of events, over restarts, with who acknowledged them."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Iterable

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from robotside.core.notice import Notice
from robotside.records.database.jobs import NotRecorded
from robotside.records.ledger import Ledger

__all__ = ["FIRST_EVENTS", "MAX_EVENTS", "EventLog"]

MAX_EVENTS = 5000
"""Events that can still be asked for."""
FIRST_EVENTS = 500
"""Events for a client that knows none of them."""


class EventLog:
    """All events. A number is never given twice in one log, and every event that was published is found here again."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger
        self._oldest = min(ledger.rows("events"), default=0)
        if not ledger.rows("facts").get("log"):
            ledger.fact("facts", "log", secrets.token_hex(4))

    @property
    def identity(self) -> str:
        """Of the log; a new one when the log was started fresh."""
        return str(self._ledger.rows("facts")["log"])

    def add(self, event: Event, publish: Callable[[Event], None]) -> Event:
        """Number `event` and keep it; `publish` is called once it is on the disk, or cannot be just now."""
        ledger = self._ledger
        with ledger.together():
            event = msgspec.structs.replace(event, id=ledger.count("last event"), boot=self.identity)
            ledger.fact("events", event.id, event, lambda: publish(event))
            self._prune()
        return event

    @property
    def oldest(self) -> int:
        """Number of the oldest event on the disk; 0 when there is none."""
        return min(self._ledger.stored("events"), default=0)

    def since(self, number: int, identity: str, most: int = 0) -> list[Event]:
        """The events on the disk after `number`, oldest first; the newest ones when it is of another log or 0.

        With `most` above 0 the first so many of them, of another log from its first on; who names no log still
        gets the newest.
        """
        rows = self._ledger.stored("events")
        known = number if identity == self.identity else 0
        keys = [key for key in sorted(rows) if key > known]
        if most > 0:
            keys = keys[:most] if identity else keys[-most:]
        elif known <= 0:
            keys = keys[-FIRST_EVENTS:]
        return [self._signed(rows[key]) for key in keys]

    def more(self, told: Iterable[Event]) -> bool:
        """Whether there are events on the disk after all that were `told`."""
        last = max((event.id for event in told), default=0)
        return max(self._ledger.stored("events"), default=0) > last

    def seen(self, ids: Iterable[int], identity: str) -> list[Event]:
        """Those of the named events that are acknowledged on the disk; none of another log."""
        rows = self._ledger.stored("events")
        known = sorted(set(ids)) if identity == self.identity else []
        return [self._signed(rows[id]) for id in known if id in rows and rows[id].acknowledged_by]

    def _signed(self, event: Event) -> Event:
        return msgspec.structs.replace(event, boot=self.identity)

    def acknowledge(
        self, ids: Iterable[int], by: str, stamp: Time, publish: Callable[[Event], None]
    ) -> list[Event]:
        """Note who has seen to events, of which the first who did counts; returns those that are new.

        `publish` is called with each once it is on the disk. NotRecorded for a number that no event has.
        """
        rows = self._ledger.rows("events")
        wanted = list(dict.fromkeys(ids))
        strange = [id for id in wanted if id not in rows]
        if strange:
            said = f"There is no event with the number {strange[0]}."
            raise NotRecorded(Notice(Code.EVENT_UNKNOWN, said, id=strange[0]))
        fresh = [
            msgspec.structs.replace(rows[id], acknowledged_by=by, acknowledged=stamp, boot=self.identity)
            for id in wanted
            if not rows[id].acknowledged_by
        ]
        with self._ledger.together():
            for id in wanted:
                if rows[id].acknowledged_by and rows[id] is not self._ledger.stored("events").get(id):
                    self._ledger.order("events", id, rows[id])  # on its way: this answer waits for it as well
            for event in fresh:
                self._ledger.order("events", event.id, event, lambda event=event: publish(event))  # type: ignore[misc]
        return fresh

    def _prune(self) -> None:
        rows = self._ledger.rows("events")
        while len(rows) > MAX_EVENTS:
            oldest = self._oldest
            self._oldest += 1
            if oldest in rows:
                self._ledger.fact("events", oldest, None)
