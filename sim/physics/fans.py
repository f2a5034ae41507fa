"""Fans of beams, as a laser sends them out, and where they meet the fixed solids of a world.

A physics engine looks through the whole world anew for each beam. Here each solid tells which beams of a fan can meet it at all, by
the bearings that it spans; only these pairs are computed, exactly and all at once. What moves is left to the engine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.core.shapes import Quat, Shape, Vec3, place, rotate
from sim.physics.echoes import GROUND, reflection, strengths
from sim.physics.solid_tables import Balls, Boxes, Cylinders, Entries, Hulls, Pairs, spread

__all__ = ["Echoes", "Fan", "FixedSolids"]

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_ROUNDING = 1e-6
"""Part of the angle between two beams by which a solid seems broader than it is, so that none on its edge is missed."""
_ROOM = 1.0
"""A body may move so far until what is round it is gathered anew [m]."""
_Make = type[Boxes] | type[Hulls] | type[Cylinders] | type[Balls]
_MAKES: tuple[_Make, ...] = (Boxes, Hulls, Cylinders, Balls)
_TURNS = np.array([-math.tau, 0.0, math.tau])


@dataclass(frozen=True, slots=True)
class Fan:
    """Beams from one point of a body in a plane, in a frame of axes like the body's."""

    start: Vec3
    """From the centre of mass [m]."""
    first: float
    """Bearing of the first beam, anticlockwise from ahead [rad]."""
    step: float
    """From beam to beam [rad]."""
    count: int
    reach: float
    """Of each beam [m]."""
    cosines: Floats = field(init=False, repr=False, compare=False)
    """Of all bearings."""
    sines: Floats = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Turn the bearings into directions, once."""
        bearings = [self.first + self.step * number for number in range(self.count)]
        object.__setattr__(self, "cosines", np.array([math.cos(each) for each in bearings]))
        object.__setattr__(self, "sines", np.array([math.sin(each) for each in bearings]))

    def within(self, bearings: Floats, half: Floats) -> tuple[Indices, Indices]:
        """The first beam within `half` of each of the `bearings` [rad], and how many there are; all for a half of a quarter turn.

        Shape (bearings, 3): what is round straight back comes in two parts, each with a turn more or less.
        """
        whole = half >= math.pi / 2
        middle = ((bearings - self.first)[:, None] + _TURNS) / self.step
        aside = (half / self.step + _ROUNDING)[:, None]
        first = np.ceil(middle - aside).clip(0, self.count)
        counts = (np.floor(middle + aside).clip(-1, self.count - 1) - first + 1).clip(0)
        first[whole], counts[whole] = 0, (0, self.count, 0)
        return first.astype(np.intp), counts.astype(np.intp)

    def end(self, number: int) -> Vec3:
        """Where the beam of this `number` ends."""
        x, y, z = self.start
        return x + self.reach * float(self.cosines[number]), y + self.reach * float(self.sines[number]), z

    def towards(self, place: Vec3, radius: float) -> list[int]:
        """Numbers of the beams that pass a `place` [m] within `radius` [m], and perhaps of some more."""
        x, y, z = (there - here for there, here in zip(place, self.start, strict=True))
        away = math.hypot(x, y)
        if abs(z) > radius or away > self.reach + radius:
            return []
        if away <= radius:
            return list(range(self.count))
        first, counts = self.within(np.array([math.atan2(y, x)]), np.array([math.asin(radius / away)]))
        return [
            low + more
            for low, count in zip(first[0].tolist(), counts[0].tolist(), strict=True)
            for more in range(count)
        ]


@dataclass(frozen=True, slots=True)
class _Placed:
    """A fan in the world."""

    fan: Fan
    origin: Vec3
    axes: tuple[Vec3, Vec3]
    """Ahead and to the left, each as long as the beams [m]."""

    @classmethod
    def at(cls, fan: Fan, position: Vec3, rotation: Quat) -> _Placed:
        axes = rotate(rotation, (fan.reach, 0.0, 0.0)), rotate(rotation, (0.0, fan.reach, 0.0))
        return cls(fan, place(fan.start, position, rotation), axes)


class Echoes(NamedTuple):
    """What comes back of the beams of a fan."""

    reach: Floats
    """Of each, as a part of its length; 1 where it meets nothing."""
    facing: Floats
    """How straight on each meets what it meets: the cosine of the angle to the surface's normal; 0 where it meets nothing."""
    reflection: Floats
    """Of what each meets, as `reflection` has it; 0 for nothing."""

    @property
    def strength(self) -> Floats:
        """Of each echo, 0 to 255 in whole numbers; 0 where there is none."""
        return strengths(self.reflection, self.facing)


class _Round(NamedTuple):
    """The solids of one make that some beams may meet."""

    reflections: Floats
    """Of each solid."""
    solids: Indices
    """Of each pair of a beam and a solid."""
    beams: Indices
    entries: Entries


