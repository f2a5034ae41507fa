"""The robot's topics and services, asked for when the link is made and, of a foreign robot, again and again.

Everything here lives in the network thread; what is known may be read from any.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from typing import Any

from app.link.capabilities import DRIVE, Capabilities, ask_capabilities
from app.link.task_set import TaskSet
from bridge.core.errors import NoReply, NotConnected

__all__ = ["CapabilityWatch"]

log = logging.getLogger(__name__)

RETRY_DELAY, RENEW_PERIOD = 1.0, 5.0
"""Between two questions, while the robot does not answer and, where it is not ours, later on [s]."""


class CapabilityWatch:
    """Keeps what the robot offers up to date."""

    def __init__(
        self,
        call: Callable[..., Awaitable[Any]],
        tasks: TaskSet,
        *,
        on_change: Callable[[Capabilities], object],
        on_arrived: Callable[[bool], object],
    ) -> None:
        """`call` is a client's. `on_change` is called with what is offered when it is known and when it changed.

        `on_arrived` is called once on each link after the first question, with whether it was answered.
        """
        self._call, self._tasks, self._on_change, self._on_arrived = call, tasks, on_change, on_arrived
        self.capabilities: Capabilities | None = None
        """None until the robot said so, which a robot that is not ours does before it is listened to."""
        self._reported = False
        self._watching: asyncio.Task[None] | None = None

    @property
    def foreign(self) -> bool:
        """The robot is known to have no Pilothouse services."""
        return self.capabilities is not None and not self.capabilities.ours

    @property
    def steers(self) -> bool:
        """The robot has a topic for manoeuvres; without one it is driven by twists alone."""
        return self.capabilities is not None and self.capabilities.steers

    @property
    def drive_topic(self) -> str | None:
        """Topic of drive commands; None when the robot has none."""
        return DRIVE if self.capabilities is None else self.capabilities.drive

    @property
    def settled(self) -> bool:
        """Everything was asked on this link that is asked by itself."""
        return self._watching is not None and self._watching.done()

    def on_connected(self) -> None:
        """A link was made: begin to ask."""
        self._watching = self._tasks.start(self._watch())

    def on_lost(self) -> None:
        """The link is gone: no answer can come."""
        if self._watching is not None:
            self._watching.cancel()

    async def _watch(self) -> None:
        known = await self.renew()
        self._on_arrived(known)
        while not known or self.foreign:
            await asyncio.sleep(RENEW_PERIOD if known else RETRY_DELAY)
            known = await self.renew() or known

    async def renew(self) -> bool:
        """Ask what the robot offers; False when there was no answer."""
        try:
            found = await ask_capabilities(self._call, self.capabilities)
        except (NoReply, NotConnected) as problem:
            log.info("what the robot offers is not known: %s", problem)
            return False
        if found != self.capabilities or not self._reported:
            self.capabilities, self._reported = found, True
            self._on_change(found)
        return True
