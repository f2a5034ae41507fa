"""The robot's events over one link: those that come by themselves, and those that were missed and are asked for.

Everything here lives in the network thread.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Mapping

from app.link.event_order import EventStream, KnownEvents, Missed
from app.link.task_set import TaskSet
from bridge.client.client import BridgeClient
from bridge.core.errors import BridgeError, NoReply, NotConnected
from bridge.msgs.pilothouse_msgs import Event, GetEventsResponse

__all__ = ["EventFetch"]

log = logging.getLogger(__name__)

EVENTS_TIMEOUT = 10.0
"""For a part of the events that were missed [s]: many of them take a while on a slow link."""
RETRY_DELAY = 1.0
"""Between two questions for missed events while none is answered [s]."""


class EventFetch:
    """Asks for what `EventStream` finds missing, one question at a time."""

    def __init__(
        self,
        client: BridgeClient,
        tasks: TaskSet,
        *,
        on_event: Callable[[Event], None],
        on_missed: Callable[[Missed], None],
        on_known: Callable[[KnownEvents], object],
        known: KnownEvents | None = None,
        marks: Mapping[str, int] | None = None,
    ) -> None:
        """`known` and `marks` are as `EventStream` takes them; `on_known` is called when more of the log is known."""
        self._client, self._tasks, self._on_known = client, tasks, on_known
        self._stream = EventStream(on_event, on_missed, known=known, marks=marks)
        self._known = KnownEvents()
        self._fetching: asyncio.Task[None] | None = None

    def on_connected(self) -> None:
        """A link was made: everything since the last one is missing."""
        self._stream.start()

    def on_lost(self) -> None:
        """The link is gone: no answer can come."""
        if self._fetching is not None:
            self._fetching.cancel()
        self._fetching = None

    def on_live(self, event: Event) -> None:
        """An event came by itself."""
        self._stream.live(event)
        self._publish_known()

    def without_store(self) -> None:
        """The robot keeps no events: go on with what comes live."""
        self._stream.without_store()

    def catch_up(self) -> None:
        """Ask for events where some are missing, unless that is under way."""
        if self._stream.behind and (self._fetching is None or self._fetching.done()):
            self._fetching = self._tasks.start(self._fetch())

    async def _fetch(self) -> None:
        while self._stream.behind:
            request = self._stream.request()
            try:
                answer = await self._client.call(
                    "/events/get", request, GetEventsResponse, timeout=EVENTS_TIMEOUT
                )
            except (NoReply, NotConnected) as problem:
                log.info("stored events did not come: %s", problem)
                self._stream.no_answer()
                await asyncio.sleep(RETRY_DELAY)
            except BridgeError as problem:
                log.info("no stored events: %s", problem)
                self._stream.without_store()
            else:
                self._stream.answered(answer)
            self._publish_known()

    def _publish_known(self) -> None:
        known = self._stream.known
        if known != self._known:
            self._known = known
            self._on_known(known)
