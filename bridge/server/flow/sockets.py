"""What the server's connections have in common: the socket they need, and waiting for work."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from typing import Protocol

__all__ = ["TURN_TIME", "Socket", "cancel_all", "wait"]

TURN_TIME = 0.005
"""After so long with one client the others have their turn [s]; what it sent in one frame may hold a thousand operations."""


class Socket(Protocol):
    """What is needed of a WebSocket; iterating and sending raise when the connection ends badly."""

    @property
    def transport(self) -> asyncio.Transport:
        """The connection below."""

    def __aiter__(self) -> AsyncIterator[str | bytes]:
        """What comes."""

    async def send(self, message: bytes, *, text: bool | None = None) -> None:
        """Send one message; waits while too much is on its way."""


async def wait(wake: asyncio.Event, seconds: float | None) -> None:
    """Until `wake` is set or `seconds` have passed; None waits for ever."""
    timer = None if seconds is None else asyncio.get_running_loop().call_later(seconds, wake.set)
    try:
        await wake.wait()
    finally:
        wake.clear()
        if timer is not None:
            timer.cancel()


async def cancel_all(tasks: set[asyncio.Task[None]]) -> None:
    """Cancel `tasks` and wait until they are over."""
    left = list(tasks)
    for task in left:
        task.cancel()
    await asyncio.gather(*left, return_exceptions=True)
