"""The round-trip time of one operator's link, measured by WebSocket pings at a fixed rate; without I/O.

Every WebSocket client answers pings by itself. A message that comes after a pong was sent after its ping left, so the pings
also bound the age of messages that carry no stamp.
"""

from __future__ import annotations

import math

from bridge.server.flow.pending_pings import PendingPings

__all__ = ["PING_PERIOD", "RoundTrip"]

PING_PERIOD = 0.2
"""Time between two pings [s]."""


class RoundTrip:
    """The round trip of one connection; times are [s] of one clock that only goes forward."""

    def __init__(self, opened: float) -> None:
        """`opened` is the time of connection [s]."""
        self.rtt = math.nan
        """Round-trip time of the ping answered last, or the time that the next one has waited if that is longer [s]; NaN until
        known."""
        self.answered = opened
        """When the newest answered ping was sent [s]; the time of connection until then."""
        self._pings: PendingPings[None] = PendingPings(b"rtt")
        self._last_rtt = math.nan

    def ping(self, now: float) -> bytes | None:
        """The content of a ping that is sent at `now` [s]; None when too many are unanswered."""
        self._update(now)
        return None if self._pings.is_full else self._pings.send(now, None)

    def on_pong(self, content: bytes, now: float) -> bool:
        """Handle a pong that came at `now` [s]; False when it answers none of these pings."""
        ping = self._pings.on_pong(content)
        if ping is None:
            return False
        self.answered, self._last_rtt = ping.sent, now - ping.sent
        self._update(now)
        return True

    def _update(self, now: float) -> None:
        waited = now - self._pings.oldest if self._pings else 0.0
        overdue = waited > PING_PERIOD and not waited <= self._last_rtt  # NaN too
        self.rtt = waited if overdue else self._last_rtt
