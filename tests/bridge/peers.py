"""A foreign client of the server: says JSON, hears JSON."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import cbor2
import pytest
from websockets.asyncio.client import ClientConnection, connect

from bridge.server.server import BridgeServer
from tests.bridge.wires import TIMEOUT, Wire, url

__all__ = ["Peer", "bare", "peer"]


class Peer:
    """A foreign client: says JSON, hears JSON."""

    def __init__(self, ws: ClientConnection) -> None:
        self.ws = ws

    async def say(self, **op: Any) -> None:
        await self.ws.send(json.dumps(op))

    async def hear(self) -> Any:
        async with asyncio.timeout(TIMEOUT):
            raw = await self.ws.recv()
        return cbor2.loads(raw) if isinstance(raw, bytes) else json.loads(raw)

    async def call(self, name: str, **more: Any) -> Any:
        await self.say(op="call_service", service=name, **more)
        return await self.hear()

    async def settled(self) -> None:
        """Everything said so far was heard, and nothing came back before this answer."""
        answer = await self.call("/rosapi/nodes", id="settled")
        if answer.get("id") != "settled":
            pytest.fail(f"this came first: {answer}")


@asynccontextmanager
async def peer(made: BridgeServer | Wire, path: str = "", **options: Any) -> AsyncIterator[Peer]:
    """One that is connected until the end of the block."""
    options = {"compression": None, "proxy": None, "close_timeout": 0.1} | options
    async with connect(url(made) + path, **options) as ws:
        yield Peer(ws)


@asynccontextmanager
async def bare(made: BridgeServer) -> AsyncIterator[tuple[asyncio.StreamReader, asyncio.StreamWriter]]:
    """A connection that is no WebSocket yet; closed at the end of the block however that ends."""
    reader, writer = await asyncio.open_connection("127.0.0.1", made.port)
    try:
        yield reader, writer
    finally:
        writer.close()
        with contextlib.suppress(OSError):
            await writer.wait_closed()
