"""The beginning at a place: from where a robot is said to be to where its first sweep that tells enough fits best."""

from __future__ import annotations

import math

from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.pose2 import Points, Pose2
from robotside.localisation.beacons import Beacons
from robotside.localisation.explanation import Look
from robotside.localisation.first_guess import GUESS_REACH, GUESS_YAW, FirstGuess
from robotside.localisation.odometry_track import OdometryTrack
from robotside.localisation.position_uncertainty import PositionUncertainty
from robotside.localisation.scan_matching import Localiser
from robotside.localisation.whereabouts import Whereabouts, said_to_be
from robotside.records.events import Say

__all__ = ["PLACED_REACH", "Beginning"]

PLACED_REACH, PLACED_YAW = 1.0, 0.5
"""The largest error of a pose that an operator sets on the map [m, rad]."""


class Beginning:
    """Of a robot with a laser; times are of the robot's clock [s]."""

    def __init__(self, info: RobotInfo, say: Say, track: OdometryTrack, whereabouts: Whereabouts) -> None:
        """`track` forgets its way when the place becomes another one; `whereabouts` learns what is said of it."""
        self._track, self._whereabouts = track, whereabouts
        self.beacons = Beacons(info)
        self.first_guess = FirstGuess(self.beacons, say)
        self.uncertainty = PositionUncertainty()
        self.waits = False
        """No sweep has told enough yet: it is where it was said to be, as surely as that."""
        self._search: tuple[Pose2, float, float] | None = None

    def place(self, pose: Pose2, localiser: Localiser) -> None:
        """The operator says that the robot is at `pose`."""
        localiser.place(pose, spread=0.3, turn=0.2)
        self.uncertainty.settle()
        self._search, self.waits = (pose, PLACED_REACH, PLACED_YAW), False

    def on_sweep(self, localiser: Localiser, points: Points, look: Look, stamp: float) -> None:
        """A sweep was taken at `stamp`: `points` are its ends in `base_link`, and `look` is what is kept of them."""
        if self._search is None and localiser.pose is None:
            self._search = self.first_guess.to_search(stamp)
            if self._search is not None:
                self._whereabouts.placed(said_to_be(self._search[0], GUESS_REACH))
        if self._search is not None:
            self._begin(localiser, self._search, points, look)
        if not self.waits and localiser.pose is not None:
            self.uncertainty.on_walls_seen()

    def _begin(
        self, localiser: Localiser, guess: tuple[Pose2, float, float], points: Points, look: Look
    ) -> None:
        pose, reach, turn = guess
        if look.tells:
            begin = localiser.pose if self.waits and localiser.pose else pose
            self._search, self.waits = None, False
            localiser.search(points, begin, reach=reach, turn=turn)
            self._track.forget()  # else the way from the old belief to this one counts as driven since the sweep
            return
        late = self.beacons.guess if turn == math.pi else None
        if late is not None:  # the satellites came after it had supposed to be where its map begins
            self._search = pose, reach, turn = late, GUESS_REACH, GUESS_YAW
            self._whereabouts.placed(said_to_be(pose, reach))
        if late is not None or localiser.pose is None:
            spread = reach / 2 if turn < math.pi else localiser.field.reach / math.sqrt(12.0)
            localiser.place(pose, spread=spread, turn=turn / 2)
            self._track.forget()
        self.waits = True
        self.uncertainty.on_walls_gone()
