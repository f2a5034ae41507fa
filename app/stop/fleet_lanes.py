"""Lanes of STOP ALL: one for each robot that no link of its own stops, in a network thread that they have to themselves.

Fifty of them delay nobody's commands. `FleetLanes` is called from the UI thread.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from app.stop.same_robot import Row
from bridge.client.credentials import Credentials
from bridge.core.network_thread import NetworkThread

if TYPE_CHECKING:
    from app.stop.stop_lane import Report  # when STOP ALL is pressed, for a quick start

__all__ = ["FleetLanes", "Lane", "Meant", "stop_lane"]

PACE = 0.002
"""Between the beginnings of two lanes [s]."""
ENDS = 1.0
"""All lanes have closed their sockets within this [s]."""


class Lane(Protocol):
    """What is needed of `StopLane`."""

    @property
    def report(self) -> Report:
        """What is known now."""

    def press(self) -> None:
        """STOP was pressed."""

    async def run(self) -> None:
        """Until cancelled."""


@dataclass(slots=True)
class Meant:
    """One address that STOP ALL was meant for."""

    url: str
    name: str
    heard: str
    """When it was last heard, as a sentence; empty for one that is there."""
    boot: str = ""
    """As of `Connected`; a claim of its HELLO until its link said it."""
    boot_by_link: str = ""
    """What its own link said it is; empty until then."""
    proven_by_link: str = ""
    """Fingerprint of the certificate that its own link saw last; empty for none."""
    credentials: Credentials | None = None
    """Of a robot that is paired: nobody else counts as it."""
    lane: Lane | None = None
    """None while its own link stops it, and before the network thread has made it."""
    task: asyncio.Task[None] | None = None
    met: bool = False
    """A robot was met at that address, by us or on an earlier day; else STOP goes there, and nothing is counted."""
    last: Row | None = None
    """What was known while its own link stopped it."""
    begun: bool = False
    """Its own link has begun to stop it."""
    over: bool = False
    """Its lane is not wanted any more."""
    left: object | None = None
    """The link over which it was left before it confirmed a STOP of its own; None where STOP ALL was meant for it."""


def stop_lane(*args: Any, **kwargs: Any) -> Lane:
    """A lane of the usual kind."""
    from app.stop.stop_lane import StopLane

    return StopLane(*args, **kwargs)


class FleetLanes:
    """Who runs them, and ends them all."""

    def __init__(self, open_lane: Callable[..., Lane]) -> None:
        """`open_lane(url)` makes the lane to an address, `credentials` by name for a robot that is paired."""
        self._open_lane = open_lane
        self._network: NetworkThread | None = None
        """Made with the first lane."""
        self._ending: set[asyncio.Task[None]] = set()
        """Lanes that close their sockets; of the network thread."""

    def press(self, robots: list[Meant], head_start: float = 0.0) -> None:
        """STOP to all of `robots`, over a new lane each where there is none, `head_start` [s] from now."""
        if robots and self._network is None:
            self._network = NetworkThread("STOP ALL")
        for robot in robots:
            robot.over = False
        if self._network is not None:
            self._network.start(self._press_each(robots, head_start))

    def close_lane(self, robot: Meant) -> None:
        """Send nothing more to one of them."""
        robot.over = True
        if self._network is not None:
            self._network.call(self._end, robot)

    def close(self) -> None:
        """End the network thread, with all lanes that were closed before; it waits for their goodbyes."""
        if self._network is not None:
            with suppress(TimeoutError, concurrent.futures.TimeoutError):
                self._network.start(self._all_ended()).result(ENDS)
            self._network.close()
            self._network = None

    # in the network thread

    async def _press_each(self, robots: list[Meant], head_start: float) -> None:
        """Not all in one go, which would keep the other threads waiting."""
        await asyncio.sleep(head_start)
        for robot in robots:
            if robot.over:
                continue
            if robot.lane is not None:
                robot.lane.press()
                continue
            pinned = {} if robot.credentials is None else {"credentials": robot.credentials}
            robot.lane = self._open_lane(robot.url, **pinned)
            robot.task = asyncio.get_running_loop().create_task(robot.lane.run())
            await asyncio.sleep(PACE)

    def _end(self, robot: Meant) -> None:
        if robot.task is not None:
            self._ending.add(robot.task)
            robot.task.add_done_callback(self._ending.discard)
            robot.task.cancel()
        robot.lane = robot.task = None

    async def _all_ended(self) -> None:
        """Every lane has said goodbye."""
        if self._ending:
            await asyncio.wait(set(self._ending))
