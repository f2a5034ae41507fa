"""Round trips of a small message through a rosbridge server: published on a topic that the sender itself subscribed to."""

from __future__ import annotations

import asyncio
import contextlib
import json
import random
import time
from collections.abc import Callable, Iterable

from websockets.asyncio.client import ClientConnection, connect

from bridge.client.client import BridgeClient, Phase
from bridge.msgs import Msg
from bridge.msgs.std_msgs import String

__all__ = ["ECHO", "lean_trips", "our_trips"]

ECHO = "/echo"
ECHO_TIMEOUT = 2.0
"""An echo that takes longer is lost [s]."""
SETTLING = 1.0
"""Before the first one [s]: what was subscribed flows."""

_dice = random.Random(2)


async def lean_trips(url: str, topics: Iterable[tuple[str, str]], count: int, rate: float) -> list[float]:
    """How long each of `count` echoes took [s], one at a time; a plain WebSocket client looks at nothing else.

    `topics` are the names and types of what the same connection receives meanwhile; `rate` [Hz] is how often one is sent.
    """
    async with connect(url, compression=None, max_size=None, proxy=None) as ws:
        for topic, type in (*topics, (ECHO, "std_msgs/String")):
            await ws.send(json.dumps({"op": "subscribe", "topic": topic, "type": type, "queue_length": 1}))
        await ws.send(json.dumps({"op": "advertise", "topic": ECHO, "type": "std_msgs/String"}))
        came = asyncio.Event()
        reading = asyncio.create_task(_wake(ws, came))
        text = json.dumps({"op": "publish", "topic": ECHO, "msg": {"data": "x"}})
        sending: set[asyncio.Task[None]] = set()

        def send() -> None:
            task = asyncio.ensure_future(ws.send(text))
            sending.add(task)
            task.add_done_callback(sending.discard)

        try:
            return await _timed(send, came, count, rate)
        finally:
            reading.cancel()
            await asyncio.gather(reading, return_exceptions=True)


async def our_trips(
    url: str, topics: Iterable[tuple[str, type[Msg]]], count: int, rate: float
) -> list[float]:
    """The same with our own client, which reads and checks everything that it receives."""
    connected, came = asyncio.Event(), asyncio.Event()

    def note(_: object) -> None:
        if client.state.phase is Phase.CONNECTED:
            connected.set()

    client = BridgeClient(url, on_state=note)
    for topic, type in topics:
        client.subscribe(topic, type, lambda *_: None)
    client.subscribe(ECHO, String, lambda *_: came.set())
    client.advertise(ECHO, String)
    running = asyncio.create_task(client.run())
    try:
        async with asyncio.timeout(10.0):
            await connected.wait()
        return await _timed(lambda: client.publish(ECHO, String(data="x")), came, count, rate)
    finally:
        await client.close()
        await running


async def _wake(ws: ClientConnection, came: asyncio.Event) -> None:
    while True:
        message = await ws.recv(decode=False)
        if b"/echo" in message[:80]:
            came.set()


async def _timed(send: Callable[[], object], came: asyncio.Event, count: int, rate: float) -> list[float]:
    await asyncio.sleep(SETTLING)
    taken = []
    for _ in range(count):
        came.clear()
        sent = time.perf_counter()
        send()
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(ECHO_TIMEOUT):
                await came.wait()
        taken.append(time.perf_counter() - sent)
        await asyncio.sleep(max(0.0, _dice.uniform(0.5, 1.5) / rate - taken[-1]))
    return taken
