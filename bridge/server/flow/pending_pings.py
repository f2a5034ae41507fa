"""WebSocket pings that were sent and are not answered yet; without I/O.

A pong answers its ping and all pings before it, as RFC 6455 (5.5.3) allows.
"""

from __future__ import annotations

from collections import deque
from typing import Generic, NamedTuple, TypeVar

__all__ = ["MAX_PINGS", "PendingPings", "Ping"]

MAX_PINGS = 64
"""Most pings that may be unanswered at a time."""

N = TypeVar("N")


class Ping(NamedTuple, Generic[N]):
    """One ping."""

    number: int
    sent: float
    """When it was sent [s]."""
    note: N
    """What its sender keeps with it."""


class PendingPings(Generic[N]):
    """The unanswered pings of one purpose on one connection."""

    def __init__(self, mark: bytes = b"") -> None:
        """`mark` begins the content of each ping and tells the pings of different purposes apart."""
        self._mark = mark
        self._numbers = 0
        self._pings: deque[Ping[N]] = deque()

    def __len__(self) -> int:
        return len(self._pings)

    @property
    def is_full(self) -> bool:
        """Whether no more pings may be sent before one is answered."""
        return len(self._pings) >= MAX_PINGS

    @property
    def oldest(self) -> float:
        """When the oldest one was sent [s]; IndexError when there is none."""
        return self._pings[0].sent

    def send(self, now: float, note: N) -> bytes:
        """Remember a ping that is sent at `now` [s]; returns its content."""
        self._numbers += 1
        self._pings.append(Ping(self._numbers, now, note))
        return self._mark + self._numbers.to_bytes(8, "big")

    def on_pong(self, content: bytes) -> Ping[N] | None:
        """The ping that a pong answers, which is forgotten with all before it; None for a pong to none of these."""
        pings = self._pings
        if not pings or len(content) != len(self._mark) + 8 or not content.startswith(self._mark):
            return None
        number = int.from_bytes(content[len(self._mark) :], "big")
        if not pings[0].number <= number <= pings[-1].number:
            return None
        ping = pings.popleft()
        while ping.number != number:
            ping = pings.popleft()
        return ping
