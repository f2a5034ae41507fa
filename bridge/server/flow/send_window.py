"""How much may be on its way to one client, judged by WebSocket pings; without I/O.

A pong acknowledges everything that was sent before its ping, whoever the client is: browsers, roslibjs and roslibpy
answer pings by themselves. What is sent and not acknowledged waits somewhere, mostly in buffers of kernels and
routers, and a reply to STOP would wait behind it. So the window follows the delay: it grows while pongs come about as
fast as they ever do and falls to what the link was seen to deliver once they come later. The same pings are the
server's heartbeat.
"""

from __future__ import annotations

import math
import struct
from collections import deque
from typing import NamedTuple

__all__ = ["CEILING", "DEAD", "FLOOR", "START", "SendWindow"]

START = 16_384
"""The window before anything is known [byte]."""
FLOOR = 4_096
"""The smallest window [byte]."""
CEILING = 2_097_152
"""The largest window [byte]."""
QUEUE = 0.012
"""How long what is sent may wait on its way beyond what the way takes anyhow [s]."""
SILENCE = 0.25
"""A ping this much later than usual means that the client stands still [s]: it gets nothing until it answers."""
PAUSE = 0.25
"""Between two pings when little is sent [s]."""
BEAT = 5.0
"""Between two pings when nothing is sent [s]."""
DEAD = 15.0
"""A client that leaves a ping unanswered for this long is gone [s]."""
MEMORY = 30.0
"""For how long the shortest way seen is believed in [s]; the way may have changed."""
GENTLY = 0.125
"""What of the bytes that arrive is added to the window once its end was met; before, all of them."""
MAX_PINGS = 64
"""How many may be unanswered at a time."""

_NUMBER = struct.Struct("!Q")


class _Ping(NamedTuple):
    number: int
    sent: int
    acknowledged: int
    at: float


class SendWindow:
    """What one client was sent, what of it arrived, and how much more may follow."""

    def __init__(self, now: float) -> None:
        """`now` [s] is of any clock that only goes forward; the same for all methods."""
        self.limit = START
        """How much may be on its way [byte]."""
        self.sent = 0
        """All that was sent [byte]."""
        self.acknowledged = 0
        """Of that, what is known to have arrived [byte]."""
        self._pings: deque[_Ping] = deque()
        self._numbers = 0
        self._marked = 0
        self._last = -math.inf
        self.late = math.inf
        """From when on the client counts as standing still [s]: it gets nothing until it answers."""
        self._way = math.inf
        self._way_seen = now
        self._usual = 0.0
        self._settled = 0
        self._gain = 1.0

    @property
    def under_way(self) -> int:
        """What may still wait on its way [byte]."""
        return self.sent - self.acknowledged

    def has_room(self, now: float) -> bool:
        """Whether anything may be sent."""
        return self.sent - self.acknowledged < self.limit and now < self.late

    def fits(self, size: int) -> bool:
        """Whether a message of `size` [byte] may be sent: within the limit, or larger and with hardly any before it."""
        under_way = self.sent - self.acknowledged
        return under_way + size <= self.limit or under_way <= self.limit >> 3

    def needs_ping(self, now: float, waiting: bool = False) -> bool:
        """Whether a ping must follow what was sent, or is due for its own sake; `waiting` is for what does not fit."""
        fresh = self.sent - self._marked
        if waiting and fresh > 0:
            return len(self._pings) < MAX_PINGS
        if fresh >= FLOOR and fresh >= self.limit >> 2:
            return len(self._pings) < MAX_PINGS
        if self._pings:
            return False
        return now - self._last >= (PAUSE if fresh > 0 else BEAT)

    def ping(self, now: float) -> bytes:
        """Note that a ping is sent now, behind everything else; gives its content, 8 bytes."""
        self._numbers += 1
        if not self._pings:
            self.late = now + SILENCE + 4 * self._usual
        self._pings.append(_Ping(self._numbers, self.sent, self.acknowledged, now))
        self._marked = self.sent
        self._last = now
        return _NUMBER.pack(self._numbers)

    def on_pong(self, content: bytes, now: float) -> bool:
        """Take the answer to a ping in, which answers all before it as well; False when it is none of ours."""
        number = _NUMBER.unpack(content)[0] if len(content) == _NUMBER.size else 0
        if not self._pings or not self._pings[0].number <= number <= self._pings[-1].number:
            return False
        ping = self._pings.popleft()
        while ping.number != number:
            ping = self._pings.popleft()
        full = 2 * self.under_way >= self.limit
        fresh = ping.sent - self.acknowledged
        self.acknowledged = ping.sent
        took = max(now - ping.at, 1e-6)
        self._usual += (took - self._usual) / 8 if self._usual else took
        self.late = self._pings[0].at + SILENCE + 4 * self._usual if self._pings else math.inf
        self._update_minimum(took, now)
        self._adjust(ping, took, fresh if full else 0)
        return True

    def is_dead(self, now: float) -> bool:
        """Whether a ping went unanswered for too long."""
        return bool(self._pings) and now - self._pings[0].at >= DEAD

    def _update_minimum(self, took: float, now: float) -> None:
        """Keep the shortest time that a ping ever took; after a while drain the way and look anew."""
        if took <= self._way:
            self._way, self._way_seen = took, now
        elif now - self._way_seen > MEMORY:
            self._way, self._way_seen = took, now
            self.limit, self._gain = FLOOR, 1.0

    def _adjust(self, ping: _Ping, took: float, fresh: int) -> None:
        waited = took - self._way
        if waited > QUEUE:
            self._gain = GENTLY
            if ping.acknowledged >= self._settled:
                arrived = ping.sent - ping.acknowledged
                self.limit = max(FLOOR, min(self.limit, int(arrived / took * (self._way + QUEUE / 2))))
                self._settled = self.sent
        elif waited < QUEUE / 2:
            self.limit = min(CEILING, self.limit + int(fresh * self._gain))
