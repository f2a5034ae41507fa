"""Several stations served by one process and one loop: the tick that drives them, and the end of all of them.

They have one clock, so that robots in one simulated world move on together.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import math
from collections.abc import Awaitable, Callable, Coroutine, Sequence
from contextlib import AbstractAsyncContextManager, AsyncExitStack
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from robotside.core.clock import RobotClock
from robotside.serving.pacing import Pacing
from robotside.station.station import Station

__all__ = ["RunningServer", "FleetServer"]

log = logging.getLogger(__name__)

TICK_PERIOD = 1 / 60
"""Real time between two ticks [s]."""
WANTED_PERIOD = 1.0
"""Real time between two questions whether it is still wanted [s]."""
BRAKING_TIMEOUT = 2.0
"""How long the robots may take to come to rest at the end [s]."""
SHORTAGE_PERIOD = 60.0
"""That no connection can be taken is said at most this often [s]."""

_SHORT = (errno.EMFILE, errno.ENFILE, errno.ENOBUFS, errno.ENOMEM)
"""How the system says that it has no more of something."""


@dataclass(frozen=True, slots=True)
class RunningServer:
    """What runs while a station listens."""

    work: tuple[Callable[[], Coroutine[Any, Any, None]], ...]
    """To be run side by side."""
    leave: Callable[[], Awaitable[None]]
    """Has all of it come to its end."""


class _StationServer(Protocol):
    """As much of `robotside.serving.station_server.StationServer` as is needed here."""

    station: Station

    def listening(self) -> AbstractAsyncContextManager[RunningServer]:
        """Hold its ports for as long as this is open."""


S = TypeVar("S", bound=_StationServer)


class FleetServer(Generic[S]):
    """Serves some stations until told to end."""

    def __init__(
        self,
        servings: Sequence[S],
        clock: RobotClock,
        wall: Callable[[], float],
        *,
        wanted: Callable[[], bool] = lambda: True,
    ) -> None:
        """`wall` is real time [s]; `wanted` is asked once a second and ends the serving when it says no."""
        self._servings, self._clock, self._wall, self._wanted = servings, clock, wall, wanted
        self._pacing = Pacing(clock, wall)
        self._patience = math.inf

    async def run(self, ready: Callable[[S], None]) -> None:
        """Serve until `end`; `ready` is called for each once all of them listen. BridgeError when a port is taken."""
        loop = asyncio.get_running_loop()
        before = loop.get_exception_handler()
        loop.set_exception_handler(_Faults())
        try:
            async with AsyncExitStack() as ports:
                served = [await ports.enter_async_context(each.listening()) for each in self._servings]
                async with asyncio.TaskGroup() as group:
                    for work in (work for each in served for work in each.work):
                        group.create_task(work())
                    for each in self._servings:
                        ready(each)
                    await self._tick()
                    for one in served:
                        await one.leave()
        finally:
            loop.set_exception_handler(before)

    def end(self) -> None:
        """Have `run` come to its end: every robot brakes first. Told again it takes no longer."""
        if self._patience < math.inf:
            return
        for each in self._servings:
            each.station.end()
        self._patience = self._wall() + BRAKING_TIMEOUT

    async def _tick(self) -> None:
        """Drive the stations until told to end and all stand still and have said so."""
        loop = asyncio.get_running_loop()
        due = look = loop.time()
        while self._wall() < self._patience and not self._done():
            self._keep_up()
            for now in self._pacing.steps():
                for each in self._servings:
                    each.station.step(now)
                    await asyncio.sleep(0)
            if self._patience == math.inf and loop.time() >= look:
                look = loop.time() + WANTED_PERIOD
                if not self._wanted():
                    self.end()
            due = max(due + TICK_PERIOD, loop.time() - TICK_PERIOD)
            await asyncio.sleep(max(0.0, due - loop.time()))

    def _keep_up(self) -> None:
        """Give up what is too far behind, and have each robot know how its loop does."""
        lost = self._pacing.begin()
        timing = self._pacing.timing
        for each in self._servings:
            if lost:
                each.station.loop.skip(self._clock.now, lost)
            each.station.loop.update(timing.factor, timing.lag, self._wall())

    def _done(self) -> bool:
        return self._patience < math.inf and all(each.station.done for each in self._servings)


class _Faults:
    """What goes wrong in the loop itself, in the log: that connections cannot be taken, seldom; all else as ever."""

    def __init__(self) -> None:
        self._next = -math.inf

    def __call__(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """Log one of them."""
        fault = context.get("exception")
        # a listening socket tells a hundred times a second that there are no more file descriptors
        if "socket" not in context or not isinstance(fault, OSError) or fault.errno not in _SHORT:
            loop.default_exception_handler(context)
        elif loop.time() >= self._next:
            self._next = loop.time() + SHORTAGE_PERIOD
            log.error("No further connection can be taken at the moment: %s.", fault.strerror)
