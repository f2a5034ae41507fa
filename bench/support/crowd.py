"""Plain WebSocket clients of a rosbridge server in a process of their own, `python -m bench.support.crowd URL`.

Each line of JSON on the standard input is answered by one:

- `{"do": "watch", "topic": T, "type": TYPE, "clients": N, "compression": C}`: N more clients subscribe; `{}` when they have asked;
- `{"do": "received", "until": N}`: `{"received": COUNT}` of all of them together, as soon as there are N or none comes any more;
- `{"do": "relay", "topic": T, "like": L, "count": N, "burst": B}`: one more client publishes the usual message of the
  topic L on T, B at a time, the next B when all watchers have got them; `{"seconds": …}`;
- `{"do": "feed", "rates": {T: HZ}, "prefix": P}`: one more client publishes the usual messages on P + T so often from now on;
- `{"do": "stall", "topic": T, "again": S}`: one more client subscribes and reads nothing; every S seconds it breaks off and
  comes back to do the same.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import sys
import time
from collections.abc import Awaitable, Callable, Coroutine, Mapping
from typing import Any

from websockets.asyncio.client import ClientConnection, connect

from bench.support.rosbridge import flow
from bench.support.traffic import MESSAGES
from bridge.client.tls import context
from bridge.codec import to_json

BURST_TIMEOUT = 20.0
"""Longest time in which a burst arrives [s]."""

QUIET_TIME = 0.5
"""After so long without a message [s] none is on its way any more."""


class Crowd:
    """The clients."""

    def __init__(self, url: str) -> None:
        self._url = url
        self.message_count = 0
        self._watchers = 0
        self._goal = 0
        self._reached = asyncio.Event()
        self._open: list[ClientConnection] = []
        self._work: set[asyncio.Task[None]] = set()

    async def watch(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """More clients subscribe."""
        for _ in range(asked["clients"]):
            self._watchers += 1
            ws = await self._subscribed(f"crowd:{self._watchers}", asked)
            self._begin(self._read(ws))
        return {}

    async def count(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Number of messages so far, once it has reached `until` or none comes any more."""
        self._goal, before = asked.get("until", 0), -1
        while before < self.message_count < self._goal:
            before = self.message_count
            self._reached.clear()
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(QUIET_TIME):
                    await self._reached.wait()
        return {"received": self.message_count}

    async def relay(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Publish and wait until it is there, again and again; RuntimeError when something got lost."""
        ws = await self._connected()
        text, began = await self._advertised(ws, asked["topic"], asked["like"]), time.monotonic()
        for _ in range(asked["count"] // asked["burst"]):
            self._goal = self.message_count + asked["burst"] * self._watchers
            self._reached.clear()
            for _ in range(asked["burst"]):
                await ws.send(text, text=True)
            async with asyncio.timeout(BURST_TIMEOUT):
                await self._reached.wait()
        seconds = time.monotonic() - began
        await ws.close()
        return {"seconds": seconds}

    async def feed(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Publish at a rate."""
        ws = await self._connected()
        sending: asyncio.Queue[bytes] = asyncio.Queue()
        for topic, rate in asked["rates"].items():
            text = await self._advertised(ws, asked["prefix"] + topic, topic)
            self._begin(flow(_putting(sending, text), topic, rate))

        async def send() -> None:
            while True:
                await ws.send(await sending.get(), text=True)

        self._begin(send())
        return {}

    async def stall(self, asked: Mapping[str, Any]) -> dict[str, Any]:
        """Subscribe and read nothing."""

        async def stand_still() -> None:
            while True:
                ws = await self._subscribed("stalled", asked)
                ws.transport.pause_reading()
                await asyncio.sleep(asked["again"])
                ws.transport.abort()

        self._begin(stand_still())
        return {}

    async def close(self) -> None:
        """End all that was begun."""
        for task in self._work:
            task.cancel()
        await asyncio.gather(*self._work, return_exceptions=True)
        for ws in self._open:
            ws.transport.abort()

    async def _connected(self) -> ClientConnection:
        tls = context() if self._url.startswith("wss") else None
        ws = await connect(self._url, compression=None, max_size=None, proxy=None, ssl=tls)
        self._open.append(ws)
        return ws

    async def _subscribed(self, id: str, asked: Mapping[str, Any]) -> ClientConnection:
        ws = await self._connected()
        wanted = {key: asked[key] for key in ("topic", "type", "compression", "queue_length") if key in asked}
        await ws.send(json.dumps({"op": "subscribe", "id": id, **wanted}))
        return ws

    async def _advertised(self, ws: ClientConnection, topic: str, like: str) -> bytes:
        """Say that a message like that of `like` is going to come on `topic`; gives the whole operation as text."""
        msg = MESSAGES[like]
        await ws.send(json.dumps({"op": "advertise", "topic": topic, "type": msg.MSGTYPE}))
        return b'{"op":"publish","topic":"%b","msg":%b}' % (topic.encode(), to_json(msg))

    async def _read(self, ws: ClientConnection) -> None:
        while True:
            await ws.recv(decode=False)
            self.message_count += 1
            if self.message_count == self._goal:
                self._reached.set()

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        self._work.add(asyncio.create_task(work))


def _putting(queue: asyncio.Queue[bytes], text: bytes) -> Callable[[str], None]:
    return lambda _: queue.put_nowait(text)


async def run(url: str) -> None:
    """Answer requests until the standard input ends."""
    crowd = Crowd(url)
    doing: dict[str, Callable[[Mapping[str, Any]], Awaitable[dict[str, Any]]]] = {
        "watch": crowd.watch,
        "received": crowd.count,
        "relay": crowd.relay,
        "feed": crowd.feed,
        "stall": crowd.stall,
    }
    print("[]", flush=True)
    try:
        while line := await asyncio.to_thread(sys.stdin.readline):
            asked = json.loads(line)
            print(json.dumps(await doing[asked["do"]](asked)), flush=True)
    finally:
        await crowd.close()


if __name__ == "__main__":
    asyncio.run(run(sys.argv[1]))
