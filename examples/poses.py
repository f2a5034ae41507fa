"""Where a robot stands, as a command line's option."""

from __future__ import annotations

__all__ = ["pose"]


def pose(text: str) -> tuple[float, float, float]:
    """`X,Y,YAW` in `map` [m, rad]; ValueError for anything else."""
    x, y, yaw = map(float, text.split(","))
    return x, y, yaw
