"""All protocols of a robot at once: how long a call is on its way, what they cost, and STOP by each while the others are flooded.

The robot side is a process of its own with the simulated patrol robot, and a second one has a client of each protocol, by the
libraries that its users have: websockets, httpx, aiomqtt, aiokafka, aiocoap. MQTT goes by Mosquitto, or by iotcore's broker
where it is not installed, Kafka by librdkafka's mock cluster. A call is timed from before the client's library has it until the
robot's door is asked, STOP until the door has done it, which is when the robot was told to stand. All clients call at random
moments, 20 times a second each; in a flood each has four calls under way and sends the next as soon as one is answered. STOP
is pressed by a third process meanwhile: a program that floods keeps its own calls waiting, which is no matter of the robot.

The peer is the same robot side with rosbridge alone and one client: what a protocol takes with the others beside it is
compared with that. Memory is the process's own, without brokers, over that of a robot side without gateways.
"""

from __future__ import annotations

import json
import math
import os
import signal
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import psutil

from bench.support.child import Child, child
from bench.support.figures import Figure, percentile
from bench.support.gateway_clients import WAYS
from bench.support.harness import Context, Sides
from bench.support.station import Serving, serving
from bridge.client.remote_robot import RemoteRobot
from bridge.msgs.pilothouse_msgs import BringDownGatewayRequest, CommandResponse

ALONE = "rosbridge alone"
LIMITS = dict.fromkeys(WAYS, 10) | {"kafka": 40}
FIGURES = (
    *(
        Figure(f"{way} {what}", "ms", f"client to bus by {way}, {words}", target, against=ALONE)
        for way in WAYS
        for what, words, target in (("p50", "median", None), ("p99", "99 of 100", LIMITS[way]))
    ),
    Figure("errors", "", "calls without an answer", 0),
    *(
        Figure(f"stop {way}", "ms", f"STOP by {way} to the robot while the others are flooded, 99 of 100", 50)
        for way in WAYS
    ),
    Figure("flood", "1/s", "calls that reach the robot's door in the flood", better="more"),
    Figure("memory", "MB", "what all of them add to the process", 110),
    Figure("tasks left", "", "tasks that are left of them when all are down", 0),
    Figure("ports left", "", "ports that are left of them", 0),
    Figure("loaded", "", "libraries of adapters that a robot side without them loads", 0),
)
REPEATS = 2

CALLS = 200
STOPS = 60
PERIOD = 0.05
"""Mean time between two calls of a client [s]."""
SETTLING = 3.0
"""Time for all to be up and at rest [s]."""
SERVICE = "/task/pause"
STOP, PRESSED = "/stop", "pressed"
OWN = {
    "rosbridge": "",
    "websocket": "ws://127.0.0.1:0",
    "mqtt": "own://127.0.0.1:0",
    "kafka": "own://127.0.0.1:0",
    "coap": "coap://127.0.0.1:0",
}
"""URL of each protocol that is not on the web site."""


class Arrival(NamedTuple):
    """A call that reached the door."""

    way: str
    service: str
    at: float


class Robot(NamedTuple):
    """A robot side that writes down its calls."""

    serving: Serving
    file: Path
    endpoints: Mapping[str, str]

    def arrivals(self) -> list[Arrival]:
        """All so far."""
        lines = [line.split() for line in self.file.read_text().splitlines()]
        return [
            Arrival(words[0], words[1], float(words[2]))
            for words in lines
            if len(words) == 3 and words[0] != "state"
        ]

    def state(self) -> tuple[int, int]:
        """Tasks of its loop now, and how many of the adapters' libraries are loaded."""
        os.kill(self.serving.child.process.pid, signal.SIGUSR1)
        time.sleep(0.5)
        lines = [line.split() for line in self.file.read_text().splitlines()]
        tasks, loaded = [words[1:] for words in lines if words[0] == "state"][-1]
        return int(tasks), int(loaded)

    def process(self) -> psutil.Process:
        """Its process."""
        return psutil.Process(self.serving.child.process.pid)

    def ports(self) -> int:
        """Sockets on which it listens or receives."""
        return sum(not each.raddr for each in self.process().net_connections())


