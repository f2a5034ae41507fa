"""A connection that is opened again whenever it is lost."""

from __future__ import annotations

import random
from collections.abc import Callable

from bridge.core.async_tasks import UntilClosed
from bridge.core.link_state import LinkFault

__all__ = ["Reconnecting"]

_BACKOFF_FACTOR = 1.25
"""Growth of the wait from one attempt to the next."""


class Reconnecting:
    """The base of a client that keeps one connection open until it is closed for good."""

    def __init__(
        self, url: str, now: Callable[[], float], backoff: tuple[float, float], rng: random.Random | None
    ) -> None:
        self.url = url
        self.place = url.partition("://")[2].strip("/") or url
        """The address as people say it."""
        self._now = now
        self._backoff = backoff
        self._rng = random.Random() if rng is None else rng
        self._work = UntilClosed(self.stay_connected)

    async def run(self) -> None:
        """Connect, and reconnect whenever the connection is lost, until `close()`; runs once at a time."""
        await self._work.run()

    async def close(self) -> None:
        """End the connection for good; `run` returns. Takes 0.3 s at most."""
        await self._work.close()

    async def stay_connected(self) -> None:
        """Connect, and reconnect whenever the connection is lost; returns only when the address can never work."""
        raise NotImplementedError

    def wait_before(self, attempt: int, fault: LinkFault = LinkFault.NONE) -> float:
        """Wait before attempt number `attempt` [s], counted from 1: a quarter longer each time, and spread.

        After an outage of t seconds the next attempt comes within half of t. After a fault that only a person can mend
        it is the longest wait from the first time on.
        """
        first, longest = self._backoff
        if fault is not LinkFault.NONE:
            first = longest
        return min(longest, first * _BACKOFF_FACTOR ** min(attempt - 1, 100)) * self._rng.uniform(0.8, 1.0)