class FixedSolids:
    """The ground and the solids of one world that nothing moves."""

    def __init__(self) -> None:
        """An empty world."""
        self._floor = -math.inf
        self._shapes: list[Shape] = []
        self._solids: _Solids | None = None
        self._near: _Surroundings | None = None

    def add_ground(self, height: float) -> None:
        """Level ground at z = `height` [m]."""
        self._floor = height

    def add(self, shapes: Sequence[Shape]) -> None:
        """Solids, placed in the world."""
        self._shapes += shapes
        self._solids = self._near = None

    def sweep(self, fan: Fan, position: Vec3, rotation: Quat) -> Echoes:
        """The echoes of a `fan` on a body with its centre of mass at `position`.

        A beam that starts within a solid looks through it, and one that starts below the ground through that.
        """
        placed = _Placed.at(fan, position, rotation)
        echoes = Echoes(np.ones(fan.count), np.zeros(fan.count), np.zeros(fan.count))
        self._meet_ground(placed, echoes)
        if self._near is None or not self._near.suits(placed):
            self._solids = self._solids or _Solids(self._shapes)
            self._near = _Surroundings(self._solids, placed)
        self._near.meet(placed, echoes)
        return echoes

    def _meet_ground(self, placed: _Placed, echoes: Echoes) -> None:
        height = placed.origin[2] - self._floor
        ahead, left = placed.axes[0][2], placed.axes[1][2]
        if height <= 0 or height > math.hypot(ahead, left):
            return
        sinks = -(ahead * placed.fan.cosines + left * placed.fan.sines)
        meets = sinks >= height
        echoes.reach[meets] = np.minimum(echoes.reach[meets], height / sinks[meets])
        facing = sinks[meets] / placed.fan.reach
        echoes.facing[meets], echoes.reflection[meets] = facing, GROUND


class _Solids:
    """All solids of a world as arrays, those of one make together."""

    def __init__(self, shapes: Sequence[Shape]) -> None:
        made = {make: [shape for shape in shapes if _make_of(shape) is make] for make in _MAKES}
        self.tables = [make.of(group) for make, group in made.items() if group]
        self.ends = np.cumsum([len(group) for group in made.values() if group])
        ordered = [shape for group in made.values() for shape in group]
        self.middles = np.array([shape.position for shape in ordered]).reshape(-1, 3).T
        self.radii = np.array([shape.radius for shape in ordered])
        self.reflections = np.array([reflection(shape) for shape in ordered])
        boxes = [Shape("box", shape.size, shape.position, shape.rotation).corners() for shape in ordered]
        self.corners = np.array(boxes).reshape(-1, 8, 3).transpose(2, 1, 0)


class _Surroundings:
    """The solids that can be met from a place and from all round it."""

    def __init__(self, solids: _Solids, placed: _Placed) -> None:
        self._middle, self._reach = placed.origin, placed.fan.reach
        apart = solids.middles - np.array(placed.origin)[:, None]
        far = self._reach + _ROOM + solids.radii
        near = np.flatnonzero((apart * apart).sum(axis=0) <= far * far)
        self._corners = np.ascontiguousarray(solids.corners[:, :, near])
        ends = np.searchsorted(near, solids.ends).tolist()
        self._tables, self._sizes, self._reflections = [], [], []
        for table, base, start, end in zip(solids.tables, (0, *solids.ends), (0, *ends), ends, strict=False):
            if end > start:
                self._tables.append(table.only(near[start:end] - base))
                self._sizes.append(end - start)
                self._reflections.append(solids.reflections[near[start:end]])

    def suits(self, placed: _Placed) -> bool:
        """They are all that a fan can meet."""
        return placed.fan.reach <= self._reach and math.dist(placed.origin, self._middle) <= _ROOM

    def meet(self, placed: _Placed, echoes: Echoes) -> None:
        """Shorten the reach of `echoes` to the solids that the beams meet, and say how strongly these answer."""
        reach = echoes.reach
        rounds = list(self._rounds(placed))
        for each in rounds:
            np.minimum.at(reach, each.beams, each.entries.parts)
        for reflections, solids, beams, entries in rounds:
            first = np.flatnonzero(entries.parts == reach[beams])
            met = beams[first]
            echoes.facing[met] = entries.facing(first) / placed.fan.reach
            echoes.reflection[met] = reflections[solids[first]]

    def _rounds(self, placed: _Placed) -> Iterator[_Round]:
        if not self._tables:
            return
        fan = placed.fan
        first, counts = fan.within(*self._spans(placed))
        of_each = counts.sum(axis=1)
        counts = counts.ravel()
        beams = np.arange(counts.sum()) + np.repeat(first.ravel() - counts.cumsum() + counts, counts)
        cosines, sines = fan.cosines[beams], fan.sines[beams]
        low = row = 0
        for table, size, shine in zip(self._tables, self._sizes, self._reflections, strict=True):
            own = of_each[row : row + size]
            row, high = row + size, low + int(own.sum())
            if high > low:
                pairs = Pairs(np.repeat(np.arange(size), own), cosines[low:high], sines[low:high])
                entries = table.enter(placed.origin, placed.axes, pairs)
                yield _Round(shine, pairs.solids, beams[low:high], entries)
            low = high

    def _spans(self, placed: _Placed) -> tuple[Floats, Floats]:
        """The bearing of the middle of what each solid spans, and half of that [rad]; of one that is all round, more than a quarter turn."""
        there = self._corners - np.array(placed.origin)[:, None, None]
        ahead, left = spread(there, placed.axes)
        bearings = np.arctan2(left, ahead)
        aside = bearings - bearings[0]
        aside -= math.tau * np.round(aside / math.tau)
        low, high = aside.min(axis=0), aside.max(axis=0)
        return bearings[0] + (low + high) / 2, (high - low) / 2


def _make_of(shape: Shape) -> _Make:
    if shape.kind == "sphere":
        return Balls
    if shape.is_tapered:
        return Hulls
    return Cylinders if shape.kind == "cylinder" else Boxes
