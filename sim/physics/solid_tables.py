"""Solids of one make as arrays, and where lines enter them, many pairs of a line and a solid at a time.

Vectors lie in the first axis and are multiplied term by term: a run is the same on every computer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Shape, Vec3, rotate

__all__ = ["Balls", "Boxes", "Cylinders", "Entries", "Hulls", "Pairs", "spread"]

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_TINY = 1e-200
"""Instead of nothing, where something is divided by."""
_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def spread(vectors: Floats, axes: Sequence[Vec3]) -> Floats:
    """How far each of the `vectors` goes along each of the `axes`: (axes, …) of (3, …)."""
    x, y, z = np.array(axes).T.reshape(3, len(axes), *(1,) * (vectors.ndim - 1))
    along: Floats = vectors[0] * x + vectors[1] * y + vectors[2] * z
    return along


@dataclass(frozen=True, slots=True)
class Pairs:
    """Lines in a plane, each with the solid that it may meet."""

    solids: Indices
    """Their columns in the table."""
    cosines: Floats
    """Of the lines' bearings."""
    sines: Floats

    def along(self, ahead: Floats, left: Floats) -> Floats:
        """How far each line goes along an axis of its solid, from how far the plane's own two do; shape (…, pairs)."""
        return ahead[..., self.solids] * self.cosines + left[..., self.solids] * self.sines


class Entries(Protocol):
    """Where lines enter their solids."""

    @property
    def parts(self) -> Floats:
        """Of each pair, as a part of the line's length; infinite where the line does not enter."""

    def facing(self, some: Indices) -> Floats:
        """How straight on those of `some` pairs enter: cosines of the angles to the surfaces' normals, times the lines' length [m]."""


@dataclass(frozen=True, slots=True)
class _FlatEntries:
    """Through flat sides."""

    parts: Floats
    along: Floats
    """How far each line goes along each side's normal [m]: (sides, pairs)."""
    behind: Floats
    """Where it gets behind the plane of each side; the last one is where it enters."""

    def facing(self, some: Indices) -> Floats:
        """As `Entries` has it."""
        side = self.behind[:, some].argmax(axis=0)
        facing: Floats = np.abs(self.along[side, some])
        return facing


@dataclass(frozen=True, slots=True)
class _RoundEntries:
    """Through the round side of a cylinder, or one of its ends."""

    parts: Floats
    round_: Floats
    """Where each line gets within the round side, if it does."""
    along: Floats
    """How far each line goes along the axes of its cylinder [m]: (3, pairs)."""
    away: Floats
    """To the cylinder's middle along them [m]."""
    radii: Floats

    def facing(self, some: Indices) -> Floats:
        """As `Entries` has it."""
        parts, (x, y, z) = self.parts[some], self.along[:, some]
        to_x, to_y = self.away[:2, some]
        inward = (to_x - x * parts) * x + (to_y - y * parts) * y
        facing: Floats = np.where(parts > self.round_[some], np.abs(z), np.abs(inward) / self.radii[some])
        return facing


@dataclass(frozen=True, slots=True)
class _BallEntries:
    """Into balls."""

    parts: Floats
    back: Floats
    """Along each line to the ball's middle, times the line's length [m2]."""
    square: float
    """Of the lines' length [m2]."""
    radii: Floats

    def facing(self, some: Indices) -> Floats:
        """As `Entries` has it."""
        facing: Floats = np.abs(self.back[some] - self.parts[some] * self.square) / self.radii[some]
        return facing


class Hulls:
    """Tapered solids: what lies behind all of some planes."""

    def __init__(self, planes: Floats, counts: Indices) -> None:
        """`planes` have an outward normal and how far they are from the origin along it [m]: (4, planes, solids).

        `counts` are how many a solid has; the rest repeat some of them.
        """
        self._planes, self._counts = planes, counts

    @classmethod
    def of(cls, shapes: Sequence[Shape]) -> Self:
        """These solids; one that is round tapers alike along both axes."""
        planes = [_planes(shape) for shape in shapes]
        counts = np.array([len(each) for each in planes])
        filled = [np.resize(each, (counts.max(), 4)) for each in planes]
        return cls(np.array(filled).transpose(2, 1, 0), counts)

    def only(self, some: Indices) -> Self:
        """Those in the columns `some`."""
        counts = self._counts[some]
        return type(self)(np.ascontiguousarray(self._planes[:, : counts.max(), some]), counts)

    def enter(self, origin: Vec3, axes: Sequence[Vec3], pairs: Pairs) -> Entries:
        """Where each line from `origin` enters its solid.

        `axes` are ahead and left in the lines' plane, as long as the lines [m].
        """
        ahead, left, here = spread(self._planes[:3], (*axes, origin))
        along = pairs.along(ahead, left)
        along[along == 0] = -_TINY
        parts = (self._planes[3] - here)[:, pairs.solids] / along
        inward = along < 0
        behind = np.where(inward, parts, -np.inf)
        leave = np.where(inward, np.inf, parts).min(axis=0)
        return _FlatEntries(_met(behind.max(axis=0), leave), along, behind)


