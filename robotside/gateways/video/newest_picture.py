"""The newest picture of a camera, for one who looks at it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import NamedTuple

from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage

__all__ = ["MAX_AGE", "PICTURE_TIMEOUT", "NewestPicture", "Pace", "Picture"]

PICTURE_TIMEOUT = 10.0
"""A stream ends when no picture comes for this long [s]."""

MAX_AGE = 10.0
"""A picture that claims to be older than this when it comes was stamped by another clock, or not at all [s]."""


class Picture(NamedTuple):
    """A picture and when it was taken."""

    data: bytes
    """A JPEG file, of a foreign robot perhaps PNG."""
    taken: float
    """By the loop's clock [s]; when it came, where its stamp says nothing."""


class NewestPicture:
    """Keeps the newest picture until it is fetched; one that nobody fetched is left out."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is the clock of the pictures' stamps [s]."""
        self._now = now
        self._newest: Picture | None = None
        self._came = asyncio.Event()

    def on_picture(self, _: str, msg: Msg) -> None:
        """A picture was taken."""
        if isinstance(msg, CompressedImage):
            age = self._now() - msg.header.stamp.seconds
            taken = asyncio.get_running_loop().time() - (age if 0.0 <= age <= MAX_AGE else 0.0)
            self._newest = Picture(msg.data, taken)
            self._came.set()

    async def next(self) -> Picture:
        """The newest picture that was not given yet."""
        while self._newest is None:
            self._came.clear()
            await self._came.wait()
        picture, self._newest = self._newest, None
        return picture

    async def soon(self) -> Picture:
        """As `next`; TimeoutError when none comes within `PICTURE_TIMEOUT`."""
        async with asyncio.timeout(PICTURE_TIMEOUT):
            return await self.next()


class Pace:
    """Waits so that there are at most so many pictures a second."""

    def __init__(self, rate: float) -> None:
        """`rate` is in [Hz], infinity for no limit."""
        self._period = 1.0 / rate
        self._due = asyncio.get_running_loop().time()

    async def wait(self) -> None:
        """Until the next picture may be fetched."""
        clock = asyncio.get_running_loop().time
        await asyncio.sleep(self._due - clock())
        self._due = max(self._due, clock() - self._period) + self._period
