"""What a robot on wheels sees of a dock: by its laser, or without one by its camera."""

from __future__ import annotations

import math

from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Pose2
from robotside.perception.dock_track import DockTrack
from robotside.tasks.behaviours.situation import Situation

__all__ = ["DockSight"]

PICTURE_PERIOD = 0.25
"""Between two pictures that are searched for a tag [s]."""

TAG_LEAVES = 1.1
"""Nearer than this the tag leaves the picture: the last bit goes by the wheels [m]."""


class DockSight:
    """Feeds the newest sweep or picture to the dock's `track`."""

    def __init__(self, track: DockTrack, situation: Situation) -> None:
        """`situation` has them."""
        self.track = track
        """The dock, as far as it is known."""
        self._situation = situation
        self._scan: LaserScan | None = None
        self._picture_stamp = self._next_picture = -math.inf

    @property
    def by_camera(self) -> bool:
        """It has no laser, but a camera and what reads a dock's tag in its pictures."""
        return self._situation.scan is None and self.track.reads_tags

    @property
    def able(self) -> bool:
        """It has what may show a dock at all."""
        return self._situation.scan is not None or self.by_camera

    @property
    def would_see(self) -> bool:
        """What it does not see is not there: the laser would see reflectors, or there are pictures."""
        scan = self._situation.scan
        if scan is not None:
            return len(scan.intensities) > 0
        return self.by_camera and bool(self._situation.picture)

    def look(self, guess: Pose2) -> None:
        """Take in the newest sweep or picture, once; `guess` is where the dock should be, in `base_link`."""
        now = self._situation
        if now.scan is not None:
            if now.scan is not self._scan:
                self._scan = now.scan
                self.track.look(now.scan, now.swept, guess)
        elif now.picture_stamp > self._picture_stamp and now.worked >= self._next_picture:
            self._picture_stamp, self._next_picture = now.picture_stamp, now.worked + PICTURE_PERIOD
            dock = self.track.pose(now.odom)
            if dock is None or dock.x > TAG_LEAVES:
                self.track.look_at(now.picture, now.pictured, guess)