@contextmanager
def robot(*gateways: str) -> Iterator[Robot]:
    """A robot side with these gateways."""
    options = [word for each in gateways for word in ("--gateway", each)]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "calls"
        with serving("bench.support.recorded_calls", *options, before=(str(file),)) as side:
            lines = [side.child.line() for _ in gateways]
            found = dict(line.removeprefix("robotside: gateway ").split("=", 1) for line in lines)
            yield Robot(side, file, {"rosbridge": side.url, **found})


@contextmanager
def clients(endpoints: Mapping[str, str]) -> Iterator[Child]:
    """A client of each protocol, connected."""
    urls = {way: url.removesuffix("?wsdl") for way, url in endpoints.items()}
    with child("bench.support.gateway_clients", json.dumps(urls)) as made:
        made.receive()
        yield made


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(ours, alone)


def alone() -> dict[str, float]:
    """Rosbridge without anything beside it, named as each of the others."""
    with robot() as side, clients(side.endpoints) as users:
        time.sleep(SETTLING)
        times = _times(_call(users, ["rosbridge"], CALLS), side.arrivals())["rosbridge"]
    return {f"{way} {what}": percentile(times, share) * 1e3 for way in WAYS for what, share in _SHARES}


def ours() -> dict[str, float]:
    """All of them."""
    with robot() as side:
        time.sleep(SETTLING)
        bare, ports = side.process().memory_info().rss, side.ports()
        few, loaded = side.state()
    wished = [f"{way}={OWN[way]}" if way in OWN else way for way in WAYS if way != "rosbridge"]
    with robot(*wished) as side:
        with clients(side.endpoints) as users:
            time.sleep(SETTLING)
            answer = _call(users, list(WAYS), CALLS)
            times = _times(answer, side.arrivals())
            found = {
                f"{way} {what}": percentile(times[way], share) * 1e3
                for way in WAYS
                for what, share in _SHARES
            }
            found["memory"] = (side.process().memory_info().rss - bare) / 1e6
            with clients(side.endpoints) as pressing:
                found |= _flooded(users, pressing, side)
            found["errors"] = float(len(users.ask({"do": "rest"})["errors"]))
        _bring_down(side, [way for way in WAYS if way != "rosbridge"])
        found["tasks left"] = float(max(0, side.state()[0] - few))
        found["ports left"] = float(max(0, side.ports() - ports))
    return found | {"loaded": float(loaded)}


_SHARES = (("p50", 0.5), ("p99", 0.99))


def _call(users: Child, ways: list[str], count: int, service: str = SERVICE) -> Any:
    return users.ask({"do": "call", "ways": ways, "count": count, "period": PERIOD, "service": service})


def _times(answer: Any, arrivals: list[Arrival]) -> dict[str, list[float]]:
    """From each call's beginning to the door [s]; a client has one call under way, so they are in one order."""
    found = {}
    for way, starts in answer["began"].items():
        ends = _of(way, arrivals)
        if len(ends) != len(starts):
            raise RuntimeError(f"{len(ends)} of {len(starts)} calls by {way} came: {answer['errors'][-1:]}")
        found[way] = [end.at - start for start, end in zip(starts, ends, strict=True)]
    return found


def _of(way: str, arrivals: list[Arrival]) -> list[Arrival]:
    return [each for each in arrivals if (each.way, each.service) == (way, SERVICE)]


def _flooded(users: Child, pressing: Child, side: Robot) -> dict[str, float]:
    """STOP by each way in turn while all others are flooded; whoever floods has a process of its own, and is not waited for."""
    found: dict[str, float] = {}
    before, began = len(side.arrivals()), time.monotonic()
    for way in WAYS:
        others = [other for other in WAYS if other != way]
        users.ask({"do": "flood", "ways": others, "service": SERVICE})
        starts = _call(pressing, [way], STOPS, STOP)["began"][way]
        pressed = [each.at for each in side.arrivals() if each.service == PRESSED]
        users.ask({"do": "rest"})
        # STOP may come by two lines: the first of them counts
        took = [min((at for at in pressed if at >= start), default=math.inf) - start for start in starts]
        found[f"stop {way}"] = percentile(took, 0.99) * 1e3
    found["flood"] = (len(side.arrivals()) - before) / (time.monotonic() - began)
    return found


def _bring_down(side: Robot, names: list[str]) -> None:
    with RemoteRobot(side.serving.url) as manager:
        manager.wait()
        for name in names:
            manager.call("/gateways/bring_down", BringDownGatewayRequest(name=name), CommandResponse)
