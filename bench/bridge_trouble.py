"""STOP on a link that carries a tenth of the offered load, and commands over an outage of 4 s.

STOP is a service call, timed from sending it to its answer at a plain `websockets` client, at odd moments. The link is
a TCP proxy of 2 Mbit/s in each direction that keeps 8 kB at most. On it the client subscribes to samples of 0.9 kB that come ten
times as fast as they fit; the growth is against the same link with nothing else on it. *With scans* means that messages of 20 kB,
which take 82 ms over that link each, are a part of the load. The other way is a server that sends by `websockets.broadcast`.

In the outage the link freezes (nothing passes and neither end is informed; data that its sender has not given up arrives late) or breaks
(connections are reset, new ones refused). A program drives 20 times a second all the while. It has healed when telemetry comes
again and the first new command is at the robot's server. Stale are the commands that arrive there over 0.3 s old, whether
the robot would still refuse them or not. The other way is roslibpy on the same server and link; the value stated
for it is 9.5 s from the beginning of an outage of 4 s.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import random
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager

from websockets.asyncio.client import ClientConnection, connect

from bench.support.child import Child, child
from bench.support.figures import Figure, Stated, percentile
from bench.support.harness import Context, Sides
from bench.support.traffic import MESSAGES, ODOM, SCAN
from bench.support.wire import Wire, wire
from bridge.codec import to_json

BROADCAST = "websockets.broadcast"
ROSLIBPY = "roslibpy"
FIGURES = (
    Figure("stop_idle", "ms", "STOP to its answer on the slow link, nothing else, median", against=BROADCAST),
    Figure("stop_grows", "ms", "grows under ten times what it carries, median", 20.0, against=BROADCAST),
    Figure("stop_grows_p95", "ms", "the same, 95 of 100", against=BROADCAST),
    Figure("stop_grows_scans", "ms", "the same with scans, median", against=BROADCAST),
    Figure("frozen", "s", "a frozen link heals after its return within", 2.0, against=ROSLIBPY),
    Figure("frozen_stale", "", "stale commands at the robot's server after it", 0.0, against=ROSLIBPY),
    Figure(
        "broken",
        "s",
        "a broken link heals after its return within",
        2.0,
        against=ROSLIBPY,
        stated=Stated("roslibpy 2.1 on rosbridge_server", 5.5),
    ),
    Figure(
        "broken_stale",
        "",
        "stale commands at the robot's server after it",
        0.0,
        against=ROSLIBPY,
        stated=Stated("roslibpy 2.1 on rosbridge_server", 5),
    ),
)
REPEATS = 1

LINK = 250_000.0
"""What the slow link carries [byte/s]."""
TIMES = 10.0
"""How many times as much is offered."""
WATCHED = 6.0
"""How long STOPs are sent [s]."""
PAUSE = (0.03, 0.09)
"""Between two STOPs [s]."""
OUTAGE = 4.0
"""[s]"""
STALE = 0.3
"""The robot's own bound for a drive command [s]."""
HEAL_TIMEOUT = 15.0
"""How long healing is waited for [s]."""

_dice = random.Random(3)


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(
        lambda: {**stopping("ours"), **outages("ours")}, lambda: {**stopping("naive"), **outages("roslibpy")}
    )


def stopping(kind: str) -> dict[str, float]:
    """STOP's figures [ms]."""
    with child("bench.support.rosbridge", kind) as server:
        port = server.receive()["port"]
        idle = asyncio.run(stops(port, ()))
        found = {}
        for name, topics in (("small", (ODOM,)), ("scans", (ODOM, SCAN))):
            share = LINK * TIMES / len(topics)
            rates = {topic: share / len(to_json(MESSAGES[topic])) for topic in topics}
            server.ask({"do": "flow", "rates": rates})
            found[name] = asyncio.run(stops(port, topics))
    base, small = percentile(idle, 0.5), found["small"]
    return {
        "stop_idle": base * 1e3,
        "stop_grows": (percentile(small, 0.5) - base) * 1e3,
        "stop_grows_p95": (percentile(small, 0.95) - percentile(idle, 0.95)) * 1e3,
        "stop_grows_scans": (percentile(found["scans"], 0.5) - base) * 1e3,
    }


