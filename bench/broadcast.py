"""One message to eight clients: the server's cost, against a server that encodes for each client anew."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from contextlib import asynccontextmanager

from websockets.asyncio.server import ServerConnection, serve

from bench.codec import scan
from bench.figures import Figure
from bridge import codec
from bridge.server import BridgeServer

__all__ = ["measure"]

CLIENTS = 8
MESSAGES = 200
PERIOD = 0.005
"""Between two messages [s]."""
ROUNDS = 3
TOPIC = "/scan"

Publish = Callable[[], Awaitable[None]]


@asynccontextmanager
async def _ours() -> AsyncIterator[tuple[int, Callable[[], int], Publish]]:
    server, msg = BridgeServer(services=(), on_message=lambda *_: None), scan()
    await server.start(port=0)

    async def publish() -> None:
        server.publish(TOPIC, msg)

    yield server.port, lambda: len(server.sessions), publish
    await server.close()


@asynccontextmanager
async def _naive() -> AsyncIterator[tuple[int, Callable[[], int], Publish]]:
    clients: set[ServerConnection] = set()
    fields = json.loads(codec.to_json(scan()))

    async def keep(ws: ServerConnection) -> None:
        clients.add(ws)
        await ws.wait_closed()

    async def publish() -> None:
        for ws in clients:
            await ws.send(json.dumps({"op": "publish", "topic": TOPIC, "msg": fields}))

    async with serve(keep, "127.0.0.1", 0) as server:  # with its default, permessage-deflate
        yield next(iter(server.sockets)).getsockname()[1], lambda: len(clients), publish


async def _cost(way: Callable[[], object]) -> tuple[float, float]:
    """CPU seconds of this process for a message to all, and the share of messages that arrived."""
    async with way() as (port, count, publish):  # type: ignore[attr-defined]
        command = [sys.executable, "-m", "bench.readers", f"ws://127.0.0.1:{port}", str(CLIENTS), TOPIC]
        readers = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)  # noqa: ASYNC220 - returns at once
        while count() < CLIENTS:
            await asyncio.sleep(0.01)
        await asyncio.sleep(0.2)
        before = time.process_time()
        for _ in range(MESSAGES):
            await publish()
            await asyncio.sleep(PERIOD)
        spent = (time.process_time() - before) / MESSAGES
        await asyncio.sleep(0.3)
    heard = [int(word) for word in readers.communicate(timeout=10)[0].split()]
    return spent, sum(heard) / (CLIENTS * MESSAGES)


def measure() -> Iterator[Figure]:
    """A sweep of the laser to eight clients at 200 Hz."""
    ours = [asyncio.run(_cost(_ours)) for _ in range(ROUNDS)]
    naive = [asyncio.run(_cost(_naive)) for _ in range(ROUNDS)]
    told = f"CPU of the server for a scan to {CLIENTS} clients"
    yield Figure("broadcast", "ms", tuple(cost * 1e3 for cost, _ in ours), against=told)
    yield Figure(
        "broadcast, delivered", "%", tuple(share * 100 for _, share in ours), limit=99, at_least=True
    )
    gain = tuple(slow / fast for (slow, _), (fast, _) in zip(naive, ours, strict=True))
    yield Figure(
        "broadcast, gain", "x", gain, against="times cheaper than json.dumps and deflate for each client"
    )
