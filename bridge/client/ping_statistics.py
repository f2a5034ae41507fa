"""Ping statistics of a link: round-trip time, offset of the operators' clock, and loss."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

__all__ = ["Ping", "PingStatistics"]

WINDOW = 20
"""Number of pings that the statistics cover."""
LOST_TIMEOUT = 1.5
"""A ping without an answer for this long counts as lost [s]."""


@dataclass(slots=True)
class Ping:
    """One question for the robot's time."""

    sent: float
    """When it was sent, our clock [s]."""
    rtt: float = math.nan
    """Round-trip time [s]; NaN until it is answered."""
    offset: float = math.nan
    """Offset of the operators' clock from ours [s]; NaN when the answer has no time."""


class PingStatistics:
    """The last 20 pings of one connection."""

    def __init__(self) -> None:
        self.rtt = math.nan
        """Round-trip time of the ping answered last [s]; NaN until there is one."""
        self.offset = math.nan
        """Offset of the operators' clock from ours [s], from the fastest ping; NaN until known."""
        self._last: deque[Ping] = deque(maxlen=WINDOW)

    def on_sent(self, now: float) -> Ping:
        """Note a ping that is sent at `now` [s]."""
        ping = Ping(now)
        self._last.append(ping)
        return ping

    def on_answer(self, ping: Ping, now: float, robot_time: float) -> None:
        """Note the answer to a ping at `now` with `robot_time` [s], operators' clock, NaN when the robot reported
        none.

        The robot is assumed to have read its clock half-way between question and answer.
        """
        self.rtt = ping.rtt = now - ping.sent
        ping.offset = robot_time - (ping.sent + ping.rtt / 2)
        known = [each for each in self._last if not math.isnan(each.offset)]
        self.offset = min(known, key=lambda each: each.rtt).offset if known else math.nan

    def lost(self, now: float) -> int:
        """Number of the last 20 pings that were not answered within 1.5 s."""
        return sum(1 for ping in self._last if math.isnan(ping.rtt) and ping.sent < now - LOST_TIMEOUT)