async def stops(port: int, topics: Iterable[str]) -> list[float]:
    """How long each STOP took [s]; the last one so far, when it was not answered at all."""
    async with (
        wire(port, LINK) as link,
        connect(f"ws://127.0.0.1:{link.port}", compression=None, max_size=None, proxy=None) as ws,
    ):
        for topic in topics:
            await ws.send(json.dumps({"op": "subscribe", "topic": topic, "type": MESSAGES[topic].MSGTYPE}))
        answered = asyncio.Event()
        reading = asyncio.create_task(_listen(ws, answered))
        try:
            async with asyncio.timeout(WATCHED + 1.0):
                return await _stopping(ws, answered)
        finally:
            reading.cancel()
            await asyncio.gather(reading, return_exceptions=True)
            ws.transport.abort()


async def _stopping(ws: ClientConnection, answered: asyncio.Event) -> list[float]:
    await asyncio.sleep(1.0)
    taken: list[float] = []
    end = time.monotonic() + WATCHED - 1.0
    while (sent := time.monotonic()) < end:
        answered.clear()
        await ws.send(json.dumps({"op": "call_service", "service": "/stop", "id": "stop"}))
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(max(0.5, end - sent)):
                await answered.wait()
        taken.append(time.monotonic() - sent)
        await asyncio.sleep(_dice.uniform(*PAUSE))
    return taken


async def _listen(ws: ClientConnection, answered: asyncio.Event) -> None:
    while True:
        if b"service_response" in (await ws.recv(decode=False))[:80]:
            answered.set()


def outages(kind: str) -> dict[str, float]:
    """What comes after the two kinds of outage."""
    found: dict[str, float] = {}
    for name, freeze in (("frozen", True), ("broken", False)):
        with child("bench.support.rosbridge", "ours") as server:
            port = server.receive()["port"]
            server.ask({"do": "flow", "rates": {ODOM: 20.0}})
            healed, stale = asyncio.run(outage(kind, server, port, freeze=freeze))
        found |= {name: healed, f"{name}_stale": stale}
    return found


async def outage(kind: str, server: Child, port: int, *, freeze: bool) -> tuple[float, float]:
    """How long healing took [s], and how many stale commands arrived at the server."""
    async with wire(port) as link:
        with child("bench.support.operator", kind, str(link.port)) as driver:
            await asyncio.to_thread(driver.receive)
            await asyncio.sleep(1.5)
            await away(link, freeze=freeze)
            back = time.monotonic()
            healed = math.inf
            while math.isinf(healed) and time.monotonic() < back + HEAL_TIMEOUT:
                await asyncio.sleep(0.25)
                heard = (await asyncio.to_thread(driver.ask, {}))["heard"]
                commands = await asyncio.to_thread(server.ask, {"do": "commands"})
                healed = healing(back, heard, commands["commands"])
            await asyncio.sleep(1.0)  # anything else that was kept for later
            commands = await asyncio.to_thread(server.ask, {"do": "commands"})
    return healed, float(sum(arrived - given > STALE for arrived, given in commands["commands"]))


async def away(link: Wire, *, freeze: bool) -> None:
    """Let the link be away for a while."""
    if freeze:
        link.freeze()
        await asyncio.sleep(OUTAGE)
        link.thaw()
        return
    await link.cut()
    await asyncio.sleep(OUTAGE)
    link.open()


def healing(back: float, heard: Sequence[float], commands: Sequence[tuple[float, float]]) -> float:
    """From the link's return at `back` until telemetry and new commands pass [s]; infinite when they do not."""
    telemetry = min((at for at in heard if at > back), default=math.inf)
    command = min((arrived for arrived, given in commands if given > back), default=math.inf)
    return max(telemetry, command) - back
