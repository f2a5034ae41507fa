"""One client's observation of one topic, as RFC 7641 has it: the newest message as often as asked for, until the client is gone."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable

from bridge.core.async_tasks import wait
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from robotside.door.station_door import StationDoor

__all__ = ["CONFIRM_PERIOD", "MIN_PERIOD", "Observation"]

CONFIRM_PERIOD = 5.0
"""A notification at least so often [s] wants to be acknowledged, and the first one: nothing more is sent before it is."""
MIN_PERIOD = 0.02
"""Shortest time between two notifications [s]."""


class Observation:
    """The newest message of a topic that was not sent yet, and when it may be sent. Belongs to one task."""

    def __init__(
        self, door: StationDoor, operator: Operator, topic: Topic, period: float, clock: Callable[[], float]
    ) -> None:
        """Two notifications are at least `period` apart [s]; `clock` only goes forward [s]. Raises Refused."""
        self._topic, self._period, self._clock = topic, max(period, MIN_PERIOD), clock
        self._newest: Msg | None = None
        self._wake = asyncio.Event()
        self._due = self._confirm = -math.inf
        self._end = door.subscribe(operator, topic.name, self._put)
        if self._newest is None and not topic.on_demand:
            self._newest = door.last(topic.name)

    async def first(self, patience: float) -> Msg | None:
        """The message to begin with; None when there is none, for a topic that is made on demand after `patience` [s]."""
        if self._newest is None and self._topic.on_demand:
            await wait(self._wake, patience)
        self._due = self._clock() + self._period
        return self._take()

    async def next(self, acknowledged: Callable[[], Awaitable[None]]) -> tuple[Msg, bool]:
        """The message to be sent next, and whether it wants to be acknowledged; `acknowledged()` waits for those before."""
        while True:
            await acknowledged()
            left = self._due - self._clock()
            if self._newest is None:
                await wait(self._wake, None)
            elif left > 0:
                await asyncio.sleep(left)
            else:
                break
        now = self._clock()
        self._due = now + self._period
        confirms = now >= self._confirm
        if confirms:
            self._confirm = now + CONFIRM_PERIOD
        msg = self._take()
        assert msg is not None  # nothing else takes it
        return msg, confirms

    def close(self) -> None:
        """Nobody observes any more."""
        self._end()

    def _put(self, _: str, msg: Msg) -> None:
        self._newest = msg
        self._wake.set()

    def _take(self) -> Msg | None:
        msg, self._newest = self._newest, None
        return msg
