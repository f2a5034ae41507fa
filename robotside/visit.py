"""One browser's connection to the web site, which neither stays for ever nor crowds out others."""

from __future__ import annotations

import asyncio

from uvicorn.protocols.http.h11_impl import H11Protocol

__all__ = ["LONGEST", "MOST", "Visit"]

MOST = 64
"""Connections open at a time; one more is closed at once."""

LONGEST = 30.0
"""How long a connection may stay, whatever it asks [s]; a page takes a moment, a picture 2 s."""


class Visit(H11Protocol):
    """HTTP on one connection; uvicorn's own limits begin only after the first request."""

    _end: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Let it in if there is room."""
        super().connection_made(transport)
        if len(self.connections) > MOST:
            transport.abort()
            return
        self._end = self.loop.call_later(LONGEST, transport.abort)

    def connection_lost(self, exc: Exception | None) -> None:
        """It is gone."""
        if self._end:
            self._end.cancel()
        super().connection_lost(exc)
