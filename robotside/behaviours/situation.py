"""What behaviours know of the world at this moment."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from robotside.pose2 import ORIGIN, Points, Pose2

__all__ = ["Situation"]


@dataclass
class Situation:
    """Brought up to date before each tick."""

    now: float = 0.0
    """[s], robot clock."""
    pose: Pose2 = ORIGIN
    """Of the robot in `map`."""
    points: Points = field(default_factory=lambda: np.empty((0, 2)))
    """What the laser sees, in `base_link`."""
