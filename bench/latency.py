"""Latency from the finger to the robot's port, with everything running: camera, laser, all instruments of the drive screen.

The app draws off screen by software GL; events are put into SDL's queue at random moments, as the window system does, and
the clock stops when the twist that the stick made of it is at the port of the simulated robot, behind its own process,
socket and arbitration. Both stamps are of the machine's monotonic clock. A repeat moves the finger 150 times;
a move whose twist never arrives counts as infinitely late. The other way has the frame loop send the stick's position 20
times a second, on Kivy's default clock and with Kivy's own polling.

The rows with the drawing left out have every call to OpenGL swallowed: without a GPU the software GL computes each pixel
on the cores that everything else needs too, and the UI thread waits for it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.pair import PHONE, SETTLING, pair

NAIVE = "sent by the frame loop"
FIGURES = (
    Figure("p50", "ms", "finger to robot, median, 892 x 412", against=NAIVE, share=0.25),
    Figure("p99", "ms", "finger to robot, 99 of 100, 892 x 412", against=NAIVE, share=0.35),
    Figure("gpu_p50", "ms", "finger to robot, median, drawing left out", target=12, against=NAIVE),
    Figure("gpu_p99", "ms", "finger to robot, 99 of 100, drawing left out", target=40, against=NAIVE),
    Figure("touch_p50", "ms", "of it: finger to the stick's command, 892 x 412", against=NAIVE),
)
REPEATS = 2
MOVES = 150

PLACE_TOLERANCE = 1.5
"""Greatest distance of Kivy's place of a finger from the window system's [px]."""

Rows = Sequence[Sequence[float]]
Sample = tuple[float, Sequence[float]]
"""When [s], and the numbers by which it is known."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Each repeat has another finger's random moments."""
    seeds = iter(range(1000))

    def both(*flags: str) -> dict[str, float]:
        drawn = once(next(seeds), "--size", PHONE, *flags)
        left_out = once(next(seeds), "--size", PHONE, "--no-gl", *flags)
        return drawn | {"gpu_p50": left_out["p50"], "gpu_p99": left_out["p99"]}

    yield Sides(both, lambda: both("--frame-loop"))


def once(seed: int, *flags: str) -> dict[str, float]:
    """One app, one robot, `MOVES` moves."""
    with pair(*flags) as both:
        both.ask("connect", url=both.url)
        both.ask("watch", seconds=SETTLING)
        moves = both.ask("finger", count=MOVES, seed=seed)
        port = [line[1:] for line in both.told if line[0] == "drive"]
    touch, whole = delays(moves["moved"], moves["commands"], port)
    return {
        "p50": percentile(whole, 0.5) * 1e3,
        "p99": percentile(whole, 0.99) * 1e3,
        "touch_p50": percentile(touch, 0.5) * 1e3,
    }


def delays(moved: Rows, commands: Rows, port: Rows) -> tuple[list[float], list[float]]:
    """For each move, how long it took to the stick's command and to the robot's port [s]; infinite when it never came.

    `moved` has rows of when, x, y; `commands` of when, x, y and the twist's two numbers; `port` of when and the twist.
    What was overtaken, by a newer move in the same frame or a newer twist in the app, came with what overtook it.
    """
    touch = followed(
        [(at, place) for at, *place in moved], [(at, [x, y]) for at, x, y, *_ in commands], PLACE_TOLERANCE
    )
    sent = followed([(at, twist) for at, _, _, *twist in commands], [(at, twist) for at, *twist in port], 0.0)
    arrivals = {at: arrived for (at, *_), arrived in zip(commands, sent, strict=True)}
    whole = [arrivals.get(came, math.inf) for came in touch]
    starts = [at for at, *_ in moved]
    return [b - a for a, b in zip(starts, touch, strict=True)], [
        b - a for a, b in zip(starts, whole, strict=True)
    ]


def followed(causes: Sequence[Sample], effects: Sequence[Sample], slack: float) -> list[float]:
    """When each cause had its effect [s]: the first one after it with the same numbers within `slack`, or a later cause's."""
    found = []
    for at, numbers in causes:
        fits = (when for when, what in effects if when >= at and _near(what, numbers, slack))
        found.append(next(fits, math.inf))
    for index in reversed(range(len(found) - 1)):
        found[index] = min(found[index], found[index + 1])
    return found


def _near(one: Sequence[float], other: Sequence[float], slack: float) -> bool:
    return all(abs(a - b) <= slack for a, b in zip(one, other, strict=True))
