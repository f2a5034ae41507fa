"""How long the way to one client and back takes at this moment, by WebSocket pings of their own; without I/O.

Every client answers them by itself, whatever it is made of. What comes from a client after the answer to a ping was sent
after that ping left, so the pings tell as well how old at most a message can be that says nothing of its age.
"""

from __future__ import annotations

import math
import struct
from collections import deque

__all__ = ["PING_PERIOD", "RoundTrip"]

PING_PERIOD = 0.2
"""Between two pings [s]."""

_MAX_PINGS = 64
"""How many may be unanswered at a time; more are not sent."""

_MARK = b"rtt"
_NUMBER = struct.Struct("!3sQ")


class RoundTrip:
    """The pings of one connection; times are [s] of one clock that only goes forward."""

    def __init__(self, opened: float) -> None:
        self.rtt = math.nan
        """Of the ping answered last, or how long the next one has waited if that is more [s]; NaN until known."""
        self.answered = opened
        """When the newest ping was sent that is answered [s]; the opening until then."""
        self._waiting: deque[tuple[int, float]] = deque()
        self._count = 0
        self._took = math.nan

    def ping(self, now: float) -> bytes | None:
        """The content of one that is sent at `now` [s]; None when too many wait for their answer."""
        self._update(now)
        if len(self._waiting) >= _MAX_PINGS:
            return None
        self._count += 1
        self._waiting.append((self._count, now))
        return _NUMBER.pack(_MARK, self._count)

    def on_pong(self, content: bytes, now: float) -> bool:
        """Take in an answer that came at `now` [s] and answers all before it as well; False when it is none of these."""
        if len(content) != _NUMBER.size:
            return False
        mark, number = _NUMBER.unpack(content)
        if mark != _MARK or not self._waiting or not self._waiting[0][0] <= number <= self._waiting[-1][0]:
            return False
        sent = now
        while self._waiting and self._waiting[0][0] <= number:
            sent = self._waiting.popleft()[1]
        self.answered, self._took = sent, now - sent
        self._update(now)
        return True

    def _update(self, now: float) -> None:
        waited = now - self._waiting[0][1] if self._waiting else 0.0
        if waited > PING_PERIOD and not waited <= self._took:  # NaN too
            self.rtt = waited
        else:
            self.rtt = self._took
