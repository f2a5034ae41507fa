"""Time of STOP from the tap on the screen until the button shows STOPPED: the robot has reported that it is latched and at rest.

The app and the robot side are processes of their own on loopback; taps are put into SDL's queue at odd moments while camera,
laser and all instruments of the drive screen run, the robot stands, and each STOP is released again. *Saturated* is a TCP
proxy of 2 Mbit/s in each direction that keeps 8 kB at most, and on the same connection the app is offered samples of 0.9 kB ten
times as fast as they fit. A STOP that is not confirmed within 5 s counts as infinite.

The other way is a plain client that calls STOP on a server which sends by `websockets.broadcast`, with the same samples over
the same proxy, timed from the call to the answer, without a screen.

The rows with the drawing left out have every call to OpenGL swallowed: without a GPU the software GL computes each pixel
on the cores that everything else needs too.
"""

from __future__ import annotations

import asyncio
import math
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from bench.bridge_trouble import LINK, TIMES, stops
from bench.support.child import child
from bench.support.figures import Figure, percentile
from bench.support.flooding import TRUTH
from bench.support.harness import Context, Sides
from bench.support.pair import PHONE, SETTLING, app
from bench.support.station import serving
from bench.support.traffic import MESSAGES, ODOM
from bench.support.wire import wired
from bridge.codec import to_json

BROADCAST = "websockets.broadcast"
FIGURES = (
    Figure("idle_p50", "ms", "tap to STOPPED, median, 892 x 412", against=BROADCAST),
    Figure("idle_p99", "ms", "the same, 99 of 100", against=BROADCAST),
    Figure("busy_p50", "ms", "with the link saturated, median", against=BROADCAST),
    Figure("busy_p99", "ms", "the same, 99 of 100", against=BROADCAST),
    Figure("gpu_idle_p50", "ms", "drawing left out, median"),
    Figure("gpu_idle_p99", "ms", "the same, 99 of 100", 60),
    Figure("gpu_busy_p50", "ms", "drawing left out, with the link saturated, median"),
    Figure("gpu_busy_p99", "ms", "the same, 99 of 100", 120),
    Figure("drawing", "×", "tap to STOPPED with the drawing over without it, 99 of 100", 1.5),
)
REPEATS = 1
TAPS = 150


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(lambda: ours(TAPS), theirs)


def ours(taps: int) -> dict[str, float]:
    """Four times so many taps."""
    found: dict[str, float] = {}
    for prefix, flags in (("", ()), ("gpu_", ("--no-gl",))):
        for name, rate in (("idle", math.inf), ("busy", LINK)):
            found |= _named(f"{prefix}{name}", tapped(taps, rate, *flags))
    return found | {"drawing": found["idle_p99"] / found["gpu_idle_p99"]}


def tapped(count: int, rate: float, *flags: str) -> list[float]:
    """How long each STOP took over a link of `rate` [byte/s], which is saturated unless that is infinite [s]."""
    with ExitStack() as stack:
        robot = stack.enter_context(serving("bench.support.flooding"))
        url = robot.url
        if rate < math.inf:
            url = f"ws://127.0.0.1:{stack.enter_context(wired(int(url.rsplit(':', 1)[1]), rate))}"
        handheld, _ = stack.enter_context(app("--size", PHONE, *flags))
        steps: list[dict[str, object]] = [{"do": "connect", "url": url}]
        steps += [{"do": "flood", "topic": TRUTH}] if rate < math.inf else []
        for step in (*steps, {"do": "watch", "seconds": SETTLING}):
            handheld.ask(step)
        answer = handheld.ask({"do": "stop", "count": count, "seed": 1})
        if "fault" in answer:
            raise RuntimeError(answer["fault"])
    return [math.inf if seconds is None else seconds for seconds in answer["taken"]]


def theirs() -> dict[str, float]:
    """A plain client on a plain server."""
    with child("bench.support.rosbridge", "naive") as server:
        port = server.receive()["port"]
        idle = asyncio.run(stops(port, ()))
        server.ask({"do": "flow", "rates": {ODOM: LINK * TIMES / len(to_json(MESSAGES[ODOM]))}})
        busy = asyncio.run(stops(port, (ODOM,)))
    return _named("idle", idle) | _named("busy", busy)


def _named(name: str, taken: list[float]) -> dict[str, float]:
    return {f"{name}_p50": percentile(taken, 0.5) * 1e3, f"{name}_p99": percentile(taken, 0.99) * 1e3}
