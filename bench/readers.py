"""Clients in a process of their own that read whatever comes: `python -m bench.readers URL COUNT TOPIC`."""

from __future__ import annotations

import asyncio
import json
import sys

from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

__all__: list[str] = []


async def _read(url: str, topic: str) -> int:
    heard = 0
    async with connect(url, compression=None, max_size=None) as ws:
        await ws.send(json.dumps({"op": "subscribe", "topic": topic}))
        try:
            async for _ in ws:
                heard += 1
        except ConnectionClosed:
            pass
    return heard


async def _all(url: str, count: int, topic: str) -> None:
    print(*await asyncio.gather(*(_read(url, topic) for _ in range(count))))


if __name__ == "__main__":
    asyncio.run(_all(sys.argv[1], int(sys.argv[2]), sys.argv[3]))
