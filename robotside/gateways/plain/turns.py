"""Turns of ordinary requests: a few begin in each step of the loop, so that STOP, which takes none, waits for a few at most.

A STOP comes through several steps of the loop, those of its connection, its library and its broker. Each of them is as long as
all that is done in it: with a flood of requests begun as they come, some ten of which may take a millisecond each, a STOP of
ten steps takes a tenth of a second more.
"""

from __future__ import annotations

import asyncio
from collections import OrderedDict, deque
from collections.abc import Hashable

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.core.notice import Notice

__all__ = ["EACH_STEP", "MAX_WAITING", "Turns"]

EACH_STEP = 1
"""Requests that begin in one step of the loop."""
MAX_WAITING = 256
"""Requests that wait for their turn at a time; more are refused."""

_Line = deque[asyncio.Future[None]]


class Turns:
    """Who may begin next, for all protocols of one robot; belongs to one loop.

    Those who wait have their turn one source after another, so that the flood of one does not hold up the others.
    """

    def __init__(self) -> None:
        self._lines: OrderedDict[Hashable, _Line] = OrderedDict()
        """Who waits, by source; the first is next."""
        self._waiting = 0
        self._left = EACH_STEP
        """How many may still begin in this step."""
        self._called = 0
        """How many begin in the next step."""
        self._steps = False
        """Whether the next step is looked at."""

    async def take(self, source: Hashable) -> None:
        """Wait until a request of `source` may begin; at once while nobody else begins. Refused when `MAX_WAITING` wait."""
        self._watch()
        if self._left > 0 and not self._waiting and not self._called:
            self._left -= 1
            return
        if self._waiting >= MAX_WAITING:
            said = f"{MAX_WAITING} requests wait for their turn already; ask again in a moment."
            raise Refused(Notice(Code.GATEWAY_BUSY, said, max=MAX_WAITING))
        turn: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._lines.setdefault(source, deque()).append(turn)
        self._waiting += 1
        await turn

    def _watch(self) -> None:
        if not self._steps:
            self._steps = True
            asyncio.get_running_loop().call_soon(self._step)

    def _step(self) -> None:
        """A step of the loop: those who were called in the last one begin now, and the next are called."""
        self._steps = False
        self._left, self._called = EACH_STEP - self._called, 0
        while self._waiting and self._called < EACH_STEP:
            source, line = self._lines.popitem(last=False)
            turn = line.popleft()
            self._waiting -= 1
            if line:
                self._lines[source] = line  # behind all others
            if not turn.done():  # who waited may have given up
                turn.set_result(None)
                self._called += 1
        if self._called or self._left < EACH_STEP:
            self._watch()
