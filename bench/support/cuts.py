"""A robot that is driven at full speed until its link is cut, and the commands at its port from then on."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import math
import random
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from dataclasses import dataclass
from typing import Any

from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from bench.support.kinds import Kind
from bench.support.wire import Wire, wire
from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.msgs.geometry_msgs import Twist

__all__ = ["COMMAND_LIFETIME", "Cut", "Driver", "cut", "judge", "naive", "ours"]

COMMAND_LIFETIME = 0.3
"""So long after a command was given nothing may be left of it [s]."""
PERIOD = 0.05
"""Between two commands [s]."""
CODE = 1e-3
"""By so much the yaw rates of two commands that follow each other differ, so that they can be distinguished [rad/s]."""
CODES = 500
BLIND_TIME = 0.4
"""Time for which the driver goes on after the cut without knowing [s]."""
WATCH_TIME = 0.6
"""Time for which the port is watched once the robot must stand, or the link has healed [s]."""
CONNECT_TIMEOUT = 10.0

Line = Sequence[Any]
"""One of a port: what, when [s], and its numbers."""
Driver = Callable[[int], contextlib.AbstractAsyncContextManager[Callable[[Twist], Awaitable[None]]]]
"""Connects to a port of this machine and gives what sends a twist."""


@dataclass(frozen=True, slots=True)
class Cut:
    """What became of one."""

    hard: bool
    """By RST; else nothing passed any more."""
    zero: float
    """From the last command that the robot obeyed to rest at its port [s]; infinite when the command to rest never came."""
    longest: float
    """As long after it was given a command was in force, or obeyed at all, at most [s]."""
    rest: float
    """From that to the robot's rest [s]; infinite when it goes on."""
    way: float
    """Driven meanwhile, as long as it was looked at [m]."""
    old: int = 0
    """How often something moved it that was given only after the cut."""

    @property
    def obeyed(self) -> bool:
        """It moved at all before the link was cut."""
        return self.longest > 0

    @property
    def missed(self) -> bool:
        """Something moved it too late."""
        return not self.longest <= COMMAND_LIFETIME


@contextlib.asynccontextmanager
async def ours(port: int) -> AsyncIterator[Callable[[Twist], Awaitable[None]]]:
    """By our own client, stamped."""
    connected = asyncio.Event()

    def note(state: LinkState) -> None:
        if state.phase is Phase.CONNECTED:
            connected.set()

    client = BridgeClient(f"ws://127.0.0.1:{port}", on_state=note, backoff=(0.05, 0.1))
    running = asyncio.create_task(client.run())
    client.advertise("/cmd_vel", Twist)
    try:
        async with asyncio.timeout(CONNECT_TIMEOUT):
            await connected.wait()

        async def send(twist: Twist) -> None:
            client.publish("/cmd_vel", twist, stamp=client.robot_time())

        yield send
    finally:
        await client.close()
        await running


@contextlib.asynccontextmanager
async def naive(port: int) -> AsyncIterator[Callable[[Twist], Awaitable[None]]]:
    """By a plain WebSocket client, as rosbridge's users write it."""
    async with connect(f"ws://127.0.0.1:{port}", compression=None, proxy=None, close_timeout=0.1) as ws:

        async def send(twist: Twist) -> None:
            msg = {"linear": {"x": twist.linear.x}, "angular": {"z": twist.angular.z}}
            with contextlib.suppress(ConnectionClosed):
                await ws.send(json.dumps({"op": "publish", "topic": "/cmd_vel", "msg": msg}))

        yield send


async def cut(port: int, told: list[Line], kind: Kind, driver: Driver, rng: random.Random, way: float) -> Cut:
    """Drive a robot whose port reports its commands at full speed, `way` 1 forward or −1 back, and cut the link: by RST or in silence."""
    hard = rng.random() < 0.5
    first = len(told)
    given: dict[int, float] = {}
    async with wire(port) as link, driver(link.port) as send:
        await send(Twist())  # the link before was cut with the stick pushed: this one is heard at zero first
        on_way = kind.speed / kind.acceleration + rng.uniform(0.2, 0.2 + 4 * PERIOD)
        await send(Twist())  # a stick is heard at zero before it drives
        cutting = asyncio.create_task(_sever(link, on_way, hard=hard))
        end = time.monotonic() + on_way + BLIND_TIME
        while time.monotonic() < end:
            code = len(given) + 1
            given[code] = time.monotonic()
            await send(Twist.planar(way * kind.speed, code % CODES * CODE))
            await asyncio.sleep(max(0.0, given[1] + code * PERIOD - time.monotonic()))
        severed = await cutting
        await asyncio.sleep(kind.speed / kind.braking + WATCH_TIME)
        if not hard:
            link.thaw()  # what waited in the line comes now
            await asyncio.sleep(WATCH_TIME)
    found = judge(told[first:], given, hard=hard, severed=severed, still=kind.rest)
    await _rest(port, driver)
    return found


async def _sever(link: Wire, after: float, *, hard: bool) -> float:
    """Cut it so long from now [s]; returns when it was [s]."""
    await asyncio.sleep(after)
    if hard:
        await link.reset()
    else:
        link.freeze()
    return time.monotonic()


async def _rest(port: int, driver: Driver) -> None:
    """Stop a robot that is no longer driven, as a person would who runs after it."""
    if driver is naive:
        async with driver(port) as send:
            await send(Twist())
            await asyncio.sleep(WATCH_TIME)


def judge(
    told: Sequence[Line],
    given: dict[int, float],
    *,
    hard: bool,
    severed: float = math.inf,
    still: float = 0.02,
) -> Cut:
    """What the port's lines say, with the moments that each command was `given` by its number and the link was `severed` [s].

    Slower than `still` it is at rest [m/s].
    """
    moves = [_moving(line) for line in told if line[0] in ("drive", "stop")]
    longest, last, zero = 0.0, math.nan, math.inf
    for (at, code), (until, _) in itertools.pairwise([*moves, (math.inf, 0)]):
        if code:
            last = given[code]
            longest = max(longest, at - last, until - last)
            zero = until - last
    speeds = [(line[1], line[2]) for line in told if line[0] == "speed" and line[1] >= last]
    resting = [at for at, speed in speeds if speed < still]
    driven = sum((after - before) * speed for (before, speed), (after, _) in itertools.pairwise(speeds))
    rest = min(resting, default=math.inf) - last - zero if zero < math.inf else math.inf
    old = sum(given[code] > severed for _, code in moves if code)
    return Cut(hard, zero, longest, rest, driven, old)


def _moving(line: Line) -> tuple[float, int]:
    """When, and the number of the command that moves it on; 0 for rest, also for one that turns on the spot."""
    if line[0] == "stop" or not line[2]:
        return line[1], 0
    return line[1], round(line[3] / CODE)
