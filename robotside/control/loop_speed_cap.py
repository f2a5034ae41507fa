"""The speed cap that follows the robot's own loop: one that simulates slowly or looks late goes slower, and rests at last.

Pure. A simulation is measured by how fast its time passes, a real robot by how late its loop is.
"""

from __future__ import annotations

import math

__all__ = [
    "FULL_SPEED_FACTOR",
    "FULL_SPEED_LAG",
    "MIN_FACTOR",
    "MAX_LATENESS",
    "share_by_factor",
    "share_by_lag",
]

FULL_SPEED_FACTOR = 0.8
"""From this real-time factor on a simulated robot goes at full speed."""

MIN_FACTOR = 0.2
"""Below this one it rests: what an operator sees and does no longer belongs together."""

FULL_SPEED_LAG = 0.2
"""Up to this lateness of its loop a robot goes at full speed [s]."""

MAX_LATENESS = 1.0
"""From this one on it rests: whatever it meets it would learn too late [s]."""


def share_by_factor(factor: float) -> float:
    """Share of the full speed, 0 to 1, in a simulation of which `factor` seconds pass in a second; what is no number rests."""
    if factor >= FULL_SPEED_FACTOR:
        return 1.0
    return factor if factor >= MIN_FACTOR else 0.0


def share_by_lag(lag: float) -> float:
    """Share of the full speed, 0 to 1, with a loop that is late by `lag` [s] on average; what is no number rests."""
    if math.isnan(lag):
        return 0.0
    part = (lag - FULL_SPEED_LAG) / (MAX_LATENESS - FULL_SPEED_LAG)
    return 1.0 - min(1.0, max(0.0, part))
