"""Many robots at a time whose links are cut, driven by clients of every kind that go on holding the stick.

`python -m bench.support.many_cuts COUNT AT_ONCE` prints what became of them as a line of JSON; roslibpy leaves a thread behind.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import random
import re
import sys
import threading
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass
from typing import Any

from bench.support.child import Child
from bench.support.cuts import (
    CODE,
    CODES,
    COMMAND_LIFETIME,
    CONNECT_TIMEOUT,
    PERIOD,
    Driver,
    Line,
    judge,
    naive,
    ours,
)
from bench.support.station import serving
from bench.support.wire import Wire, wire
from bridge.msgs.geometry_msgs import Twist

__all__ = ["CLIENTS", "HOWS", "ManyCut", "many", "moved_again", "robots", "theirs"]

SPEED = 0.6
"""[m/s]"""
ROBOTS = 7
"""Of one process."""
DRIVE_TIME = (0.25, 0.5)
"""Until the link is cut [s]."""
STALL_TIME = (0.35, 1.1)
"""As long a frozen link stays frozen while the stick is held [s]."""
HELD_TIME = 0.5
"""As long the stick is held after that [s]."""
REST_TIME = 0.45
"""After which a robot that hears nothing stands [s]."""
READY = re.compile(r"^robotside: ready bridge=(\S+) .*robot=(\S+)")

HOWS = ("reset", "frozen", "deaf", "burst")
"""Ends of a link. reset: by RST. frozen: nothing passes any more, the driver gives up, and what waited comes late. deaf: the robot
hears nothing, and its own messages go on. burst: nothing passes for a moment, then all at once, and the stick is held all the time."""


@contextlib.asynccontextmanager
async def theirs(port: int) -> AsyncIterator[Callable[[Twist], Awaitable[None]]]:
    """By roslibpy, which stamps nothing."""
    from roslibpy import Message, Ros, Topic

    ros = Ros("127.0.0.1", port)
    await asyncio.to_thread(ros.run, CONNECT_TIMEOUT)
    topic = Topic(ros, "/cmd_vel", "geometry_msgs/Twist", queue_size=1)
    topic.advertise()

    async def send(twist: Twist) -> None:
        if ros.is_connected:
            topic.publish(Message({"linear": {"x": twist.linear.x}, "angular": {"z": twist.angular.z}}))

    try:
        yield send
    finally:
        await asyncio.to_thread(_hang_up, ros)


def _hang_up(ros: Any) -> None:
    from twisted.internet import reactor

    reactor.callFromThread(ros.factory.stopTrying)  # type: ignore[attr-defined]  # of the reactor's thread alone
    with contextlib.suppress(Exception):  # its own exceptions for a link that is broken already
        ros.close(1.0)


CLIENTS: Mapping[str, Driver] = {"ours": ours, "raw": naive, "roslibpy": theirs}
"""By name; ours stamps its commands, the others do not."""


@dataclass(frozen=True, slots=True)
class ManyCut:
    """What became of one link."""

    client: str
    how: str
    obeyed: bool
    """The robot moved before the link was cut; on a computer that has no time for it everything may come too late."""
    longest: float
    """As long after it was given a command was in force, or obeyed at all, at most [s]."""
    zero: float
    """From the last command that the robot obeyed to rest at its port [s]."""
    old: int
    """How often something moved it that was given after the cut."""

    again: int = 0
    """How often something moved it that had come to rest after the cut."""

    @property
    def late(self) -> bool:
        """It moved once more, by whatever was given before or after the cut."""
        return self.old > 0 or self.again > 0

    @property
    def slow(self) -> bool:
        """A command was in force for longer than it may, as on a computer that has no time for its robot."""
        return not self.longest <= COMMAND_LIFETIME


@contextmanager
def robots(count: int) -> Iterator[dict[str, tuple[int, list[Line]]]]:
    """So many robots that weigh nothing: the port of each on this machine, and the growing list of what its own port reports."""
    names = [f"r{number}" for number in range(count)]
    options = ("--robot", f"sim:{','.join(['patrol'] * count)}", "--name", ",".join(names))
    told: list[list[Line]] = [[] for _ in names]
    with serving("bench.support.bodies", *options) as serves:
        ports = {names[0]: int(serves.url.rsplit(":", 1)[1])}
        while len(ports) < count:
            if ready := READY.match(serves.child.line()):
                ports[ready[2]] = int(ready[1].rsplit(":", 1)[1])
        reader = threading.Thread(target=_listen, args=(serves.child, told), daemon=True)
        reader.start()
        yield {name: (ports[name], told[number]) for number, name in enumerate(names)}
    reader.join(5.0)


def _listen(process: Child, told: list[list[Line]]) -> None:
    for line in process.process.stdout or ():
        if line.startswith("["):
            number, *rest = json.loads(line)
            told[number].append(rest)


def many(count: int, clients: Mapping[str, Driver] = CLIENTS, at_once: int = ROBOTS) -> list[ManyCut]:
    """Cut about `count` links, as many of each kind of client, `at_once` of each at a time."""
    with ExitStack() as stack:
        served = {client: stack.enter_context(robots(at_once)) for client in clients}
        return asyncio.run(_all(served, clients, math.ceil(count / len(clients) / at_once)))


async def _all(
    served: Mapping[str, Mapping[str, tuple[int, list[Line]]]], clients: Mapping[str, Driver], each: int
) -> list[ManyCut]:
    async with asyncio.TaskGroup() as group:
        tasks = [
            group.create_task(_some(client, clients[client], name, *where, each))
            for client, its in served.items()
            for name, where in its.items()
        ]
    return [found for task in tasks for found in task.result()]


async def _some(
    client: str, driver: Driver, name: str, port: int, told: list[Line], count: int
) -> list[ManyCut]:
    rng = random.Random(f"cuts of {client} {name}")
    await asyncio.sleep(rng.random())
    first = rng.randrange(len(HOWS))
    found: list[ManyCut] = []
    for number in range(count):
        how, way = HOWS[(first + number) % len(HOWS)], 1.0 if number % 2 else -1.0
        with contextlib.suppress(OSError, TimeoutError):  # one that does not get in costs no other
            found.append(await one(client, driver, port, told, rng, how, way))
    return found


async def one(
    client: str, driver: Driver, port: int, told: list[Line], rng: random.Random, how: str, way: float
) -> ManyCut:
    """Drive a robot, cut its link so, and judge what its port was told."""
    first, given = len(told), dict[int, float]()
    async with wire(port) as link, driver(link.port) as send:
        await send(Twist())
        holding = asyncio.create_task(_hold(send, given, way))
        await asyncio.sleep(rng.uniform(*DRIVE_TIME))
        severed = await _sever(link, how)
        if how == "burst":
            await asyncio.sleep(rng.uniform(*STALL_TIME))
            link.thaw()
        await asyncio.sleep(HELD_TIME)
        holding.cancel()
        await asyncio.gather(holding, return_exceptions=True)
        await asyncio.sleep(REST_TIME)
        if how in ("frozen", "deaf"):
            link.thaw()  # what waited in the line comes now
            await asyncio.sleep(REST_TIME)
    found = judge(told[first:], given, hard=how == "reset", severed=severed)
    obeyed = any(line[0] == "drive" and line[2] for line in told[first:])
    again = moved_again(told[first:], severed)
    return ManyCut(client, how, obeyed, found.longest, found.zero, found.old, again)


def moved_again(told: Sequence[Line], severed: float) -> int:
    """How often the port was told to move after it was told to rest after the moment of the cut [s]."""
    rests, count = False, 0
    for line in told:
        if line[0] == "stop" or not line[2]:
            rests = rests or line[1] > severed
        else:
            count += rests
    return count


async def _hold(send: Callable[[Twist], Awaitable[None]], given: dict[int, float], way: float) -> None:
    """Hold the stick; each command differs from the others by its yaw rate."""
    began = time.monotonic()
    while True:
        code = len(given) + 1
        given[code] = time.monotonic()
        await send(Twist.planar(way * SPEED, code % CODES * CODE))
        await asyncio.sleep(max(0.0, began + code * PERIOD - time.monotonic()))


async def _sever(link: Wire, how: str) -> float:
    """Cut it; returns when it was [s]."""
    if how == "reset":
        await link.reset()
    else:
        link.freeze(upward_only=how == "deaf")
    return time.monotonic()


if __name__ == "__main__":
    print(json.dumps([asdict(each) for each in many(int(sys.argv[1]), at_once=int(sys.argv[2]))]), flush=True)
