"""The speed cap that follows the driver's link: the slower the answers come, the slower the robot goes.

Pure: every call is told the time, in seconds of one clock.
"""

from __future__ import annotations

import math

__all__ = ["MIN_SHARE", "FULL_SPEED_RTT", "MIN_SPEED_RTT", "UNMEASURED_SHARE", "LatencySpeedCap", "share"]

FULL_SPEED_RTT = 0.2
"""Up to this round trip it goes at full speed [s]."""

MIN_SPEED_RTT = 0.4
"""From this round trip on it crawls [s]."""

UNMEASURED_SHARE = 0.5
"""Share of the full speed over a link whose round trip is not known, where the robot's settings say nothing else."""

MIN_SHARE = 0.15
"""Share of the full speed on the worst link."""

SHARE_RISE = 0.5
"""The share grows by so much in a second: a link that has just come back may go again [1/s]."""

SHARE_STEP = 0.05
"""What is shown is a multiple of this, as CRAWL is, so that it does not change with every ping."""


def share(rtt: float) -> float:
    """Share of the full speed at a round trip of `rtt` [s], CRAWL to 1; 1 while that is NaN."""
    if math.isnan(rtt):
        return 1.0
    part = (rtt - FULL_SPEED_RTT) / (MIN_SPEED_RTT - FULL_SPEED_RTT)
    return MIN_SHARE + (1.0 - MIN_SHARE) * (1.0 - min(1.0, max(0.0, part)))


class LatencySpeedCap:
    """The share of the full speed that the driver's link allows: it falls at once and rises slowly."""

    def __init__(self) -> None:
        self.share = 1.0
        """0 to 1."""
        self._at = -math.inf

    @property
    def shown(self) -> float:
        """The share as it is told, never more than it is."""
        return 1.0 if self.share >= 1.0 else math.floor(self.share / SHARE_STEP + 1e-9) * SHARE_STEP

    def update(self, rtt: float, now: float) -> None:
        """The driver's round trip is `rtt` [s] now; NaN when it is not known or no one drives."""
        self.limit(share(rtt), now)

    def limit(self, allowed: float, now: float) -> None:
        """The share may be as much as `allowed` now, 0 to 1."""
        since = max(0.0, now - self._at)
        self._at = now
        self.share = min(allowed, self.share + SHARE_RISE * min(since, 1.0 / SHARE_RISE))

    def free(self) -> None:
        """It follows no link."""
        self.share = 1.0
