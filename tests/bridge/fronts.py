"""A machine that ends TLS with a certificate of its own and passes everything on: a robot's front, or somebody in between."""

from __future__ import annotations

import asyncio
import contextlib
import ssl
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from bridge.client.tls import context
from tests.bridge.certificates import served

__all__ = ["front"]


async def _pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    try:
        with contextlib.suppress(OSError, ssl.SSLError):
            while data := await reader.read(65536):
                writer.write(data)
                await writer.drain()
    finally:
        writer.close()


@asynccontextmanager
async def front(name: str, port: int, *, onward_tls: bool = False) -> AsyncIterator[int]:
    """Listens with the certificate of `name` and passes on to `port` of loopback, by TLS or plain; gives its port."""
    passing: set[asyncio.Task[None]] = set()

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        there = await asyncio.open_connection("127.0.0.1", port, ssl=context() if onward_tls else None)
        for one, other in ((reader, there[1]), (there[0], writer)):
            task = asyncio.create_task(_pump(one, other))
            passing.add(task)
            task.add_done_callback(passing.discard)

    listening = await asyncio.start_server(serve, "127.0.0.1", 0, ssl=served(name)[0])
    try:
        yield listening.sockets[0].getsockname()[1]
    finally:
        listening.close()
        for task in passing:
            task.cancel()
        await asyncio.gather(*passing, return_exceptions=True)
