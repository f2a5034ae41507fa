"""The camera by URL, 640 x 480 at 30 pictures a second: how old a picture is when a viewer has decoded it, and what one more viewer costs.

A camera in a process of its own paints the time into each picture before it compresses it; the robot side serves it, and a viewer
in a third process reads the time from the pixels that it decoded, with the clock that all processes of a machine share. There
is no lens, no screen and no radio in it; what a browser's player keeps back on its own is not either. A repeat is 8 s of each.

*One more viewer* is a ninth of what ten viewers of the same cost the robot side in CPU time more than one. The other way is a thread, an
encoder and a library's file writer for each viewer, with the options that are usual for little delay; its WebSocket has no acknowledgements.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

import psutil

from bench.support.child import child
from bench.support.figures import Figure, percentile
from bench.support.glass import SETTLING
from bench.support.harness import Context, Sides
from bench.support.station import serving

EACH = "a thread, an encoder and a file writer for each viewer"
KINDS = {"ws": "JPEG over WebSocket", "mjpeg": "MJPEG", "mp4": "MP4, H.264", "webm": "WebM, VP8"}
TARGETS = {"ws_p50": 8.0, "ws_p99": 90.0}

FIGURES = (
    *(
        Figure(
            f"{kind}_{name}",
            "ms",
            f"{what}, painted to decoded, {share}",
            TARGETS.get(f"{kind}_{name}"),
            against=EACH,
        )
        for kind, what in KINDS.items()
        for name, share in (("p50", "median"), ("p99", "99 of 100"))
    ),
    *(
        Figure(f"{kind}_more", "%", f"{what}, share of a core for one more viewer", 3.0, against=EACH)
        for kind, what in KINDS.items()
    ),
)
REPEATS = 2
WATCH_TIME = 8.0
"""[s]"""
VIEWERS = 10

Place = Callable[[str], str]
"""The URL of each kind."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(ours, peer)


def ours() -> Mapping[str, float]:
    """One sample of every figure, our robot side."""
    with serving("bench.support.filming") as robot:

        def place(kind: str) -> str:
            return (
                f"{robot.url.rstrip('/')}/camera/front"
                if kind == "ws"
                else f"{robot.site}/stream/front.{kind}"
            )

        return _measured(robot.child.process.pid, place, "ws")


def peer() -> Mapping[str, float]:
    """One sample of every figure, the other way."""
    with child("bench.support.naive_camera") as process:
        ports = process.receive()

        def place(kind: str) -> str:
            if kind == "plain":
                return f"ws://127.0.0.1:{ports['ws']}"
            return f"http://127.0.0.1:{ports['http']}/front.{kind}"

        return _measured(process.process.pid, place, "plain")


def _measured(pid: int, place: Place, socket: str) -> dict[str, float]:
    found = {}
    for kind in KINDS:
        shares = []
        for viewers in (1, VIEWERS):
            before = cpu(pid)
            ages = looked(socket if kind == "ws" else kind, place, viewers)
            shares.append((cpu(pid) - before) / (WATCH_TIME + SETTLING))
            if viewers == 1:
                found[f"{kind}_p50"] = percentile(ages, 0.5) * 1e3
                found[f"{kind}_p99"] = percentile(ages, 0.99) * 1e3
        found[f"{kind}_more"] = (shares[1] - shares[0]) / (VIEWERS - 1) * 100
    return found


def looked(kind: str, place: Place, viewers: int, seconds: float = WATCH_TIME) -> list[float]:
    """So many look; how old the pictures of the first one were [s]. RuntimeError when it saw none."""
    url = place(kind)
    with child("bench.support.glass", kind, url, str(seconds), str(viewers)) as process:
        ages: list[float] = process.receive()
    if not ages:
        raise RuntimeError(f"No picture came by {url}.")
    return ages


def cpu(pid: int) -> float:
    """CPU time of a process since its start [s]."""
    times = psutil.Process(pid).cpu_times()
    return float(times.user + times.system)
