"""One browser's connection to the web site, which neither stays for ever nor crowds out others."""

from __future__ import annotations

import asyncio
import contextlib
import socket

from uvicorn.protocols.http.h11_impl import H11Protocol

__all__ = ["FAREWELL", "LONGEST", "MOST", "Visit"]

MOST = 64
"""Connections open at a time; one more is closed at once."""

LONGEST = 30.0
"""How long a connection may stay, whatever it asks [s]; a stream as long as it is read."""

FAREWELL = 0.5
"""How long the answers under way may still take when the site ends [s]."""

_UNSENT = 49_152
"""Bytes on their way to one browser: a stream must not queue old pictures in the kernel."""


class Visit(H11Protocol):
    """HTTP on one connection; uvicorn's own limits begin only after the first request."""

    _end: asyncio.TimerHandle | None = None
    _left = 0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Let it in if there is room."""
        super().connection_made(transport)
        if len(self.connections) > MOST:
            transport.abort()
            return
        _keep_little(transport)
        self._end = self.loop.call_later(LONGEST, self._expire)

    def shutdown(self) -> None:
        """The site ends: finish what is being answered, but not a stream and not one who does not read."""
        super().shutdown()
        self.loop.call_later(FAREWELL, self.transport.abort)

    def _expire(self) -> None:
        """Time is over, except for a stream whose viewer takes what it is sent."""
        left = self.transport.get_write_buffer_size()
        stuck, self._left = left > 0 and left == self._left, left
        if stuck or not self._streaming:
            self.transport.abort()
            return
        self._end = self.loop.call_later(LONGEST, self._expire)

    @property
    def _streaming(self) -> bool:
        begun = self.cycle is not None and not self.cycle.response_complete
        return begun and self.scope["path"].startswith("/stream/")

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone."""
        if self._end:
            self._end.cancel()
        super().connection_lost(exc)


def _keep_little(transport: asyncio.Transport) -> None:
    """Have whoever writes wait until all went into the kernel, and the kernel take little."""
    transport.set_write_buffer_limits(0)
    with contextlib.suppress(OSError):
        transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _UNSENT)
