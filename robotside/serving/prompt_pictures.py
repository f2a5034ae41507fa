"""Pictures that go to who looks as soon as they are there: at the next tick they would be 8 ms older, as a rule."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import Callable, Iterator

from robotside.station.station import Station

__all__ = ["MIN_PERIOD", "prompt_pictures"]

MIN_PERIOD = 1 / 120
"""Pictures that follow each other faster wait for the tick [s]."""


@contextlib.contextmanager
def prompt_pictures(station: Station, now: Callable[[], float]) -> Iterator[None]:
    """While this is open, `station` takes in pictures when its robot says that there are some; `now` is the robot's clock [s].

    The robot may say so in any thread; they are taken in by the running loop.
    """
    loop = asyncio.get_running_loop()
    due = loop.time()
    asked = False

    def take() -> None:
        nonlocal asked, due
        asked = False
        if loop.time() >= due:
            due = loop.time() + MIN_PERIOD
            station.take_in(station.robot.pictures(now()))

    def ready() -> None:
        nonlocal asked
        if not asked:
            asked = True
            with contextlib.suppress(RuntimeError):  # the loop has just ended
                loop.call_soon_threadsafe(take)

    station.robot.on_pictures(ready)
    try:
        yield
    finally:
        station.robot.on_pictures(None)
