"""Where a robot's map lies on earth: by what it says of its map's origin, or by a fix and the pose of that moment."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from bridge.core.geo import Datum
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import NavSatFix

__all__ = ["MAX_DRIFT", "PLACE_PERIOD", "RobotPlace"]

MAX_DRIFT = 15.0
"""A fix that lies farther than this from where pose and datum have the robot [m] gives a new datum: a robot was carried elsewhere,
or began its map anew. What is less is the fix's own noise."""
PLACE_PERIOD = 2.0
"""A map is taken to be elsewhere at most so often [s]: a bad receiver, or a robot that means ill, may tell another place with each message."""


class RobotPlace:
    """One robot's. Without an origin in `/robot/info` its `map` frame is taken to have x east and y north, as REP-105 asks."""

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        """`now` is our clock [s]."""
        self.datum: Datum | None = None
        """Where the `map` frame has its origin on earth; None while that is not known."""
        self._told = False
        self._now, self._since = now, -math.inf

    def look(
        self, info: RobotInfo | None, fix: NavSatFix | None, pose: PoseWithCovarianceStamped | None
    ) -> bool:
        """Take in the newest of each; True where the datum is another one than before.

        One that comes sooner than `PLACE_PERIOD` after the last waits for its time.
        """
        before, now = self.datum, self._now()
        if now - self._since < PLACE_PERIOD:
            return False
        told = _datum(info.latitude, info.longitude) if info is not None else None
        if told is not None:
            if before is None or (told.latitude, told.longitude) != (before.latitude, before.longitude):
                self.datum = told
            self._told = True
        elif not self._told and fix is not None and pose is not None and fix.status.status >= 0:
            self._fix(fix.latitude, fix.longitude, pose.pose.pose.position.x, pose.pose.pose.position.y)
        if self.datum is before:
            return False
        self._since = now
        return True

    def _fix(self, latitude: float, longitude: float, x: float, y: float) -> None:
        here = _datum(latitude, longitude)
        if here is None or not (math.isfinite(x) and math.isfinite(y)):
            return
        if self.datum is None or math.dist(self.datum.to_local(latitude, longitude), (x, y)) > MAX_DRIFT:
            self.datum = _datum(*here.to_geographic(-x, -y))


def _datum(latitude: float, longitude: float) -> Datum | None:
    try:
        return Datum(latitude, longitude)
    except ValueError:
        return None
