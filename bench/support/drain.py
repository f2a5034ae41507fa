"""`python -m bench.support.drain URL CLIENTS TOPIC`: subscribes so many times and counts what comes.

Prints `{"ready": CLIENTS}`; answers each line on its standard input with `{"received": COUNT}`.
"""

from __future__ import annotations

import asyncio
import json
import sys

from websockets.asyncio.client import connect


async def drain(url: str, clients: int, topic: str) -> None:
    """Count until the standard input ends."""
    received = 0

    async def read(number: int) -> None:
        nonlocal received
        async with connect(url, compression=None, max_size=None) as ws:
            await ws.send(json.dumps({"op": "subscribe", "topic": topic, "id": f"drain:{number}"}))
            ready.release()
            async for _ in ws:
                received += 1

    ready = asyncio.Semaphore(0)
    tasks = [asyncio.create_task(read(number)) for number in range(clients)]
    for _ in tasks:
        await ready.acquire()
    print(json.dumps({"ready": clients}), flush=True)
    while await asyncio.to_thread(sys.stdin.readline):
        print(json.dumps({"received": received}), flush=True)
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


if __name__ == "__main__":
    asyncio.run(drain(sys.argv[1], int(sys.argv[2]), sys.argv[3]))
