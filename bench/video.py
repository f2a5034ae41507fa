"""Latency from the simulator's drawing to the picture on the app's texture: 640 x 480, 15 pictures a second, everything running.

The clock starts before the simulation begins the step that draws and stops when the pixels have been handed to the
texture of the drive screen; both stamps are of the machine's monotonic clock. A repeat lasts 15 s. The other way
takes the same pictures from the topic `/camera/image/compressed`, as base64 in JSON.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.pair import PHONE, SETTLING, pair

JSON = "base64 in JSON"
FIGURES = (
    Figure("p50", "ms", "drawn to shown, median", against=JSON),
    Figure("p95", "ms", "drawn to shown, 95 of 100", target=80, against=JSON),
    Figure("rate", "1/s", "pictures shown", better="more", against=JSON),
    Figure("lost", "%", "pictures drawn and never shown", against=JSON),
)
REPEATS = 2
WATCH_TIME = 15.0
"""[s]"""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(lambda: once("--size", PHONE), lambda: once("--size", PHONE, "--json-camera"))


def once(*flags: str) -> dict[str, float]:
    """One app, one robot, looking on."""
    with pair(*flags) as both:
        both.ask("connect", url=both.url)
        both.ask("watch", seconds=SETTLING)
        shown = both.ask("watch", seconds=WATCH_TIME)["pictures"]
        drawn = [line[1:] for line in both.told if line[0] == "picture"]
    taken, missing = ages(drawn, shown)
    return {
        "p50": percentile(taken, 0.5) * 1e3,
        "p95": percentile(taken, 0.95) * 1e3,
        "rate": len(shown) / WATCH_TIME,
        "lost": missing * 100,
    }


def ages(drawn: Sequence[Sequence[float]], shown: Sequence[Sequence[float]]) -> tuple[list[float], float]:
    """How old each picture was when it was shown [s], and which share of those drawn meanwhile was never shown.

    Both lists hold a time [s] and the picture's stamp. RuntimeError when a picture was shown that was never drawn.
    """
    begun = {round(stamp, 4): at for at, stamp in drawn}
    stamps = [round(stamp, 4) for _, stamp in shown]
    if not stamps or not begun.keys() >= set(stamps):
        raise RuntimeError("The pictures on the screen are not those that were drawn.")
    meanwhile = [stamp for stamp in begun if min(stamps) <= stamp <= max(stamps)]
    missing = 1 - len(set(stamps)) / len(meanwhile) if meanwhile else math.nan
    return [at - begun[stamp] for (at, _), stamp in zip(shown, stamps, strict=True)], missing
