"""The number of bytes that may be under way to one client, judged by WebSocket pings; without I/O.

A pong acknowledges everything that was sent before its ping, whatever the client is: browsers, roslibjs and roslibpy answer
pings by themselves. Bytes that are sent and not acknowledged wait somewhere, mostly in buffers of kernels and routers, and a
reply to STOP would wait behind them. So the window follows the delay: it grows while pongs come about as fast as they ever do
and falls to the link's measured throughput when they come later. The same pings are the server's heartbeat.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from bridge.server.flow.pending_pings import PendingPings

__all__ = ["DEAD_TIMEOUT", "MAX_WINDOW", "MIN_WINDOW", "START_WINDOW", "SendWindow"]

START_WINDOW = 16_384
"""The window before anything is known [byte]."""
MIN_WINDOW = 4_096
"""The smallest window [byte]."""
MAX_WINDOW = 2_097_152
"""The largest window [byte]."""
MAX_QUEUE_DELAY = 0.012
"""Longest time that bytes may wait on their way beyond the link's own delay [s]."""
STALL_TIME = 0.25
"""A ping that is this much later than usual means that the client stalls [s]: it gets nothing until it answers."""
BUSY_PING_PERIOD = 0.25
"""Time between two pings when little is sent [s]."""
IDLE_PING_PERIOD = 5.0
"""Time between two pings when nothing is sent [s]."""
DEAD_TIMEOUT = 15.0
"""A client that leaves a ping unanswered for this long is gone [s]."""
MIN_DELAY_LIFETIME = 30.0
"""How long the shortest delay counts as the link's own [s]; the link may have changed."""
CAREFUL_GAIN = 0.125
"""Part of the acknowledged bytes that the window grows by once it has met its limit; before that, all of them."""


class _Sent(NamedTuple):
    """The counters when a ping was sent."""

    sent: int
    acknowledged: int


class SendWindow:
    """The bytes sent to one client, those acknowledged, and the room for more."""

    def __init__(self, now: float) -> None:
        """`now` [s] is of any clock that only goes forward; the same for all methods."""
        self.limit = START_WINDOW
        """Most bytes that may be under way."""
        self.sent = 0
        """Bytes sent since the connection."""
        self.acknowledged = 0
        """Bytes known to have arrived."""
        self._pings: PendingPings[_Sent] = PendingPings()
        self._marked = 0
        self._last = -math.inf
        self.stalls_at = math.inf
        """Time from which the client counts as stalled [s]: it gets nothing until it answers."""
        self._min_delay = math.inf
        self._min_delay_time = now
        self._usual_rtt = 0.0
        self._settled_bytes = 0
        self._gain = 1.0

    @property
    def under_way(self) -> int:
        """Bytes that may still be on their way."""
        return self.sent - self.acknowledged

    def has_room(self, now: float) -> bool:
        """Whether anything may be sent."""
        return self.sent - self.acknowledged < self.limit and now < self.stalls_at

    def fits(self, size: int) -> bool:
        """Whether a message of `size` [byte] may be sent: within the limit, or larger with hardly anything under way."""
        under_way = self.sent - self.acknowledged
        return under_way + size <= self.limit or under_way <= self.limit >> 3

    def needs_ping(self, now: float, waiting: bool = False) -> bool:
        """Whether a ping is due, to follow data or for its own sake; `waiting` is for a message that does not fit."""
        fresh = self.sent - self._marked
        if waiting and fresh > 0:
            return not self._pings.is_full
        if fresh >= MIN_WINDOW and fresh >= self.limit >> 2:
            return not self._pings.is_full
        if self._pings:
            return False
        return now - self._last >= (BUSY_PING_PERIOD if fresh > 0 else IDLE_PING_PERIOD)

    def ping(self, now: float) -> bytes:
        """Note a ping that is sent now, behind everything else; returns its content, 8 bytes."""
        if not self._pings:
            self.stalls_at = now + STALL_TIME + 4 * self._usual_rtt
        self._marked = self.sent
        self._last = now
        return self._pings.send(now, _Sent(self.sent, self.acknowledged))

    def on_pong(self, content: bytes, now: float) -> bool:
        """Handle a pong, which answers all pings before it as well; False when it answers none of these."""
        ping = self._pings.on_pong(content)
        if ping is None:
            return False
        then = ping.note
        full = 2 * self.under_way >= self.limit
        fresh = then.sent - self.acknowledged
        self.acknowledged = then.sent
        took = max(now - ping.sent, 1e-6)
        self._usual_rtt += (took - self._usual_rtt) / 8 if self._usual_rtt else took
        self.stalls_at = self._pings.oldest + STALL_TIME + 4 * self._usual_rtt if self._pings else math.inf
        self._update_min_delay(took, now)
        self._adjust(then, took, fresh if full else 0)
        return True

    def is_dead(self, now: float) -> bool:
        """Whether a ping went unanswered for too long."""
        return bool(self._pings) and now - self._pings.oldest >= DEAD_TIMEOUT

    def _update_min_delay(self, took: float, now: float) -> None:
        """Keep the shortest round trip of any ping; after a while let the link drain and measure it anew."""
        if took <= self._min_delay:
            self._min_delay, self._min_delay_time = took, now
        elif now - self._min_delay_time > MIN_DELAY_LIFETIME:
            self._min_delay, self._min_delay_time = took, now
            self.limit, self._gain = MIN_WINDOW, 1.0

    def _adjust(self, then: _Sent, took: float, fresh: int) -> None:
        waited = took - self._min_delay
        if waited > MAX_QUEUE_DELAY:
            self._gain = CAREFUL_GAIN
            if then.acknowledged >= self._settled_bytes:
                arrived = then.sent - then.acknowledged
                self.limit = max(
                    MIN_WINDOW, min(self.limit, int(arrived / took * (self._min_delay + MAX_QUEUE_DELAY / 2)))
                )
                self._settled_bytes = self.sent
        elif waited < MAX_QUEUE_DELAY / 2:
            self.limit = min(MAX_WINDOW, self.limit + int(fresh * self._gain))
