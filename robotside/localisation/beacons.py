"""What else than the laser says where the robot is: satellites and the compass."""

from __future__ import annotations

import math
from collections import deque

from bridge.core.geo import Datum
from bridge.core.units import wrap
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import NavSatFix
from robotside.core.pose2 import Pose2

__all__ = ["FIX_SPREAD", "MIN_FIX_SPREAD", "Beacons", "variance_of"]

FIXES_AVERAGED = 5
"""Satellite fixes that are averaged."""

FIX_SPREAD = 1.0
"""How far a single fix is trusted that does not say how good it is [m]."""

MIN_FIX_SPREAD = 0.02
"""No receiver is better than this, whatever it says [m]."""

MAX_FIX_AGE = 3.0
"""Fixes and compass older than this say nothing any more [s]."""

MAX_AGAINST_FIX, MAX_AGAINST_COMPASS = 8.0, 4.0
"""What they can have against a place at the most (logarithm): both may be wrong for minutes, near walls and near steel."""

COMPASS_ERROR = 0.35
"""Of the compass near steel, one standard deviation [rad]."""

FIXES_CONTRADICT = 10
"""Looks in a row that the fixes must contradict before the place is doubted."""

CONTRADICTION = 3.0
"""A place so many standard deviations off the fixes is contradicted by them."""


class Beacons:
    """The last fixes, in `map`, and the compass; times are of the robot's clock [s]."""

    def __init__(self, info: RobotInfo) -> None:
        has_place = not (math.isnan(info.latitude) or math.isnan(info.longitude))
        self._datum = Datum(info.latitude, info.longitude) if has_place else None
        self._fixes: deque[tuple[float, float]] = deque(maxlen=FIXES_AVERAGED)
        self._variance = FIX_SPREAD**2
        self._fixed = self._faced = -math.inf
        self._contradicted = 0
        self.compass = math.nan
        """Heading [rad], 0 east; NaN for none."""

    def forget(self) -> None:
        """The robot was carried: earlier fixes are of elsewhere."""
        self._fixes.clear()
        self.elsewhere()

    def elsewhere(self) -> None:
        """Another place is believed from now on: what contradicted the last one does not count against it."""
        self._contradicted = 0

    def on_fix(self, fix: NavSatFix) -> tuple[float, float] | None:
        """Remember a fix; where it is in `map` [m], None when it is of no use."""
        if not self._datum or fix.status.status < 0 or not math.isfinite(fix.latitude + fix.longitude):
            return None
        self._fixes.append(self._datum.to_local(fix.latitude, fix.longitude))
        self._variance, self._fixed = variance_of(fix), fix.header.stamp.seconds
        return self._fixes[-1]

    def on_compass(self, yaw: float, stamp: float) -> None:
        """Remember a heading [rad]; NaN for none."""
        self.compass, self._faced = yaw, stamp

    @property
    def guess(self) -> Pose2 | None:
        """Where the robot is by both alone; None while there are too few fixes, or no compass."""
        if len(self._fixes) < FIXES_AVERAGED or math.isnan(self.compass):
            return None
        return Pose2(*self._mean, self.compass)

    @property
    def _mean(self) -> tuple[float, float]:
        x, y = (sum(axis) / len(self._fixes) for axis in zip(*self._fixes, strict=True))
        return x, y

    def log_likelihood(self, pose: Pose2, now: float) -> float:
        """What they say of a place; 0 at the most, and 0 where they say nothing."""
        against = 0.0
        if self._fixes and now - self._fixed < MAX_FIX_AGE:
            against -= min(MAX_AGAINST_FIX, 0.5 * pose.distance(*self._mean) ** 2 / self._variance)
        if math.isfinite(self.compass) and now - self._faced < MAX_FIX_AGE:
            off = wrap(pose.yaw - self.compass)
            against -= min(MAX_AGAINST_COMPASS, 0.5 * (off / COMPASS_ERROR) ** 2)
        return against

    def contradicts(self, pose: Pose2, variance: float, now: float) -> bool:
        """The fixes together are farther from `pose` than their errors allow; `variance` is that of the place [m2]."""
        if len(self._fixes) < FIXES_AVERAGED or now - self._fixed > MAX_FIX_AGE:
            return False
        return pose.distance(*self._mean) > CONTRADICTION * math.sqrt(self._variance + variance)

    def contradict(self, pose: Pose2, variance: float, now: float) -> bool:
        """The same for each look at where it is; True once, when they have contradicted so many of them in a row."""
        self._contradicted = self._contradicted + 1 if self.contradicts(pose, variance, now) else 0
        return self._contradicted == FIXES_CONTRADICT


def variance_of(fix: NavSatFix) -> float:
    """Of a fix, along each axis [m2]; a usual one when it does not say."""
    said = max(fix.position_covariance[0], fix.position_covariance[4])
    if not fix.position_covariance_type or not math.isfinite(said) or said <= 0:
        return FIX_SPREAD**2
    return max(said, MIN_FIX_SPREAD**2)
