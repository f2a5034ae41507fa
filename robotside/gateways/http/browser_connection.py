"""One browser's connection to the web site, which neither stays for ever nor crowds out others."""

from __future__ import annotations

import asyncio
import contextlib
import socket

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

__all__ = ["CLOSE_TIMEOUT", "MAX_CONNECTION_TIME", "MAX_CONNECTIONS", "STUCK_TIMEOUT", "BrowserConnection"]

MAX_CONNECTIONS = 64
"""Connections open at a time; for one more the oldest that asks nothing is closed, else that one."""

MAX_CONNECTION_TIME = 30.0
"""How long a connection may stay, for any request [s]; a stream as long as it is read."""

STUCK_TIMEOUT = 10.0
"""A stream of which nothing was read for this long, and at most twice as long, is ended [s]."""

CLOSE_TIMEOUT = 0.5
"""How long the answers under way may still take when the site ends [s]."""

_UNSENT = 49_152
"""Bytes on their way to one browser: a stream must not queue old pictures in the kernel."""


class BrowserConnection(H11Protocol):
    """HTTP on one connection; uvicorn's own limits begin only after the first request."""

    _looking: asyncio.TimerHandle | None = None
    until = 0.0
    """When its time is over, by the loop's clock [s]."""
    _left = 0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Let it in if there is room or somebody asks nothing."""
        super().connection_made(transport)
        self.until = self.loop.time() + MAX_CONNECTION_TIME
        if len(self.connections) > MAX_CONNECTIONS:
            self._make_room()
        if not transport.is_closing():
            _keep_little(transport)
            self._look_later()

    def _make_room(self) -> None:
        """Close the oldest connection that asks nothing, which slow ones and idle ones are; this one when there is none."""
        others = [
            visit for visit in self.connections if visit is not self and isinstance(visit, BrowserConnection)
        ]
        idle = [visit for visit in others if not visit.asking and not visit.transport.is_closing()]
        min(idle, key=lambda visit: visit.until, default=self).transport.abort()

    def shutdown(self) -> None:
        """The site ends: finish what is being answered, but not a stream and not one who does not read."""
        super().shutdown()
        self.loop.call_later(CLOSE_TIMEOUT, self.transport.abort)

    def send_400_response(self, msg: str) -> None:
        """Say that a request is none; where its answer has begun nothing can be said any more, and the connection ends."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            super().send_400_response(msg)
        else:
            self.transport.abort()

    def _look_later(self) -> None:
        left = self.until - self.loop.time()
        self._looking = self.loop.call_later(
            STUCK_TIMEOUT if self._streaming else min(STUCK_TIMEOUT, max(0.0, left)), self._look
        )

    def _look(self) -> None:
        """End it when its time is over; a stream when its viewer takes nothing of what it is sent."""
        left = self.transport.get_write_buffer_size()
        stuck, self._left = left > 0 and left == self._left, left
        if stuck if self._streaming else self.loop.time() >= self.until:
            self.transport.abort()
            return
        self._look_later()

    @property
    def asking(self) -> bool:
        """A request is being answered."""
        return self.cycle is not None and not self.cycle.response_complete

    @property
    def _streaming(self) -> bool:
        return self.asking and self.scope["path"].startswith("/stream/")

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone."""
        if self._looking:
            self._looking.cancel()
        super().connection_lost(exc)


def _keep_little(transport: asyncio.Transport) -> None:
    """Have a writer wait until all went into the kernel, and the kernel take little."""
    transport.set_write_buffer_limits(0)
    with contextlib.suppress(OSError):
        transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _UNSENT)
