"""Standing at a point for a while."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from robotside.behaviours.situation import Situation

__all__ = ["Dwell"]


class Dwell(Behaviour):
    """Stands for `duration` [s] of the robot's clock."""

    def __init__(self, duration: float, situation: Situation) -> None:
        super().__init__("dwell")
        self._duration, self._situation = duration, situation
        self._until = -math.inf

    def initialise(self) -> None:
        """Begin to wait; the robot is at rest already."""
        self._until = self._situation.now + self._duration

    def update(self) -> Status:
        """Wait."""
        left = self._until - self._situation.now
        self.feedback_message = f"Standing for another {max(left, 0.0):.0f} s."
        return Status.RUNNING if left > 1e-6 else Status.SUCCESS
