"""Where a pad is, by the pictures of what lies below."""

from __future__ import annotations

import math
from collections.abc import Callable

from robotside.core.pose2 import Pose2
from robotside.perception.pad_finder import GroundView
from robotside.tasks.behaviours.situation import Situation

__all__ = ["FRESH", "LOST_TIMEOUT", "Find", "PadSight"]

FRESH, LOST_TIMEOUT = 0.7, 4.0
"""Without a sighting for the first it goes up for a wider view, and after the second the pad counts as lost [s]."""

MIN_SIGHTINGS = 3
"""As many until the pad is believed: one look may err."""

NEWEST = 0.5
"""Weight of the newest sighting."""

PICTURE_PERIOD = 0.12
"""Between two pictures that are searched [s]."""

Find = Callable[[GroundView], Pose2 | None]
"""Where a pad lies in a picture: ahead and to the left of the point straight below [m]; None where none is seen."""


class PadSight:
    """The middle of the pad, kept in the frame of the odometry."""

    def __init__(self, find: Find, situation: Situation) -> None:
        """`situation` has the newest picture and what goes with it."""
        self._find, self._situation = find, situation
        self._middle: tuple[float, float] | None = None
        """Of the pad [m]."""
        self._seen, self._seen_at = 0, -math.inf
        self._picture_stamp = self._next_picture = -math.inf

    def begin(self) -> None:
        """Know nothing, and look at once."""
        self.forget()
        self._next_picture = -math.inf

    def forget(self) -> None:
        """Know nothing of where the pad is."""
        self._middle, self._seen, self._seen_at = None, 0, -math.inf

    def look(self) -> None:
        """Take in the newest picture, once."""
        now, view = self._situation, self._situation.ground
        if not view.stamp > self._picture_stamp or now.now < self._next_picture:
            return
        self._picture_stamp, self._next_picture = view.stamp, now.now + PICTURE_PERIOD
        seen = self._find(view)
        if seen is None:
            return
        x, y, _ = view.wheels.then(seen)
        if self._middle is None or self.age > LOST_TIMEOUT:
            self._middle, self._seen = (x, y), 0
        else:
            was = self._middle
            self._middle = was[0] + NEWEST * (x - was[0]), was[1] + NEWEST * (y - was[1])
        self._seen, self._seen_at = self._seen + 1, now.now

    @property
    def age(self) -> float:
        """Since it was seen last [s]; infinite before."""
        return self._situation.now - self._seen_at

    @property
    def found(self) -> bool:
        """The pad was seen often enough, and just now."""
        return self._seen >= MIN_SIGHTINGS and self.age < FRESH

    @property
    def aside(self) -> tuple[float, float]:
        """The middle of the pad ahead of the robot and to its left [m]; straight below while it was never seen."""
        if self._middle is None:
            return 0.0, 0.0
        x, y, _ = Pose2(*self._middle, 0.0).since(self._situation.odom)
        return x, y
