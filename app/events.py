"""Puts the events that came live and those that were missed into one order, each once."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from bridge.msgs.pilothouse_msgs import Event, GetEventsRequest

__all__ = ["EventStream"]


class EventStream:
    """Events of one robot over any number of reconnects and restarts of either side."""

    def __init__(self, tell: Callable[[Event], None]) -> None:
        """`tell` gets each event once, oldest first."""
        self._tell = tell
        self._boot, self._last = "", 0
        self._held: list[Event] | None = None

    def ask(self) -> GetEventsRequest:
        """What to ask after connecting; until `missed` or `give_up` live events are held back."""
        self._held = []
        return GetEventsRequest(since=self._last, boot=self._boot)

    def live(self, event: Event) -> None:
        """An event came by itself."""
        if self._held is not None:
            self._held.append(event)
        else:
            self._take(event)

    def missed(self, events: Iterable[Event]) -> None:
        """The answer to `ask` came."""
        held, self._held = self._held or [], None
        for event in [*events, *held]:
            self._take(event)

    def give_up(self) -> None:
        """No answer to `ask` will come: go on with what came live."""
        self.missed([])

    def _take(self, event: Event) -> None:
        if event.boot != self._boot:
            self._boot, self._last = event.boot, 0
        if event.id <= self._last:
            return
        self._last = event.id
        self._tell(event)