class _Straight:
    """What is straight along three axes of its own."""

    def __init__(self, middles: Floats, frames: Floats, halves: Floats) -> None:
        """`middles` [m] and halves of the extents [m], (3, solids), and own axes, (3, axes, solids)."""
        self._middles, self._frames, self._halves = middles, frames, halves

    @classmethod
    def of(cls, shapes: Sequence[Shape]) -> Self:
        """These solids."""
        frames = np.array([[rotate(shape.rotation, axis) for axis in _AXES] for shape in shapes])
        middles, sizes = (
            np.array(each).T for each in zip(*((s.position, s.size) for s in shapes), strict=True)
        )
        return cls(middles, frames.transpose(2, 1, 0), sizes / 2)

    def only(self, some: Indices) -> Self:
        """Those in the columns `some`."""
        frames = np.ascontiguousarray(self._frames[..., some])
        return type(self)(self._middles[:, some], frames, self._halves[:, some])

    def _seen(self, origin: Vec3, axes: Sequence[Vec3]) -> tuple[Floats, Floats, Floats]:
        """Ahead, left and the way from `origin` to each, along its own axes: (3, solids) each."""
        ahead, left = spread(self._frames, axes)
        x, y, z = self._middles - np.array(origin)[:, None]
        return ahead, left, self._frames[0] * x + self._frames[1] * y + self._frames[2] * z


class Boxes(_Straight):
    """Straight boxes."""

    def enter(self, origin: Vec3, axes: Sequence[Vec3], pairs: Pairs) -> Entries:
        """As `Hulls` has it."""
        ahead, left, away = self._seen(origin, axes)
        along = pairs.along(ahead, left)
        along[along == 0] = _TINY
        low, high = ((away - self._halves)[:, pairs.solids], (away + self._halves)[:, pairs.solids]) / along
        behind = np.minimum(low, high)
        return _FlatEntries(_met(behind.max(axis=0), np.maximum(low, high).min(axis=0)), along, behind)


class Cylinders(_Straight):
    """Straight round cylinders."""

    def enter(self, origin: Vec3, axes: Sequence[Vec3], pairs: Pairs) -> Entries:
        """As `Hulls` has it."""
        ahead, left, away = self._seen(origin, axes)
        outside = away[0] * away[0] + away[1] * away[1] - self._halves[0] * self._halves[0]
        x, y, z = along = pairs.along(ahead, left)
        to_x, to_y, to_z = there = away[:, pairs.solids]
        enter, leave = _roots(to_x * x + to_y * y, x * x + y * y + _TINY, outside[pairs.solids])
        z[z == 0] = _TINY  # in `along`, too
        half = self._halves[2, pairs.solids]
        low, high = (to_z - half) / z, (to_z + half) / z
        parts = _met(np.maximum(enter, np.minimum(low, high)), np.minimum(leave, np.maximum(low, high)))
        return _RoundEntries(parts, enter, along, there, self._halves[0, pairs.solids])


class Balls:
    """Spheres."""

    def __init__(self, middles: Floats, squares: Floats) -> None:
        """`middles` [m], (3, solids), and the squares of the radii [m2]."""
        self._middles, self._squares = middles, squares

    @classmethod
    def of(cls, shapes: Sequence[Shape]) -> Self:
        """These solids."""
        squares = np.array([(shape.size[0] / 2) ** 2 for shape in shapes])
        return cls(np.array([shape.position for shape in shapes]).T, squares)

    def only(self, some: Indices) -> Self:
        """Those in the columns `some`."""
        return type(self)(self._middles[:, some], self._squares[some])

    def enter(self, origin: Vec3, axes: Sequence[Vec3], pairs: Pairs) -> Entries:
        """As `Hulls` has it."""
        there = self._middles - np.array(origin)[:, None]
        outside = there[0] * there[0] + there[1] * there[1] + there[2] * there[2] - self._squares
        back = pairs.along(*spread(there, axes))
        square = sum(part * part for part in axes[0])
        parts = _met(*_roots(back, square, outside[pairs.solids]))
        return _BallEntries(parts, back, square, np.sqrt(self._squares[pairs.solids]))


def _roots(back: Floats, square: Floats | float, outside: Floats) -> tuple[Floats, Floats]:
    """Where lines enter and leave something round; NaN of one that misses it."""
    inside = back * back - square * outside
    root = np.sqrt(np.where(inside < 0, np.nan, inside))
    return (back - root) / square, (back + root) / square


def _met(enter: Floats, leave: Floats) -> Floats:
    """Where each line enters; infinite for one that misses its solid or starts within it."""
    return np.where((enter <= leave) & (enter >= 0), enter, np.inf)


def _planes(shape: Shape) -> Floats:
    """Outward normals of the sides of a box or a tapered solid, and how far each is from the origin along it [m]: (sides, 4)."""
    corners = np.array(shape.corners())
    ring = len(corners) // 2
    below, above = corners[:ring], corners[ring:]
    sides = np.cross(np.roll(below, -1, axis=0) - below, above - below)
    up = np.array(rotate(shape.rotation, (0.0, 0.0, 1.0)))
    normals = np.vstack([sides, up, -up])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    points = np.vstack([below, above[:1], below[:1]])
    return np.column_stack([normals, (normals * points).sum(axis=1)])
