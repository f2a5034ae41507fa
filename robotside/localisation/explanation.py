"""One look of the laser, and how well a place on the map explains it: by what its beams ended on, and by what they went through.

A beam that ends on a mapped surface speaks for a place. One that ends before it may have met what the map does not know, such as
a person: that speaks little against the place. One that went through a mapped wall speaks much against it, though
glass and a car that is gone do that too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points, Pose2
from robotside.localisation.field import Field

__all__ = ["Explanation", "Look", "explained"]

MAX_BEAMS = 72
"""Beams that are looked at: neighbours tell the same."""

SPACING = 0.25
"""Ends of beams nearer to each other than this count once [m], so that a near wall does not outvote all others."""

MAX_REACH = 15.0
"""Beams are followed so far [m]."""

STEP = 0.1
"""Between two places on a beam where it is looked for walls [m]."""

MARGIN = 0.35
"""A wall so near before the end of a beam is the one that it ended on, and one so near to its beginning the one that the robot stands at [m]."""

WALL_DEPTH = 2
"""Places in a row on a beam that must be full to be a wall, and no corner that is grazed."""

HIT_SPREAD = 0.12
"""Of the ends about the surfaces that they lie on [m]: the map's coarseness, and a pose that is not quite right."""

HIT_DISTANCE = 0.2
"""An end within this of a surface lies on it [m]."""

SHORT, THROUGH = -2.0, -3.5
"""What a beam that ends on nothing known, and one that went through a wall, adds to the logarithm of the likelihood; one on a surface adds 0."""

MIN_ENDS, MIN_SECTORS, SECTOR = 20, 3, math.tau / 12
"""A look tells a place only by so many ends, told apart, in so many sectors of that width [rad]: a handful fits in dozens of places."""

EVIDENCE = 0.15
"""Part of the beams that count as independent: neighbours err together."""


@dataclass(frozen=True, slots=True)
class Look:
    """What is kept of one sweep to compare places by."""

    ends: Points
    """Where beams ended on something, in `base_link`, shape (n, 2) [m]."""
    ahead: float = 0.0
    """How far ahead of the middle of `base_link` the laser is [m], where all beams begin."""

    @classmethod
    def of(cls, points: Points, ahead: float = 0.0) -> Look:
        """Of a sweep's `points` in `base_link`, of a laser so far `ahead` [m]."""
        near = points[np.hypot(points[:, 0] - ahead, points[:, 1]) < MAX_REACH]
        return cls(_thinned(near, MAX_BEAMS), ahead)

    @property
    def tells(self) -> bool:
        """It has ends enough, in directions enough, that a place which explains it may be believed for that."""
        if len(self.ends) < MIN_ENDS:
            return False
        bearing = np.arctan2(self.ends[:, 1], self.ends[:, 0] - self.ahead)
        return len(np.unique(np.floor(bearing / SECTOR))) >= MIN_SECTORS


@dataclass(frozen=True, slots=True)
class Explanation:
    """How well a place explains a look."""

    evidence: float
    """Logarithm of its likelihood, beside a place that explains every beam; 0 at most."""
    fit: float
    """Part of the ends that lie on surfaces, 0 to 1."""
    through: float
    """Part of all beams that went through walls, 0 to 1."""


def explained(field: Field, pose: Pose2, look: Look) -> Explanation:
    """How the map of `field` explains `look`, had it been taken at `pose`."""
    if not len(look.ends):
        return Explanation(-math.inf, 0.0, 1.0)
    placed = pose.apply(look.ends)
    off = np.abs(field.read(placed)[:, 0])
    through = _through(field, pose.then(Pose2(look.ahead, 0.0, 0.0)), placed)
    score = np.maximum(SHORT, -0.5 * (off / HIT_SPREAD) ** 2)
    score[through] = np.minimum(score[through], THROUGH)
    on = (off < HIT_DISTANCE) & ~through
    return Explanation(float(score.sum()) * EVIDENCE, float(on.mean()), float(through.mean()))


def _through(field: Field, pose: Pose2, ends: Points) -> NDArray[np.bool_]:
    """Which of the beams from the laser at `pose` to `ends`, in `map`, went through a wall."""
    along = ends - (pose.x, pose.y)
    reach = np.hypot(along[:, 0], along[:, 1])
    unit = along / np.maximum(reach, 1e-9)[:, None]
    steps = np.arange(STEP, min(MAX_REACH, float(reach.max())) + STEP, STEP)
    places = np.array([pose.x, pose.y]) + unit[:, None, :] * steps[None, :, None]
    full = field.full(places.reshape(-1, 2)).reshape(len(ends), len(steps))
    full &= (steps[None, :] > MARGIN) & (steps[None, :] < (reach - MARGIN)[:, None])
    deep = full[:, :-1] & full[:, 1:] if WALL_DEPTH == 2 else full
    return np.asarray(deep.any(axis=1))


def _thinned(points: Points, most: int) -> Points:
    """Points that are not too near to each other, `most` of them, spread evenly over the sweep."""
    if not len(points):
        return points
    cells = np.floor(points / SPACING).astype(np.int64)
    _, first = np.unique(cells[:, 0] * 100_003 + cells[:, 1], return_index=True)
    kept = np.sort(first)
    if len(kept) > most:
        kept = kept[np.linspace(0, len(kept) - 1, most).astype(np.intp)]
    return np.asarray(points[kept])
