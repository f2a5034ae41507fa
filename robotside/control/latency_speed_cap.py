"""How fast a robot may be driven over a link: the slower the answers come, the slower it goes.

Pure: every call is told the time, in seconds of one clock.
"""

from __future__ import annotations

import math

__all__ = ["CRAWL", "FULL_TO", "SLOWEST_FROM", "UNMEASURED_SHARE", "Pace", "share"]

FULL_TO = 0.2
"""Up to this round trip it goes at full speed [s]."""

SLOWEST_FROM = 0.4
"""From this round trip on it crawls [s]."""

UNMEASURED_SHARE = 0.5
"""Share of the full speed over a link whose round trip is not known, where the robot's settings say nothing else."""

CRAWL = 0.15
"""Share of the full speed on the worst link."""

RISE = 0.5
"""The share grows by so much in a second: a link that has just come back may go again [1/s]."""

STEP = 0.05
"""What is shown is a multiple of this, as CRAWL is, so that it does not change with every ping."""


def share(rtt: float) -> float:
    """Share of the full speed at a round trip of `rtt` [s], CRAWL to 1; 1 while that is NaN."""
    if math.isnan(rtt):
        return 1.0
    part = (rtt - FULL_TO) / (SLOWEST_FROM - FULL_TO)
    return CRAWL + (1.0 - CRAWL) * (1.0 - min(1.0, max(0.0, part)))


class Pace:
    """The share of the full speed that the driver's link allows: it falls at once and rises slowly."""

    def __init__(self) -> None:
        self.share = 1.0
        """0 to 1."""
        self._at = -math.inf

    @property
    def shown(self) -> float:
        """The share as it is told, never more than it is."""
        return 1.0 if self.share >= 1.0 else math.floor(self.share / STEP + 1e-9) * STEP

    def look(self, rtt: float, now: float) -> None:
        """The driver's round trip is `rtt` [s] now; NaN when it is not known or nobody drives."""
        self.limit(share(rtt), now)

    def limit(self, allowed: float, now: float) -> None:
        """The share may be as much as `allowed` now, 0 to 1."""
        since = max(0.0, now - self._at)
        self._at = now
        self.share = min(allowed, self.share + RISE * min(since, 1.0 / RISE))

    def free(self) -> None:
        """It follows no link."""
        self.share = 1.0
