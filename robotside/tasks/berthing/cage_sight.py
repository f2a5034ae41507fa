"""Where a cage is, by the pictures of what lies ahead: kept in the frame of the odometry, with what the log errs by."""

from __future__ import annotations

import math
from collections.abc import Callable

from bridge.core.units import wrap
from robotside.core.pose2 import Pose2
from robotside.perception.cage_finder import CageSighting, FrontView
from robotside.tasks.behaviours.situation import Situation

__all__ = ["FRESH", "CageSight", "Look"]

FRESH = 1.5
"""Without a sighting for so long it goes by the odometry alone [s]."""

MIN_SIGHTINGS = 3
"""As many until the cage is believed: one look may err."""

PICTURE_PERIOD = 0.15
"""Between two pictures that are searched [s]."""

REACH = 2.0
"""The first sighting is no farther from where the map has the cage [m]; later ones from where it was by `LATER`."""

LATER = 0.3

MAP_TURN, MAX_ASKEW = 0.15, 0.8
"""Standard deviation of the direction that the map has, and a cage that is turned from it by more is another one [rad]."""

MIN_TURN = 0.03
"""The pictures share an error of the direction that no average takes out [rad]."""

DRIFT, DRIFT_CHANGE = 0.05, 2e-5
"""Standard deviation of the log's error along each axis [m/s], and how that changes [m2/s3]."""

NEWEST = 0.3
"""Weight of the newest height."""

Look = Callable[[FrontView], list[CageSighting]]
"""The cages in a picture."""


class CageSight:
    """The cage over many pictures: the map's error has no part in its place, and little in its direction."""

    def __init__(self, look: Look, situation: Situation, reach: float = REACH) -> None:
        """`situation` has the newest picture and what goes with it; `reach` is how far from where the map has it it may be seen first [m]."""
        self._look, self._situation, self._reach = look, situation, reach
        self._stamp = self._next = -math.inf
        self.forget()

    def forget(self) -> None:
        """Know nothing of where the cage is."""
        self._place, self._error, self._rolled = (0.0, 0.0), (0.0, 0.0), self._situation.now
        self._yaw, self._turn = 0.0, math.inf
        self._spread, self._both, self._drifting = 0.0, 0.0, 0.0
        self._seen_at = -math.inf
        self._seen = 0
        self.height = math.nan
        """Of the tag's middle above the map's origin [m]; NaN while it was not seen, or the robot's height is not known."""

    @property
    def age(self) -> float:
        """Since it was seen last [s]; infinite before."""
        return self._situation.now - self._seen_at

    @property
    def known(self) -> bool:
        """It was seen often enough."""
        return self._seen >= MIN_SIGHTINGS

    @property
    def error(self) -> tuple[float, float]:
        """Of the log, ahead and to the left [m/s]: it errs along its own axes, so that what it adds up turns with the robot."""
        return self._error

    def take(self, guess: Pose2) -> None:
        """Take in the newest picture, once; `guess` is where the map has the cage now, in `base_link`."""
        now, view = self._situation, self._situation.ahead
        self._roll()
        if not view.stamp > self._stamp or now.now < self._next:
            return
        self._stamp, self._next = view.stamp, now.now + PICTURE_PERIOD
        expected, reach = (
            (self._there(), LATER + DRIFT * self.age) if self.known else (now.odom.then(guess), self._reach)
        )
        near = [
            seen
            for seen in self._look(view)
            if view.wheels.then(seen.pose).distance(expected.x, expected.y) < reach
            and abs(wrap(view.wheels.then(seen.pose).yaw - expected.yaw)) < MAX_ASKEW
        ]
        if near:
            off = min(near, key=lambda seen: view.wheels.then(seen.pose).distance(expected.x, expected.y))
            self._add(off, view, expected.yaw)

    def _roll(self) -> None:
        """Take along what the log has erred since, in the frame of the odometry."""
        now = self._situation
        since, self._rolled = now.now - self._rolled, now.now
        x, y, _ = now.odom._replace(x=0.0, y=0.0).then(Pose2(*self._error, 0.0))
        self._place = self._place[0] + since * x, self._place[1] + since * y

    def _there(self) -> Pose2:
        """Where it is in the frame of the odometry by now."""
        return Pose2(*self._place, self._yaw)

    def _add(self, seen: CageSighting, view: FrontView, yaw: float) -> None:
        there, up = view.wheels.then(seen.pose), view.height + seen.up
        if self._seen == 0:
            self._place, self._yaw, self._turn = (there.x, there.y), yaw, MAP_TURN**2
            self._spread, self._both, self._drifting = seen.spread**2, 0.0, DRIFT**2
        else:
            self._correct((there.x, there.y), seen.spread**2, self.age)
        gain = self._turn / (self._turn + seen.turn**2)
        self._yaw = wrap(self._yaw + gain * wrap(there.yaw - self._yaw))
        self._turn = max((1 - gain) * self._turn, MIN_TURN**2)
        if math.isfinite(up):
            self.height = up if math.isnan(self.height) else self.height + NEWEST * (up - self.height)
        self._seen_at = self._situation.now
        self._seen += 1

    def _correct(self, there: tuple[float, float], variance: float, since: float) -> None:
        """A Kalman filter of the place and the log's error, the same along both axes; `since` the one before [s]."""
        drifting = self._drifting + DRIFT_CHANGE * since
        both = self._both + since * self._drifting
        spread = self._spread + 2 * since * self._both + since * since * self._drifting + 1e-6
        total = spread + variance
        place, drift = spread / total, both / total
        off = there[0] - self._place[0], there[1] - self._place[1]
        x, y, _ = Pose2(*off, 0.0).since(Pose2(0.0, 0.0, self._situation.odom.yaw))
        self._place = self._place[0] + place * off[0], self._place[1] + place * off[1]
        self._error = self._error[0] + drift * x, self._error[1] + drift * y
        self._spread, self._both = (1 - place) * spread, (1 - place) * both
        self._drifting = drifting - drift * both

    def pose(self) -> Pose2 | None:
        """The cage in `base_link` now; None while it is not known."""
        if not self.known:
            return None
        self._roll()
        return self._there().since(self._situation.odom)
