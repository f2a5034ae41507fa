"""Tracks of what is seen: the same thing keeps its number from picture to picture, also when it is hidden for a moment."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from robotside.perception.sighting import Sighting

__all__ = ["ObjectTracks", "Seen"]

HELD = 2.5
"""A thing that was not seen for longer than this gets a new number [s]."""
MAX_TRACKS = 64
"""That are followed at a time; of more the one that was not seen for longest is let go of."""
GATE = 0.5
"""A thing that stood still is looked for within this distance of its place [m]."""
FASTEST = 2.0
"""So fast people walk: so much farther from where it was a thing may be after a second [m/s]."""
MAX_GATE = 1.6
"""Farther than this from where it was expected it is another thing [m]."""
AGILITY = 0.35
"""Part of the difference between where a thing was expected and is seen that goes into its place; half as much into its speed."""
LEAST_OVERLAP = 0.25
"""Of two boxes in pictures, shared by what they cover together, that make them the same where no place is known."""
MEMORY = 10
"""Sightings by which the class of a thing is judged, so that one wrong look changes nothing."""

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Seen:
    """A sighting, and where in `map` that is."""

    sighting: Sighting
    place: Place | None = None
    """x and y [m]; None while the robot's own place, or the thing's, is not known."""


@dataclass
class _Track:
    number: int
    last: float
    sighting: Sighting
    place: Place | None
    speed: Place = (0.0, 0.0)
    kinds: list[tuple[str, float]] = field(default_factory=list)

    def expected(self, now: float) -> Place | None:
        """Where it is when it goes on as it did."""
        if self.place is None:
            return None
        after = now - self.last
        return (self.place[0] + self.speed[0] * after, self.place[1] + self.speed[1] * after)

    @property
    def kind(self) -> str:
        """The class that most of its last sightings had, by their scores."""
        votes: Counter[str] = Counter()
        for kind, score in self.kinds:
            votes[kind] += score  # type: ignore[assignment]  # a Counter adds up any numbers
        return votes.most_common(1)[0][0]


class ObjectTracks:
    """All things that are followed."""

    def __init__(self) -> None:
        self._tracks: list[_Track] = []
        self._count = 0

    def update(self, seen: Sequence[Seen], now: float) -> list[tuple[int, str]]:
        """Of each sighting of one picture, taken at `now` [s], the number of its track and the class of that.

        Numbers count from 1 and are never given twice.
        """
        self._tracks = [track for track in self._tracks if 0 <= now - track.last <= HELD]
        pairs = sorted(
            (cost, at, n)
            for n, track in enumerate(self._tracks)
            for at, one in enumerate(seen)
            if (cost := _cost(track, one, now)) < 1.0
        )
        chosen: dict[int, _Track] = {}
        taken: set[int] = set()
        for _, at, n in pairs:
            if at not in chosen and n not in taken:
                chosen[at] = self._tracks[n]
                taken.add(n)
        return [self._followed(chosen.get(at), one, now) for at, one in enumerate(seen)]

    def forget(self) -> None:
        """Drop all places: they were wrong. What is in sight keeps its numbers by the picture."""
        for track in self._tracks:
            track.place, track.speed = None, (0.0, 0.0)

    def _followed(self, track: _Track | None, one: Seen, now: float) -> tuple[int, str]:
        if track is None:
            self._count += 1
            track = _Track(self._count, now, one.sighting, one.place)
            self._tracks.append(track)
            self._tracks = sorted(self._tracks, key=lambda each: each.last)[-MAX_TRACKS:]
        else:
            _move(track, one.place, now)
        track.last, track.sighting = now, one.sighting
        track.kinds = [*track.kinds, (one.sighting.kind, one.sighting.score)][-MEMORY:]
        return track.number, track.kind


def _move(track: _Track, place: Place | None, now: float) -> None:
    expected, after = track.expected(now), now - track.last
    if expected is None or place is None:
        track.place = place if place is not None else track.place
        return
    off = (place[0] - expected[0], place[1] - expected[1])
    track.place = (expected[0] + AGILITY * off[0], expected[1] + AGILITY * off[1])
    if after > 0:
        gain = AGILITY / 2 / max(after, 0.2)
        x, y = track.speed[0] + gain * off[0], track.speed[1] + gain * off[1]
        quick = max(1.0, math.hypot(x, y) / FASTEST)
        track.speed = (x / quick, y / quick)


def _cost(track: _Track, one: Seen, now: float) -> float:
    """How ill the two fit, from 0; 1 and more for what is not the same thing."""
    strange = 0.0 if one.sighting.kind == track.kind else 0.4
    expected = track.expected(now)
    if expected is not None and one.place is not None:
        gate = min(GATE + FASTEST * (now - track.last), MAX_GATE)
        return math.dist(expected, one.place) / gate + strange
    overlap = _overlap(track.sighting, one.sighting)
    return (1.0 - overlap) / (1.0 - LEAST_OVERLAP) + strange if overlap > 0.0 else math.inf


def _overlap(one: Sighting, other: Sighting) -> float:
    """What both cover as a part of what they cover together."""
    wide = min(one.right, other.right) - max(one.left, other.left)
    high = min(one.bottom, other.bottom) - max(one.top, other.top)
    if wide <= 0.0 or high <= 0.0:
        return 0.0
    shared = wide * high
    return shared / (one.width * one.height + other.width * other.height - shared)
