"""The dock over many sweeps, kept in the frame of the wheels: the map's error has no part in it."""

from __future__ import annotations

import math

from bridge.core.units import wrap
from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Pose2
from robotside.perception.dock_finder import DockFinder, DockSighting, Expected
from robotside.perception.tag_finder import TagFinder

__all__ = ["FIRST_REACH", "DockTrack"]

FIRST_REACH, FIRST_TURN = 0.9, 0.6
"""The first sighting is usually no farther from where the map has the dock: 0.3 m and 10° of error, seen from 2 m [m, rad]."""

MIN_REACH, MIN_TURN = 0.12, 0.2
"""Later ones may be off by so much, whatever the spread [m, rad]."""

MIN_SIGHTINGS = 3
"""As many until the dock is known: one look may err."""

DRIFT = 0.003
"""Standard deviation that the wheels add between two sweeps [m, rad]."""

MIN_GAIN, MIN_TURN_GAIN = 0.1, 0.04
"""Weight of the newest sighting at least, of place and direction: what errs in one sweep errs much the same in the next, and less from nearer."""

MAX_MISSED = 30
"""After so many sweeps in a row without it the dock counts as lost."""


class DockTrack:
    """Follows one dock from sweep to sweep, in the frame of the odometry."""

    def __init__(
        self,
        finder: DockFinder,
        tags: TagFinder | None = None,
        first_reach: float = FIRST_REACH,
    ) -> None:
        """`tags` finds the dock in pictures; None for a robot without a camera.

        `first_reach` is how far from where the map has it the dock may be seen first [m].
        """
        self._finder, self._tags, self._first_reach = finder, tags, first_reach
        self._pose: Pose2 | None = None
        self._place = self._turn = math.inf
        """Variances of place and direction [m2, rad2]."""
        self.by = ""
        """What the last sighting went by, as in `DockSighting`; empty before the first."""
        self.seen = 0
        """Sightings since it was begun."""
        self._missed = 0

    def forget(self) -> None:
        """Begin anew."""
        self._pose, self.by = None, ""
        self._place = self._turn = math.inf
        self.seen = self._missed = 0

    @property
    def known(self) -> bool:
        """It was seen often enough, and not too long ago."""
        return self.seen >= MIN_SIGHTINGS and self._missed < MAX_MISSED

    @property
    def spread(self) -> float:
        """Standard deviation of its place along each axis [m]; infinite before the first sighting."""
        return math.sqrt(self._place)

    def look(self, scan: LaserScan, wheels: Pose2, guess: Pose2) -> bool:
        """Take in a sweep that was made at `wheels`, in the frame of the odometry; True when the dock is in it.

        `guess` is where the map has the dock, in `base_link`; it counts until the first sighting.
        """
        return self._take(self._finder.find(scan, self._expected(wheels, guess)), wheels)

    def look_at(self, picture: bytes, wheels: Pose2, guess: Pose2) -> bool:
        """The same of a camera's picture."""
        seen = self._tags.find(picture, self._expected(wheels, guess)) if self._tags else None
        return self._take(seen, wheels)

    @property
    def reads_tags(self) -> bool:
        """It can find the dock in a picture."""
        return self._tags is not None and self._tags.able

    def _take(self, seen: DockSighting | None, wheels: Pose2) -> bool:
        if seen is None:
            self._missed += 1
            if self._missed >= MAX_MISSED:
                self.forget()
            return False
        self._missed, self.by = 0, seen.by
        self.seen += 1
        there = wheels.then(seen.pose)
        if self._pose is None:
            self._pose, self._place, self._turn = there, seen.spread**2, seen.turn**2
            return True
        self._place, self._turn = self._place + DRIFT**2, self._turn + DRIFT**2
        near, turned = (
            max(MIN_GAIN, self._place / (self._place + seen.spread**2)),
            max(MIN_TURN_GAIN, self._turn / (self._turn + seen.turn**2)),
        )
        was = self._pose
        self._pose = Pose2(
            was.x + near * (there.x - was.x),
            was.y + near * (there.y - was.y),
            wrap(was.yaw + turned * wrap(there.yaw - was.yaw)),
        )
        self._place = self._place * (1 - near) ** 2 + (near * seen.spread) ** 2
        self._turn = self._turn * (1 - turned) ** 2 + (turned * seen.turn) ** 2
        return True

    def pose(self, wheels: Pose2) -> Pose2 | None:
        """The dock in `base_link` of a robot at `wheels`; None while it is not known."""
        return self._pose.since(wheels) if self._pose is not None and self.known else None

    def _expected(self, wheels: Pose2, guess: Pose2) -> Expected:
        if self._pose is None:
            return Expected(guess, self._first_reach, FIRST_TURN)
        reach, turn = 4 * math.sqrt(self._place), 4 * math.sqrt(self._turn)
        return Expected(self._pose.since(wheels), max(MIN_REACH, reach), max(MIN_TURN, turn))
