"""Messages to text and back, and one laser scan published to 1 and to 10 clients.

The scan has 360 beams; the standard library's `json` is given the same message as dicts and lists, already made. The
publishing rows are the server thread's own processor time a message at 200 messages a second, clients in a process of
their own; the other way encodes with `json` anew for each client, as the ROS 1 rosbridge_server does, over the same
`websockets` without compression.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial

from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from bench.support.child import child
from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bridge.codec import from_cbor, from_json, to_cbor, to_json
from bridge.msgs import Msg, nav_msgs, sensor_msgs
from bridge.msgs.arrays import Float32Array
from bridge.server import BridgeServer

JSON = "standard library json"
DICTS = "standard library json, unchecked dicts"
EACH = "json encoded for each client"
FIGURES = (
    Figure("odom_encode", "µs", "an Odometry to JSON", against=JSON),
    Figure("odom_decode", "µs", "an Odometry from JSON, checked and typed", against=DICTS),
    Figure("scan_encode", "µs", "a LaserScan to JSON", against=JSON),
    Figure("scan_decode", "µs", "a LaserScan from JSON, checked and typed", against=DICTS),
    Figure("scan_to_cbor", "µs", "a LaserScan to CBOR", against=JSON),
    Figure("scan_from_cbor", "µs", "a LaserScan's numbers from CBOR", against=JSON),
    Figure("publish_1", "µs", "a scan published to 1 client, server's CPU", against=EACH),
    Figure("publish_10", "µs", "a scan published to 10 clients, server's CPU", against=EACH),
)
REPEATS = 3

TOPIC = "/scan"
RATE = 200
"""Messages a second; slow enough that none is replaced by a newer one."""
MESSAGES = 200
SHARE_DELIVERED = 0.98
"""Below it the figure would be of something else than delivering."""
TIMED = 0.1
"""How long each codec row is repeated [s]."""

SCAN = sensor_msgs.LaserScan(
    angle_min=-math.pi,
    angle_increment=math.tau / 360,
    range_min=0.1,
    range_max=12.0,
    ranges=Float32Array([5 + 3 * math.sin(beam / 9) for beam in range(360)]),
)
ODOM = nav_msgs.Odometry()


def plain(msg: Msg) -> dict[str, object]:
    """The message as dicts and lists only."""
    return json.loads(to_json(msg))


def ours() -> dict[str, float]:
    """One sample of every figure, our way."""
    scan, odom, binary = to_json(SCAN), to_json(ODOM), to_cbor(SCAN)
    return {
        "odom_encode": micros(partial(to_json, ODOM)),
        "odom_decode": micros(partial(from_json, odom, nav_msgs.Odometry)),
        "scan_encode": micros(partial(to_json, SCAN)),
        "scan_decode": micros(partial(from_json, scan, sensor_msgs.LaserScan)),
        "scan_to_cbor": micros(partial(to_cbor, SCAN)),
        "scan_from_cbor": micros(partial(from_cbor, binary)),
        **{f"publish_{count}": asyncio.run(publishing(bridge(), count)) for count in (1, 10)},
    }


def peer() -> dict[str, float]:
    """One sample of every figure, the other way."""
    scan, odom = plain(SCAN), plain(ODOM)
    encode, decode = micros(partial(json.dumps, scan)), micros(partial(json.loads, json.dumps(scan)))
    return {
        "odom_encode": micros(partial(json.dumps, odom)),
        "odom_decode": micros(partial(json.loads, json.dumps(odom))),
        "scan_encode": encode,
        "scan_decode": decode,
        "scan_to_cbor": encode,
        "scan_from_cbor": decode,
        **{f"publish_{count}": asyncio.run(publishing(naive(), count)) for count in (1, 10)},
    }


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing to set up."""
    yield Sides(ours, peer)


def micros(work: Callable[[], object]) -> float:
    """CPU time of one call [µs]."""
    calls, started = 0, time.thread_time()
    while time.thread_time() - started < TIMED:
        for _ in range(20):
            work()
        calls += 20
    return (time.thread_time() - started) / calls * 1e6


Server = contextlib.AbstractAsyncContextManager[tuple[int, Callable[[], object]]]
"""Serves while entered; gives its port and what publishes one message."""


@contextlib.asynccontextmanager
async def bridge() -> Iterator[tuple[int, Callable[[], object]]]:
    """The project's own server."""
    server = BridgeServer(services=(), on_message=lambda *_: None)
    await server.start(port=0)
    try:
        yield server.port, partial(server.publish, TOPIC, SCAN)
    finally:
        await server.close()


@contextlib.asynccontextmanager
async def naive() -> Iterator[tuple[int, Callable[[], object]]]:
    """One `json.dumps` a client and message."""
    scan = plain(SCAN)
    watchers: set[ServerConnection] = set()
    sending: set[asyncio.Task[None]] = set()

    async def serve_client(ws: ServerConnection) -> None:
        with contextlib.suppress(ConnectionClosed):
            async for _ in ws:
                watchers.add(ws)
        watchers.discard(ws)

    def publish() -> None:
        for ws in watchers:
            text = json.dumps({"op": "publish", "topic": TOPIC, "msg": scan})
            task = asyncio.ensure_future(ws.send(text))
            sending.add(task)
            task.add_done_callback(sending.discard)

    async with serve(serve_client, "127.0.0.1", 0, compression=None) as server:
        yield next(iter(server.sockets)).getsockname()[1], publish


async def publishing(server: Server, clients: int) -> float:
    """CPU time of this thread a message [µs], everything that serving it takes included."""
    async with server as (port, publish):
        with child("bench.support.drain", f"ws://127.0.0.1:{port}", str(clients), TOPIC) as watcher:
            await asyncio.to_thread(watcher.hear)
            await asyncio.sleep(0.2)  # the subscriptions are on their way
            spent = await paced(publish)
            await asyncio.sleep(0.2)
            told: Mapping[str, int] = await asyncio.to_thread(watcher.ask, {})
    if told["received"] < SHARE_DELIVERED * MESSAGES * clients:
        raise RuntimeError(f"Only {told['received']} of {MESSAGES * clients} messages arrived.")
    return spent / MESSAGES * 1e6


async def paced(publish: Callable[[], object]) -> float:
    """CPU time [s] of publishing `MESSAGES` messages, `RATE` a second."""
    loop = asyncio.get_running_loop()
    begun, cpu = loop.time(), time.thread_time()
    for number in range(MESSAGES):
        publish()
        await asyncio.sleep(max(0.0, begun + (number + 1) / RATE - loop.time()))
    return time.thread_time() - cpu
