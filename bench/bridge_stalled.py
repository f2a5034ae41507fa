"""One client of three stops reading a camera of 30 pictures a second and 60 kB each (base64 in JSON) for a minute.

Every 20 s it breaks off and comes back to do the same. The other two go on reading; their rate is the lower one of a
second before and after the stall began. The server's memory is its resident set before the stall and its greatest one during it.
The other way is a server that sends by `websockets.broadcast`, for 10 s; its growth is given for a minute.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

import psutil

from bench.support.child import Child, child
from bench.support.figures import Figure, Stated
from bench.support.harness import Context, Sides
from bench.support.traffic import CAMERA, MESSAGES, RATES

BROADCAST = "websockets.broadcast"
ROSBRIDGE = "rosbridge_server 0.11.17"
FIGURES = (
    Figure("before", "1/s", "pictures that each of the others gets before", better="more", against=BROADCAST),
    Figure(
        "others",
        "1/s",
        "pictures that each of the others gets meanwhile",
        29.0,
        better="more",
        against=BROADCAST,
        stated=Stated(ROSBRIDGE, 0),
    ),
    Figure("growth", "MB/min", "the server's memory grows", 5.0, against=BROADCAST),
)
REPEATS = 1

OTHERS = 2
BEFORE = 6.0
"""The others watch alone for so long [s]; the memory that this takes is not counted."""
OURS, THEIRS = 60.0, 10.0
"""How long the stall is watched [s]."""
STALL_PERIOD = 20.0
"""[s]"""
MEMORY_PERIOD = 1.0
"""Between two looks at the memory [s]."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(lambda: stalled("ours", OURS), lambda: stalled("naive", THEIRS))


def stalled(kind: str, seconds: float) -> dict[str, float]:
    """What one stalled client costs."""
    asked = {"topic": CAMERA, "type": MESSAGES[CAMERA].MSGTYPE}
    with child("bench.support.rosbridge", kind) as server:
        url = f"ws://127.0.0.1:{server.receive()['port']}"
        memory = psutil.Process(server.process.pid)
        with child("bench.support.crowd", url) as crowd:
            crowd.receive()
            crowd.ask({"do": "watch", "clients": OTHERS, **asked})
            server.ask({"do": "flow", "rates": {CAMERA: RATES[CAMERA]}})
            time.sleep(BEFORE / 2)
            before, _ = rate(crowd, memory, BEFORE / 2)
            base = memory.memory_info().rss
            crowd.ask({"do": "stall", "again": STALL_PERIOD, **asked})
            meanwhile, most = rate(crowd, memory, seconds)
    return {"before": before, "others": meanwhile, "growth": max(0, most - base) / 1e6 * 60 / seconds}


def rate(crowd: Child, memory: psutil.Process, seconds: float) -> tuple[float, int]:
    """Pictures a second that each of the others gets, and the most memory that the server takes [byte]."""
    began, had, most = time.monotonic(), crowd.ask({"do": "received"})["received"], 0
    while time.monotonic() < began + seconds:
        time.sleep(MEMORY_PERIOD)
        most = max(most, memory.memory_info().rss)
    came = crowd.ask({"do": "received"})["received"] - had
    return came / OTHERS / (time.monotonic() - began), most
