"""Cost of a message to the server, and round-trip time of a command.

Server CPU is user and system time of the server's whole process for each message published; clients are in a process of
their own. *Relayed*: a client publishes JSON. *Made on the robot*: the server itself publishes. Either way 80 follow each
other as fast as they can, the next 80 when all subscribers have them.

Assumed is that the robot publishes five messages in each step of its loop, as our robot side does with what it measured: what
a client gets in one step leaves in one write, and a step with its write costs about as much as a message. So an Odometry is
measured at one and at twenty a step as well. rosbridge_server's values are from a node that flooded it for seconds, so that
neither it nor its client ever slept; here both sleep between the bursts. What a wait of that length costs a process with
nothing to do (some 0.15 ms, 2 µs a message) is taken off on both sides.

Nothing is left out: types are checked, subscribers have their lanes and windows, and every message must arrive. The Odometry has 0.9 kB as text, the scan 1080 beams
(20 kB). The other way is the standard library's json for each client anew over the same `websockets`; it checks nothing and
knows no CBOR.

A round trip is a small String published and received again on one connection, at 50 Hz, by a plain `websockets` client that
looks at nothing else; *under load* the connection also receives 30 pictures of 45 kB, 50 odometries and 10 scans a second, as
JSON. *A server with Nagle on* is the tests' own one with the manners of the ROS 1 server, under the same load; there our
client, which reads and checks everything, is compared with the plain one.
"""

from __future__ import annotations

import asyncio
import gc
import time
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from bench.support.child import Child, child
from bench.support.echo import lean_trips, our_trips
from bench.support.figures import Figure, Stated, percentile
from bench.support.harness import Context, Sides
from bench.support.traffic import MESSAGES, ODOM, RATES, SCAN

EACH = "json encoded for each client"
PLAIN = "plain websockets client"


def rosbridge(value: float) -> Stated:
    """What the real server was measured to take, on another machine."""
    return Stated("rosbridge_server 0.11.17", value)


def cost(name: str, meaning: str, times: float | None, peer: float) -> Figure:
    """A row of server CPU: at most the peer's `peer` [µs] over `times`."""
    target = None if times is None else peer / times
    return Figure(name, "µs", f"{meaning}, server's CPU", target, against=EACH, stated=rosbridge(peer))


def trip(name: str, meaning: str, target: float, against: str, peer: float | None) -> Figure:
    """A row of round trips [ms]."""
    stated = None if peer is None else rosbridge(peer)
    return Figure(name, "ms", f"round trip {meaning}", target, against=against, stated=stated)


FIGURES = (
    cost("relay_odom_1", "an Odometry relayed to 1 subscriber", 15, 311),
    cost("relay_odom_10", "an Odometry relayed to 10 subscribers", 12, 869),
    cost("relay_scan", "a scan relayed to 1 subscriber", 25, 2174),
    cost("robot_odom_1", "an Odometry made on the robot, to 1 subscriber", 12, 115),
    cost("robot_odom_10", "an Odometry made on the robot, to 10 subscribers", 12, 665),
    cost("robot_odom_step_1", "an Odometry made on the robot, alone in its step, to 1 subscriber", None, 115),
    cost("robot_odom_step_20", "an Odometry made on the robot, 20 in a step, to 1 subscriber", None, 115),
    Figure(
        "tenth_odom", "%", "what the 10th subscriber of an Odometry costs, of the first", 15, against=EACH
    ),
    Figure(
        "tenth_scan", "%", "what the 10th subscriber of a scan as JSON costs, of the first", 15, against=EACH
    ),
    cost("robot_scan", "a scan made on the robot, to 1 subscriber as JSON", None, 575),
    cost("robot_scan_cbor", "a scan made on the robot, to 1 subscriber as CBOR", 5, 72.4),
    trip("idle_p50", "idle, median", 0.25, EACH, 0.33),
    trip("idle_p99", "idle, 99 of 100", 1.0, EACH, 3.4),
    trip("loaded_p50", "under load, median", 0.4, EACH, 15.4),
    trip("loaded_p99", "under load, 99 of 100", 3.0, EACH, 42.6),
    trip("nagle_p50", "through a server with Nagle on, under load, our client, median", 5.0, PLAIN, None),
    trip("nagle_p99", "through a server with Nagle on, under load, our client, 99 of 100", 5.0, PLAIN, None),
)
REPEATS = 3

STEP = 5
"""Messages that the robot publishes in one step of its loop where no other number is given; ours publishes pose, odometry, IMU,
wheels and tf in one."""

MESSAGES_A_ROW = 800
BURST = 80
"""So many follow each other at once; the next ones when everybody has them."""
TRIPS = 150
HERTZ = 50.0
LOAD = [(topic, MESSAGES[topic].MSGTYPE) for topic in RATES]
PREFIX = "/bench"
"""Of the topics on the foreign server, which has some of the usual ones itself."""


def ours() -> dict[str, float]:
    """One sample of every figure, our server and our client."""
    return {**costs("ours"), **trips("ours"), **foreign(our_client)}


