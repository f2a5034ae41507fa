"""What TLS and a key cost: a connection, and each write.

A *write* is what leaves for one client at once: the server's CPU for a message that is alone in its step, for an Odometry (0.9 kB), a scan (20 kB)
and a larger scan (45 kB), over TLS less the same without. The other way is the bare library: `websockets` with the same
certificate, which sends texts that were encoded before and does nothing else. 80 follow each other as fast as they can, and every one must arrive.

A *connection* counts from the first packet to the answer of the first question, /rosapi/get_time, by a plain `websockets` client: to our
server without TLS, and with it and a pinned certificate, in turns.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from websockets.asyncio.client import connect

from bench.bridge import Server, made
from bench.support.child import child
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.traffic import ODOM, SCAN
from bridge.client.tls import context, fingerprint

BARE = "websockets with TLS"
SIZES = {"0.9 kB": (ODOM, (), 4.5), "20 kB": (SCAN, (), 9.0), "45 kB": (SCAN, ("large",), 21.0)}
"""By size, the topic, what makes it so large, and the most that TLS may add to a write [µs]."""
FIGURES = (
    *(
        Figure(f"write {size}", "µs", f"TLS adds to a write of {size}, server's CPU", most, against=BARE)
        for size, (_, _, most) in SIZES.items()
    ),
    *(
        Figure(f"{how} {size}", "µs", f"a write of {size}, {how}, server's CPU", against=BARE)
        for size in SIZES
        for how in ("plain", "tls")
    ),
    Figure("connect_plain", "ms", "a connection to its first answer, plain, median", against=BARE),
    Figure("connect_tls", "ms", "the same by TLS with a pinned certificate, median", against=BARE),
    Figure("connect_adds", "ms", "TLS adds to a connection", 20, against=BARE),
)
REPEATS = 3
CONNECTIONS = 100


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept: each sample starts servers of its own."""
    yield Sides(lambda: costs("ours"), lambda: costs("bare"))


def costs(kind: str) -> dict[str, float]:
    """One sample of all figures of a kind of server."""
    found: dict[str, float] = {}
    for size, (topic, flags, _) in SIZES.items():
        with secured(kind, *flags) as servers:
            for how, server in servers.items():
                found[f"{how} {size}"] = made(server, topic, 1, step=1)
            if size == next(iter(SIZES)):
                found |= connections({how: server.url for how, server in servers.items()})
        found[f"write {size}"] = found[f"tls {size}"] - found[f"plain {size}"]
    return found


@contextmanager
def secured(kind: str, *flags: str) -> Iterator[dict[str, Server]]:
    """Two servers of a kind, without and with TLS."""
    with (
        child("bench.support.rosbridge", kind, *flags) as plain,
        child("bench.support.rosbridge", kind, "tls", *flags) as tls,
    ):
        yield {
            "plain": Server(plain, f"ws://127.0.0.1:{plain.receive()['port']}"),
            "tls": Server(tls, f"wss://127.0.0.1:{tls.receive()['port']}"),
        }


def connections(urls: Mapping[str, str]) -> dict[str, float]:
    """Medians of the time from the first packet to the first answer [ms], in turns."""
    took = asyncio.run(_connections(urls))
    plain, secure = (percentile(took[how], 0.5) * 1e3 for how in ("plain", "tls"))
    return {"connect_plain": plain, "connect_tls": secure, "connect_adds": secure - plain}


async def _connections(urls: Mapping[str, str]) -> dict[str, list[float]]:
    took: dict[str, list[float]] = {how: [] for how in urls}
    for _ in range(CONNECTIONS):
        for how, url in urls.items():
            took[how].append(await answered(url))
    return took


async def answered(url: str, token: str = "", pin: str = "") -> float:
    """Connect, ask one question, and leave; how long it took to the answer [s]. RuntimeError for a certificate other than `pin`."""
    tls = context() if url.startswith("wss") else None
    headers = {"Authorization": f"Bearer {token}"} if token else {}
    began = time.perf_counter()
    async with connect(url, compression=None, proxy=None, ssl=tls, additional_headers=headers) as ws:
        if pin and fingerprint(ws.transport) != pin:
            raise RuntimeError("This is another certificate.")
        await ws.send(json.dumps({"op": "call_service", "service": "/rosapi/get_time", "id": "t"}))
        while "service_response" not in str(await ws.recv())[:200]:
            pass
        return time.perf_counter() - began
