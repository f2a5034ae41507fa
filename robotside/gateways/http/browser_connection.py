"""One browser's connection to the web site, which neither stays for ever nor crowds out others."""

from __future__ import annotations

import asyncio
import contextlib
import socket

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from bridge.server.reception.places import Limits, Place, Standing
from bridge.server.reception.tls import unsent
from robotside.gateways.http.mounts import LONG
from robotside.gateways.http.presence import GONE, READ

__all__ = ["CLOSE_TIMEOUT", "LIMITS", "MAX_CONNECTION_TIME", "PLACE", "STUCK_TIMEOUT", "BrowserConnection"]

LIMITS = Limits(total=64, per_address=48)
"""Connections that the web site has at a time."""

MAX_CONNECTION_TIME = 30.0
"""How long a connection may stay, for any request [s]; from its last answer for who has a role, a stream as long as it is read."""

STUCK_TIMEOUT = 10.0
"""A stream of which nothing was read for this long, and at most twice as long, is ended [s]."""

CLOSE_TIMEOUT = 0.5
"""How long the answers under way may still take when the site ends [s]."""

PLACE = "pilothouse.place"
"""Key of a request's `Place` in the state of its scope."""

_UNSENT = 49_152
"""Bytes on their way to one browser: a stream must not queue old pictures in the kernel."""


class BrowserConnection(H11Protocol):
    """HTTP on one connection; uvicorn's own limits begin only after the first request."""

    place: Place | None = None
    """Its place on the site's socket; set by the reception."""
    below: asyncio.Transport | None = None
    """The socket's own transport under an encrypted one; set by the reception."""
    _looking: asyncio.TimerHandle | None = None
    until = 0.0
    """When its time is over, by the loop's clock [s]."""
    _left = 0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Its time begins."""
        super().connection_made(transport)
        self.app_state = {**self.app_state, PLACE: self.place, GONE: self._is_gone}
        self.until = self.loop.time() + MAX_CONNECTION_TIME
        _keep_little(transport, self.below)
        self._look_later()

    def data_received(self, data: bytes) -> None:
        """Somebody asks, or goes on asking."""
        if self.place is not None:
            self.place.hear()
        self.app_state[READ] = self.loop.time()
        super().data_received(data)
        self._note_asking()

    def on_response_complete(self) -> None:
        """An answer is complete; who has a role may go on asking."""
        super().on_response_complete()
        if self.place is not None and self.place.standing > Standing.STRANGER:
            self.until = self.loop.time() + MAX_CONNECTION_TIME
        self._note_asking()

    def resume_writing(self) -> None:
        """All that was written has left the process."""
        if self.place is not None:
            self.place.hear()
        self.flow.resume_writing()

    def _unsupported_upgrade_warning(self) -> None:
        """Pass over that somebody asks for a WebSocket here: it is answered as any other request."""

    def _is_gone(self) -> bool:
        return self.transport.is_closing() or (self.below is not None and self.below.is_closing())

    def _note_asking(self) -> None:
        if self.place is not None:
            self.place.asked = self.asking

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
        left = unsent(self.transport, self.below)
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
        return self.asking and (self.scope["path"].startswith("/stream/") or LONG in self.scope["state"])

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone."""
        if self.place is not None:
            self.place.leave()
        if self._looking:
            self._looking.cancel()
        super().connection_lost(exc)


def _keep_little(transport: asyncio.Transport, below: asyncio.Transport | None) -> None:
    """Have a writer wait until all went into the kernel, and the kernel take little."""
    if below is None:  # under TLS the reception has seen to it
        transport.set_write_buffer_limits(0)
    with contextlib.suppress(OSError):
        transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _UNSENT)