def peer() -> dict[str, float]:
    """One sample of every figure, the other way."""
    return {**costs("naive"), **trips("naive"), **foreign(lean_client)}


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept: each sample starts servers and clients of its own."""
    yield Sides(ours, peer)


def costs(kind: str) -> dict[str, float]:
    """CPU of a server a message [µs]."""
    with child("bench.support.rosbridge", kind) as process:
        server = Server(process, f"ws://127.0.0.1:{process.receive()['port']}")
        found = {
            "relay_odom_1": relayed(server, ODOM, 1),
            "relay_odom_10": relayed(server, ODOM, 10),
            "relay_scan": relayed(server, SCAN, 1),
            "robot_odom_1": made(server, ODOM, 1),
            "robot_odom_10": made(server, ODOM, 10),
            "robot_odom_step_1": made(server, ODOM, 1, step=1),
            "robot_odom_step_20": made(server, ODOM, 1, step=20),
            "robot_scan": made(server, SCAN, 1),
            "robot_scan_cbor": made(server, SCAN, 1, compression="cbor"),
        }
        ten = made(server, SCAN, 10)
    found["tenth_odom"] = more(found["robot_odom_1"], found["robot_odom_10"])
    found["tenth_scan"] = more(found["robot_scan"], ten)
    return found


def more(one: float, ten: float) -> float:
    """What each subscriber after the first costs, of the first [%]."""
    return (ten - one) / 9 / one * 100


class Server(NamedTuple):
    """A server that runs."""

    process: Child
    url: str


@contextmanager
def watched(server: Server, topic: str, **asked: object) -> Iterator[Child]:
    """Clients that watch `topic`."""
    with child("bench.support.crowd", server.url) as crowd:
        crowd.receive()
        crowd.ask({"do": "watch", "topic": topic, "queue_length": 100, **asked})
        time.sleep(0.2)  # they are known now
        yield crowd


def relayed(server: Server, like: str, clients: int) -> float:
    """CPU a message that one client publishes [µs]."""
    with watched(server, "/relayed", type=MESSAGES[like].MSGTYPE, clients=clients) as crowd:
        order = {"do": "relay", "topic": "/relayed", "like": like, "burst": BURST}
        crowd.ask({**order, "count": 10 * BURST})
        before = server.process.ask({"do": "cpu"})["cpu"]
        crowd.ask({**order, "count": MESSAGES_A_ROW})
        spent: float = server.process.ask({"do": "cpu"})["cpu"] - before
    return spent / MESSAGES_A_ROW * 1e6


def made(server: Server, topic: str, clients: int, compression: str = "none", step: int = STEP) -> float:
    """CPU a message that the server itself publishes, `step` in each step of its loop [µs].

    RuntimeError when some do not arrive.
    """
    type = MESSAGES[topic].MSGTYPE
    order = {"do": "publish", "topic": topic, "count": BURST, "step": step}
    spent: list[float] = []
    with watched(server, topic, type=type, clients=clients, compression=compression) as crowd:
        goal = crowd.ask({"do": "received"})["received"]
        while len(spent) * BURST < MESSAGES_A_ROW:
            spent.append(server.process.ask(order)["cpu"])
            goal += BURST * clients
            came = crowd.ask({"do": "received", "until": goal})["received"]
            if came != goal:
                raise RuntimeError(f"{goal - came} of {BURST * clients} messages did not arrive.")
    return sum(spent[1:]) / (len(spent) - 1) / BURST * 1e6


def trips(kind: str) -> dict[str, float]:
    """Round trips [ms] through a server of ours, or the naive one."""
    with child("bench.support.rosbridge", kind) as server:
        url = f"ws://127.0.0.1:{server.receive()['port']}"
        idle = quietly(lean_trips(url, (), TRIPS, HERTZ))
        server.ask({"do": "flow", "rates": RATES})
        return {**shares("idle", idle), **shares("loaded", quietly(lean_trips(url, LOAD, TRIPS, HERTZ)))}


def foreign(client: Callable[[str], Coroutine[Any, Any, list[float]]]) -> dict[str, float]:
    """Round trips [ms] through a server with Nagle on, to which another client publishes the load."""
    with child("tests.bridge.client.foreign_server", "--port", "0") as server:
        url = server.line().split()[-1]
        with child("bench.support.crowd", url) as crowd:
            crowd.receive()
            crowd.ask({"do": "feed", "rates": RATES, "prefix": PREFIX})
            return shares("nagle", quietly(client(url)))


def our_client(url: str) -> Coroutine[Any, Any, list[float]]:
    """Our client under the load of the foreign server."""
    return our_trips(url, [(PREFIX + topic, type(msg)) for topic, msg in MESSAGES.items()], TRIPS, HERTZ)


def lean_client(url: str) -> Coroutine[Any, Any, list[float]]:
    """The plain one under the same."""
    return lean_trips(url, [(PREFIX + topic, type) for topic, type in LOAD], TRIPS, HERTZ)


def shares(name: str, seconds: list[float]) -> dict[str, float]:
    """Median and 99 of 100 [ms]."""
    return {f"{name}_p50": percentile(seconds, 0.5) * 1e3, f"{name}_p99": percentile(seconds, 0.99) * 1e3}


def quietly(work: Coroutine[Any, Any, list[float]]) -> list[float]:
    """Run it here, with older objects frozen for Python's garbage collector."""
    gc.freeze()
    try:
        return asyncio.run(work)
    finally:
        gc.unfreeze()
