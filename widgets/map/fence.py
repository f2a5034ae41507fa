"""Where a robot may be, as its limits tell it: what to draw of that, and whether it would take a place. No Kivy in here.

The robot judges by itself (`/limits`, docs/bridge.md); this says beforehand, in its words, what it is going to say.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.pilothouse_msgs import Limits
from widgets.core.geometry import Points

__all__ = ["GOAL_ROOM", "Border", "Fence"]

GOAL_ROOM = 0.4
"""What a robot wants between its body and the fence at a place that it is sent to [m]."""
MOST_CORNERS = 2000
"""Of a fence that is drawn: one with more would take the glass longer than a finger waits."""
REMEMBERED = 1000
"""Places whose judgement is kept: a map asks for all of its marks each time it is drawn."""
ASIDE = 1e-6
"""How far beside an edge it is asked whether one may be there [m]."""
NONE = np.zeros((0, 2))


@dataclass(frozen=True, slots=True)
class Border:
    """Straight pieces, each with the side where the robot may be on its left."""

    starts: Points = field(default_factory=NONE.copy)
    """Shape (n, 2) [m]."""
    ends: Points = field(default_factory=NONE.copy)

    def distance(self, x: float, y: float) -> float:
        """From a place to the nearest piece [m]; infinite without one."""
        if not len(self.starts):
            return math.inf
        along, here = self.ends - self.starts, np.array([x, y]) - self.starts
        share = (here * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-18)
        return float(np.hypot(*(here - np.clip(share, 0.0, 1.0)[:, None] * along).T).min())


class Fence:
    """The areas of one robot in `map` [m]; areas of one kind that touch are one."""

    def __init__(self, keep_in: Sequence[Points] = (), keep_out: Sequence[Points] = ()) -> None:
        """Corners of each area, shape (n, 2) [m]; what is no area, or not finite, is left out."""
        self.keep_in, self.keep_out = _areas(keep_in), _areas(keep_out)
        corners = sum(map(len, (*self.keep_in, *self.keep_out)))
        self.too_large = corners > MOST_CORNERS
        """It has so many corners that nothing of it is drawn or looked at."""
        if self.too_large:
            self.keep_in, self.keep_out = [], []
        self.edge, self.holes = self._borders()
        self._judged: dict[tuple[float, float, float], bool] = {}

    edge: Border
    """Of what it stays in."""
    holes: Border
    """Of what it never enters."""

    @classmethod
    def of(cls, limits: Limits) -> Fence:
        """The fence that a robot tells."""
        keep_in, keep_out = (
            [np.array([[corner.x, corner.y] for corner in area.points], dtype=np.float64) for area in areas]
            for areas in (limits.keep_in, limits.keep_out)
        )
        return cls(keep_in, keep_out)

    def __bool__(self) -> bool:
        """There is a place where the robot may not be."""
        return bool(self.keep_in or self.keep_out)

    def allows(self, points: Points) -> NDArray[np.bool_]:
        """Whether the robot's centre may be at each of `points`, shape (n, 2)."""
        allowed = np.full(len(points), not self.keep_in)
        for area in self.keep_in:
            allowed |= _inside(area, points)
        for area in self.keep_out:
            allowed &= ~_inside(area, points)
        return allowed

    def forbids(self, x: float, y: float, radius: float) -> bool:
        """Whether a robot of `radius` [m] would not go to (x, y) [m]; asked again of the same place it costs nothing."""
        key = (x, y, radius)
        if key not in self._judged:
            if len(self._judged) >= REMEMBERED:
                self._judged.clear()
            self._judged[key] = bool(self.fault("It", x, y, radius))
        return self._judged[key]

    def fault(self, name: str, x: float, y: float, radius: float) -> str:
        """Why a robot of `radius` [m] would not go to a place that is called `name`, as one sentence; empty when it would."""
        if not self or not (math.isfinite(x) and math.isfinite(y)):
            return ""
        where, need = f"{name} at ({x:.1f}, {y:.1f})", radius + GOAL_ROOM
        if not self.allows(np.array([[x, y]]))[0]:
            return f"{where} is outside the robot's fence."
        room = min(self.edge.distance(x, y), self.holes.distance(x, y))
        if room < need:
            return f"{where} is {room:.2f} m from the robot's fence; the robot needs {need:.2f} m."
        return ""

    def _borders(self) -> tuple[Border, Border]:
        """The pieces of all edges that have the robot's ground on one side only, of what it stays in and of the rest."""
        areas = [*self.keep_in, *self.keep_out]
        if not areas:
            return Border(), Border()
        starts = np.concatenate(areas)
        ends = np.concatenate([np.roll(area, -1, axis=0) for area in areas])
        inner = np.repeat([True, False], [sum(map(len, self.keep_in)), sum(map(len, self.keep_out))])
        pieces = [_cut(start, end, starts, ends) for start, end in zip(starts, ends, strict=True)]
        first = np.concatenate([piece[:-1] for piece in pieces])
        last = np.concatenate([piece[1:] for piece in pieces])
        inner = np.repeat(inner, [len(piece) - 1 for piece in pieces])
        along = last - first
        left = np.stack([-along[:, 1], along[:, 0]], axis=1)
        left *= ASIDE / np.maximum(np.hypot(*along.T), 1e-12)[:, None]
        middle = (first + last) / 2
        here, there = self.allows(middle + left), self.allows(middle - left)
        turned = (there & ~here)[:, None]
        first, last = np.where(turned, last, first), np.where(turned, first, last)
        real = here != there
        return Border(first[real & inner], last[real & inner]), Border(
            first[real & ~inner], last[real & ~inner]
        )


def _areas(rings: Sequence[Points]) -> list[Points]:
    return [ring for ring in rings if ring.ndim == 2 and len(ring) >= 3 and np.isfinite(ring).all()]


def _inside(area: Points, points: Points) -> NDArray[np.bool_]:
    """Whether each point lies within `area`: a line to its right leaves it an odd number of times."""
    x, y = points[:, :1], points[:, 1:]
    (ax, ay), (bx, by) = area.T, np.roll(area, -1, axis=0).T
    spans = (ay > y) != (by > y)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        right = x < ax + (y - ay) * (bx - ax) / (by - ay)
    return np.asarray((spans & right).sum(axis=1) % 2 == 1)


def _cut(start: Points, end: Points, starts: Points, ends: Points) -> Points:
    """The corners of the pieces into which all edges cut the one from `start` to `end`."""
    along, others, apart = end - start, ends - starts, starts - start
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        cross = along[0] * others[:, 1] - along[1] * others[:, 0]
        here = (apart[:, 0] * others[:, 1] - apart[:, 1] * others[:, 0]) / cross
        there = (apart[:, 0] * along[1] - apart[:, 1] * along[0]) / cross
        meets = (here > 0) & (here < 1) & (there > -ASIDE) & (there < 1 + ASIDE)
    shares = np.unique(np.concatenate([[0.0, 1.0], here[meets]]))
    return np.asarray(start + shares[:, None] * along)
