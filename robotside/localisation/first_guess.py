"""The first guess of a robot that nobody has placed: by satellites and compass, or where its map or its odometry begins."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.localisation.beacons import Beacons
from robotside.records.events import Say

__all__ = ["GUESS_REACH", "GUESS_YAW", "FirstGuess"]

FIX_TIMEOUT = 3.0
"""Without fix and compass for this long the robot supposes to stand at the map's origin [s]."""

GUESS_REACH, GUESS_YAW = 4.0, 0.35
"""The largest error of a guess by satellite and compass [m, rad]."""

_NO_IDEA = Notice(
    Code.POSITION_LOST,
    "No fix or compass: the robot assumes the map's origin. Place it on the map.",
)

_NO_LASER = Notice(
    Code.POSITION_BY_WHEELS,
    "No laser: the position may drift. Place the robot on the map when it is off.",
)


class FirstGuess:
    """Waits for satellites and compass for a while; times are of the robot's clock [s]."""

    def __init__(self, beacons: Beacons, say: Say) -> None:
        self._beacons, self._say = beacons, say
        self._swept = self._begun = math.nan

    def to_search(self, stamp: float) -> tuple[Pose2, float, float] | None:
        """With a laser: a pose, and how far off it may be [m, rad], to be searched by the sweep taken at `stamp`; None while it waits."""
        if math.isnan(self._swept):
            self._swept = stamp
        guess = self._beacons.guess
        if guess is not None:
            return guess, GUESS_REACH, GUESS_YAW
        if stamp - self._swept > FIX_TIMEOUT:
            self._say("localisation", _NO_IDEA, "warn")
            return ORIGIN, GUESS_REACH, math.pi
        return None

    def to_reckon(self, odom: Pose2, stamp: float, *, waits: bool) -> tuple[Pose2, float, float, bool] | None:
        """Without a laser: a pose with its spread [m] and that of its yaw [rad], and whether it is by satellites; None while it `waits`, or has to.

        `odom` is what it takes without them.
        """
        if math.isnan(self._begun):
            self._begun = stamp
        if waits or stamp - self._begun < FIX_TIMEOUT:
            return None
        guess = self._beacons.guess
        self._say("localisation", _NO_LASER)
        return (odom, 0.3, 0.1, False) if guess is None else (guess, 1.0, 0.1, True)
