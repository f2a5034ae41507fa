"""The real app off screen and the real robot side, each in a process of its own, on loopback."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import psutil

from bench.support.child import Child, child
from bench.support.station import serving

__all__ = ["PHONE", "Pair", "app", "pair"]

PHONE = "892x412"
"""Size of a phone's glass [px]."""
SETTLING = 2.0
"""After everything is live [s]: first pictures, fonts and shaders are behind it."""


class Pair:
    """A handheld that shows the drive screen of a robot."""

    def __init__(self, url: str, told: list[list[Any]], app: Child, started: dict[str, float]) -> None:
        self.url = url
        """Where the robot serves."""
        self.told = told
        """Reports of the probe at the robot's port so far; grows."""
        self.started = started
        """`first_frame` [s] and `rss` [byte] of the app."""
        self._app = app

    @property
    def process(self) -> psutil.Process:
        """The app's."""
        return psutil.Process(self._app.process.pid)

    def ask(self, do: str, **fields: object) -> dict[str, Any]:
        """Have the app do something; RuntimeError when it could not."""
        answer: dict[str, Any] = self._app.ask({"do": do, **fields})
        if "fault" in answer:
            raise RuntimeError(f"{do}: {answer['fault']}")
        return answer


@contextmanager
def app(*flags: str) -> Iterator[tuple[Child, dict[str, float]]]:
    """The app alone, and what it says of its first frame; `flags` as of `bench.support.handheld`."""
    with child("bench.support.handheld", "--started", str(time.monotonic()), *flags) as process:
        yield process, process.receive()


@contextmanager
def pair(*flags: str) -> Iterator[Pair]:
    """Both, not connected yet."""
    told: list[list[Any]] = []
    with serving("bench.support.probe") as robot:
        reader = threading.Thread(target=_listen, args=(robot.child, told), daemon=True)
        reader.start()
        with app(*flags) as (process, started):
            yield Pair(robot.url, told, process, started)
    reader.join(5.0)


def _listen(robot: Child, told: list[list[Any]]) -> None:
    lines = robot.process.stdout or ()
    told.extend(json.loads(line) for line in lines if line.startswith("["))
