"""Moving obstacles in a laser sweep, such as another robot or a person: one that approaches leaves only part of the room."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points
from robotside.mapping.distances import within

__all__ = ["ROOM_SHARE", "MovingObstacles"]

COMPARED_AGE = 0.4
"""The age of the sweep that the newest one is compared with [s]."""

MIN_MOTION = 0.12
"""Where nothing was within this of it then, it has moved [m]: faster than a third of a metre a second."""

ROOM_SHARE = 0.55
"""Part of the room up to something that moves: the other uses the rest."""

MAX_RANGE = 4.0
"""Farther away it does not matter yet [m]."""


class MovingObstacles:
    """Looks for them from sweep to sweep; everything in `map`."""

    def __init__(self) -> None:
        self._before: deque[tuple[float, Points]] = deque(maxlen=20)

    def moving(
        self, placed: Points, stamp: float, asked: NDArray[np.bool_] | None = None
    ) -> NDArray[np.bool_]:
        """Which points of the sweep at `stamp` [s], of those that are `asked` for, have moved; none without a sweep to compare with."""
        while len(self._before) > 1 and self._before[1][0] <= stamp - COMPARED_AGE:
            self._before.popleft()
        old = self._before[0] if self._before else None
        self._before.append((stamp, placed))
        if (
            old is None
            or not len(old[1])
            or not COMPARED_AGE / 2 < stamp - old[0] < 3 * COMPARED_AGE
            or not len(placed)
        ):
            return np.zeros(len(placed), dtype=np.bool_)
        if asked is None:
            return ~within(placed, old[1], MIN_MOTION)
        moved = asked.copy()
        moved[asked] = ~within(placed[asked], old[1], MIN_MOTION)
        return moved

    @staticmethod
    def nearer(points: Points) -> Points:
        """Where `points` of `base_link` that move have to be supposed, so that half of the room is left to them."""
        return ROOM_SHARE * points[np.hypot(points[:, 0], points[:, 1]) < MAX_RANGE]
