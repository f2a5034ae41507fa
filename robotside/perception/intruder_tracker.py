"""The tracker of intruders: each counts once, however often it is seen."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field

from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Intruder
from bridge.msgs.std_msgs import Time

__all__ = ["MIN_DOUBTFUL_SIGHTINGS", "MIN_SIGHTINGS", "SURE_SCORE", "IntruderTracker"]

SAME_DISTANCE = 1.2
"""Sightings of one class within this distance are of the same thing [m]."""

MIN_SIGHTINGS, MIN_DOUBTFUL_SIGHTINGS = 3, 8
"""Sightings before something is reported, and before what looks too little like its class is: a shadow passes for less."""

SURE_SCORE = 0.6
"""A thing that looks less like its class than this, 0 to 1, is an intruder of no known class."""

FORGET_AFTER = 20.0
"""A thing not yet reported is forgotten when it was not seen for this long [s]."""

MAX_INTRUDERS = 200
"""That are known at a time; of more the one that was not seen for longest is let go of."""


@dataclass
class _Suspect:
    x: float
    y: float
    weight: float
    first: float
    last: float
    score: float = 1.0
    """Of its class, the mean of all sightings."""
    kinds: Counter[str] = field(default_factory=Counter)
    track: int = 0
    """The track that it was seen on last; 0 for none."""
    sightings: int = 1
    number: int = 0
    """The intruder's id; 0 while it is not reported."""

    @property
    def kind(self) -> str:
        return self.kinds.most_common(1)[0][0]

    @property
    def sure(self) -> bool:
        """It looks like its class."""
        return self.score >= SURE_SCORE

    @property
    def proven(self) -> bool:
        """It was seen often enough to be reported."""
        return self.sightings >= (MIN_SIGHTINGS if self.sure else MIN_DOUBTFUL_SIGHTINGS)

    def fits(self, x: float, y: float, kind: str, track: int) -> bool:
        """A sighting there is of it."""
        if track and track == self.track:
            return True
        return kind == self.kind and math.hypot(x - self.x, y - self.y) <= SAME_DISTANCE


class IntruderTracker:
    """Gathers sightings in `map` into intruders."""

    def __init__(self) -> None:
        self._suspects: list[_Suspect] = []
        self._count = 0

    @property
    def known(self) -> list[Intruder]:
        """All that were reported, in order."""
        reported = [suspect for suspect in self._suspects if suspect.number]
        return [_intruder(suspect) for suspect in sorted(reported, key=lambda suspect: suspect.number)]

    def update(
        self,
        x: float,
        y: float,
        distance: float,
        now: float,
        score: float = 1.0,
        kind: str = "cone",
        track: int = 0,
    ) -> Intruder | None:
        """Take in one sighting at (x, y) [m], from `distance` [m]; the intruder when it has just become one.

        `score` says how sure the detector is that it is of that kind, 0 to 1. What has moved on is known by its `track`.
        """
        self._suspects = [s for s in self._suspects if s.number or now - s.last < FORGET_AFTER]
        near = [suspect for suspect in self._suspects if suspect.fits(x, y, kind, track)]
        suspect = min(
            near,
            key=lambda s: (not track or s.track != track, math.hypot(x - s.x, y - s.y)),
            default=None,
        )
        weight = 1.0 / max(distance, 0.5) ** 2
        if suspect is None:
            fresh = _Suspect(x, y, weight, now, now, score, Counter([kind]), track)
            self._suspects = sorted([*self._suspects, fresh], key=lambda s: s.last)[-MAX_INTRUDERS:]
            return None
        suspect.score += (score - suspect.score) / (suspect.sightings + 1)
        suspect.kinds[kind] += 1
        suspect.track = track
        _add(suspect, x, y, weight, now)
        if suspect.number or not suspect.proven:
            return None
        self._count += 1
        suspect.number = self._count
        return _intruder(suspect)

    def forget(self) -> None:
        """Drop what was not reported yet: the position was wrong."""
        self._suspects = [suspect for suspect in self._suspects if suspect.number]


def _add(suspect: _Suspect, x: float, y: float, weight: float, now: float) -> None:
    if math.hypot(x - suspect.x, y - suspect.y) > SAME_DISTANCE:
        suspect.x, suspect.y, suspect.weight = x, y, 0.0  # it has gone elsewhere
    total = suspect.weight + weight
    suspect.x += (x - suspect.x) * weight / total
    suspect.y += (y - suspect.y) * weight / total
    suspect.weight, suspect.last = total, now
    suspect.sightings += 1


def _intruder(suspect: _Suspect) -> Intruder:
    place = Point(suspect.x, suspect.y, 0.0)
    kind = suspect.kind if suspect.sure else "unknown"
    return Intruder(suspect.number, kind, place, Time.at(suspect.first), suspect.sightings)
