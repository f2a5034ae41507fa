"""Time from the loss of an input to zero speed at the robot's port, for each way in which a finger or a gamepad can be lost.

The real app and the real robot side are processes of their own on loopback; the app shows the drive screen of a
moving robot with all instruments. The finger comes through Kivy's input loop as that of a touch screen does, the gamepad is
SDL's own virtual one, and each is lost at a random instant 0.1 to 0.4 s after the robot drove off, so many times each way. The
clock stops at the first command to rest at the robot's port that no other command follows. A robot that moves on after 1 s counts as 1 s.
A row is the worst of its way, with the drawing left out: every call to OpenGL swallowed, as where a GPU draws.

The other way is a stick whose events are forwarded as they come, with no check of its life: the same app without checks
of the input, without listening to the window, and without its heartbeat.
"""

from __future__ import annotations

import json
import math
import random
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from bench.support.child import Child
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.pair import PHONE, SETTLING, app
from bench.support.station import serving
from bench.support.ways import FINGER, PAD

NAIVE = "a stick with no life check"
LIMIT = 200
"""[ms]"""
KINDS = {"finger": FINGER, "pad": PAD}


def _figures() -> Iterator[Figure]:
    for kind, called in (("finger", "finger"), ("pad", "gamepad")):
        yield Figure(f"{kind}_p50", "ms", f"{called}, every way, median", against=NAIVE)
        yield Figure(f"{kind}_p99", "ms", f"{called}, every way, 99 of 100", LIMIT, against=NAIVE)
        yield Figure(f"drawn_{kind}_p99", "ms", f"the same, drawn on {PHONE} by software GL")
        for way, words in KINDS[kind].items():
            yield Figure(f"{kind}_{way}", "ms", f"{called}: {words}, worst", LIMIT, against=NAIVE)


FIGURES = tuple(_figures())
REPEATS = 1
LOSSES = 12
"""Of each way."""
NAIVELY = 2
"""The same for the other way: it either rests by itself or never does."""
DRAWN = 3
"""The same with the drawing."""
WATCH_TIME = 1.0
"""Time for which the port is watched after a loss [s]."""
AFTER = (0.1, 0.4)
"""The robot has driven for so long when the stick is lost [s]."""
DRIVE_OFF_TIMEOUT = 3.0
"""A robot that has not driven off after this is driven anew [s]."""
MAX_PUSHES = 20
"""Pushes at most."""
MIN_SPEED = 1e-6
"""[m/s], [rad/s]"""

Commands = list[tuple[float, bool]]
"""Commands at the robot's port: when [s], and whether it moves the robot."""


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """Nothing is kept."""
    yield Sides(ours, lambda: _named(lost(NAIVELY, "--no-gl", "--no-life")))


def ours() -> dict[str, float]:
    """Each way, without and with the drawing."""
    drawn = _named(lost(DRAWN))
    return _named(lost(LOSSES, "--no-gl")) | {f"drawn_{kind}_p99": drawn[f"{kind}_p99"] for kind in KINDS}


def _named(found: dict[str, dict[str, list[float]]]) -> dict[str, float]:
    figures = {}
    for kind, ways in found.items():
        every = [taken for each in ways.values() for taken in each]
        figures[f"{kind}_p50"] = percentile(every, 0.5) * 1e3
        figures[f"{kind}_p99"] = percentile(every, 0.99) * 1e3
        figures |= {f"{kind}_{way}": max(each) * 1e3 for way, each in ways.items()}
    return figures


def lost(count: int, *flags: str) -> dict[str, dict[str, list[float]]]:
    """Until zero at the port [s], by what pushed the stick and by the way in which it was lost `count` times."""
    told: Commands = []
    with serving("bench.support.port", "--robot", "sim:patrol", "--world", "parking_lot") as robot:
        reader = threading.Thread(target=_listen, args=(robot.child, told), daemon=True)
        reader.start()
        with app("--size", PHONE, *flags) as (handheld, _):
            trial = Trial(handheld, told)
            trial.ask("connect", url=robot.url)
            trial.ask("watch", seconds=SETTLING)
            found = {
                kind: {way: [trial.lose(kind, way) for _ in range(count)] for way in ways}
                for kind, ways in KINDS.items()
            }
    reader.join(5.0)
    return found


class Trial:
    """A handheld whose operator loses the stick, and the commands at the robot's port meanwhile."""

    def __init__(self, handheld: Child, told: Commands) -> None:
        self._handheld, self._told = handheld, told
        self._rng = random.Random(1)

    def ask(self, do: str, **fields: object) -> dict[str, Any]:
        """Have the app do something; RuntimeError when it could not."""
        answer: dict[str, Any] = self._handheld.ask({"do": do, **fields})
        if "fault" in answer:
            raise RuntimeError(f"{do}: {answer['fault']}")
        return answer

    def lose(self, kind: str, way: str) -> float:
        """Drive off, lose it, and restore it; returns for how long the robot was commanded to move on [s]."""
        self._drive_off(kind)
        time.sleep(self._rng.uniform(*AFTER))
        at = self.ask("lose", way=way)["at"]
        time.sleep(max(0.0, at + WATCH_TIME - time.monotonic()))
        taken = min(WATCH_TIME, rested(list(self._told), at))
        self.ask("let_go")
        return taken

    def _drive_off(self, kind: str) -> None:
        for _ in range(MAX_PUSHES):
            self.ask("push", kind=kind)
            if self._waited(lambda: bool(self._told) and self._told[-1][1]):
                return
            self.ask("let_go")
        raise RuntimeError("The robot does not drive off.")

    def _waited(self, condition: Callable[[], bool]) -> bool:
        end = time.monotonic() + DRIVE_OFF_TIMEOUT
        while not condition() and time.monotonic() < end:
            time.sleep(0.005)
        return condition()


def rested(told: Sequence[tuple[float, bool]], since: float) -> float:
    """From `since` to the first command to rest that no other follows [s], 0 for an earlier one; infinite when there is none."""
    last = max((index for index, (_, moves) in enumerate(told) if moves), default=-1)
    return max(0.0, told[last + 1][0] - since) if last + 1 < len(told) else math.inf


def _listen(robot: Child, told: Commands) -> None:
    for line in robot.process.stdout or ():
        if line.startswith(('["drive"', '["stop"')):
            what, at, *twist = json.loads(line)
            told.append((at, what == "drive" and any(abs(value) > MIN_SPEED for value in twist)))
