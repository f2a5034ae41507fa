"""How long the way to the robot takes, how the operators' clock differs from ours, and what goes unanswered."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass

__all__ = ["Ping", "PingStatistics"]

WINDOW = 20
"""As many pings are looked at."""
LOST_TIMEOUT = 1.5
"""A ping without answer for this long counts as lost [s]."""


@dataclass(slots=True)
class Ping:
    """One question for the robot's time."""

    sent: float
    """Our clock [s]."""
    rtt: float = math.nan
    """From the question to its answer [s]; NaN until there is one."""
    offset: float = math.nan
    """The operators' clock minus ours [s]; NaN when the answer did not say the time."""


class PingStatistics:
    """The last 20 pings of one connection."""

    def __init__(self) -> None:
        self.rtt = math.nan
        """Of the ping answered last [s]; NaN until there is one."""
        self.offset = math.nan
        """The operators' clock minus ours [s], from the ping with the shortest way; NaN until known."""
        self._last: deque[Ping] = deque(maxlen=WINDOW)

    def on_sent(self, now: float) -> Ping:
        """Note that one was sent at `now` [s]."""
        ping = Ping(now)
        self._last.append(ping)
        return ping

    def on_answer(self, ping: Ping, now: float, robot_time: float) -> None:
        """Note that it was answered at `now` with `robot_time` [s], operators' clock, NaN when the robot did not say.

        The robot is taken to have looked at that clock half-way between question and answer.
        """
        self.rtt = ping.rtt = now - ping.sent
        ping.offset = robot_time - (ping.sent + ping.rtt / 2)
        known = [each for each in self._last if not math.isnan(each.offset)]
        self.offset = min(known, key=lambda each: each.rtt).offset if known else math.nan

    def lost(self, now: float) -> int:
        """How many of the last 20 were not answered within 1.5 s."""
        return sum(1 for ping in self._last if math.isnan(ping.rtt) and ping.sent < now - LOST_TIMEOUT)
