"""A line to a broker that comes back by itself, ever less often while the broker is not to be had."""

from __future__ import annotations

import asyncio
import logging
import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Coroutine
from typing import Any

from bridge.core.async_tasks import cancel_all, is_cancelled_from_outside

__all__ = ["Line"]

log = logging.getLogger(__name__)

MIN_BACKOFF, MAX_BACKOFF = 0.25, 5.0
"""Between two tries to connect [s]; it doubles from one to the next."""
STANDING_TIME = 10.0
"""A connection that was up for so long [s] is tried again soon when it is lost, and counts as reached again."""
STALL_PERIOD, STALL_TIMEOUT = 0.25, 1.0
"""The loop is looked at so often [s]; when it stood still for longer than that [s], what waited meanwhile is too old."""


class Line(ABC):
    """Connects, and does it again whenever that ends."""

    faults: tuple[type[Exception], ...] = ()
    """What a connection ends with when nothing is wrong with the program."""

    def __init__(self, *, on_down: Callable[[str], None] | None = None, drops_stale: bool = True) -> None:
        """`on_down(reason)` is called whenever the line is lost, or not to be had.

        With `drops_stale` a line whose program stood still connects anew instead of hearing what waited.
        """
        self._on_down, self._drops_stale = on_down, drops_stale
        self._beat = math.inf
        self._up_since = math.inf
        self._fault = ""

    @property
    def is_up(self) -> bool:
        """It is connected and hears what it is there for."""
        return self._up_since < math.inf

    @property
    def is_standing(self) -> bool:
        """It has been up for `STANDING_TIME`, so that it counts as steady."""
        return self.is_up and asyncio.get_running_loop().time() - self._up_since >= STANDING_TIME

    @property
    def fault(self) -> str:
        """Why it is not up, as part of a sentence; empty while it is, or before the first try has failed."""
        return self._fault

    async def run(self) -> None:
        """Keep the line up until cancelled."""
        backoff = MIN_BACKOFF
        while True:
            try:
                await self._connect()
                reason = "the robot's own program stood still for a while"
            except asyncio.CancelledError:
                if is_cancelled_from_outside():
                    raise
                reason = "its connection was cut"  # the library passes on what was cancelled within it
            except Exception as error:  # whatever it is, the robot goes on and the broker is tried again
                if not isinstance(error, self.faults):
                    log.exception("The connection to the broker failed")
                reason = self._reason(error)
            finally:
                # one that is lost soon after it was made each time is tried as seldom as one that is not to be had
                backoff = MIN_BACKOFF if self.is_standing else min(2 * backoff, MAX_BACKOFF)
                self._up_since = self._beat = math.inf
                self._forget()
            self._fault = reason
            if self._on_down is not None:
                self._on_down(reason)
            await asyncio.sleep(backoff)

    @abstractmethod
    async def _connect(self) -> None:
        """One connection from its beginning to its end; returns when what waits is too old to be heard."""

    @abstractmethod
    def _reason(self, error: Exception) -> str:
        """Why there is no connection, as part of a sentence."""

    @abstractmethod
    def _forget(self) -> None:
        """The connection is gone."""

    def _came_up(self) -> None:
        """To be called by `_connect` when all that is wanted can be heard."""
        self._up_since = asyncio.get_running_loop().time()
        self._fault = ""

    async def _until_one_ends(self, *works: Coroutine[Any, Any, None]) -> None:
        """Do these side by side until one of them ends, and end the others; raises what that one raised."""
        ends = [asyncio.create_task(work) for work in works]
        try:
            done, _ = await asyncio.wait(ends, return_when=asyncio.FIRST_COMPLETED)
        finally:
            await cancel_all(ends)
        for ended in done:
            ended.result()

    def _look_alive(self) -> None:
        """To be called by `_connect` when it begins to listen: from now on it counts how long the program stands still."""
        self._beat = asyncio.get_running_loop().time()

    async def _watch_loop(self) -> None:
        """Return when this process stood still, so that what came meanwhile is too old."""
        while not self._is_stale():
            self._beat = asyncio.get_running_loop().time()
            await asyncio.sleep(STALL_PERIOD)

    def _is_stale(self) -> bool:
        late = asyncio.get_running_loop().time() - self._beat > STALL_PERIOD + STALL_TIMEOUT
        return late and self._drops_stale
