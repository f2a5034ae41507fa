"""The lines that half cycles are counted along: the three directions, and those between, since few people shake exactly along one."""

from __future__ import annotations

import math
from dataclasses import dataclass

from app.inputs.motion.shake.gravity import Motion
from app.inputs.motion.shake.tuning import Tuning

__all__ = ["Line", "lines"]


@dataclass(frozen=True, slots=True)
class Line:
    """One of them."""

    way: Motion
    """Of length 1: right, up, forward."""
    threshold: float
    """A half cycle counts from here on [m/s²]."""
    gap: float
    """Two of them come no farther apart [s]."""
    counts_for: tuple[int, ...]
    """The directions that it is next to, which velocity tells apart. None is for STOP: bags swing aslant."""


def lines(tuning: Tuning) -> list[Line]:
    """The three first, in their order; between two of which neither is anybody's own there are two more."""
    ways = tuning.ways
    found = [Line(way.way, way.threshold, way.gap, (i,)) for i, way in enumerate(ways)]
    for i, j in ((0, 1), (0, 2), (1, 2)):
        one, other = ways[i], ways[j]
        if one.own or other.own:
            continue
        for sign in (1.0, -1.0):
            x, y, z = (math.sqrt(0.5) * (a + sign * b) for a, b in zip(one.way, other.way, strict=True))
            threshold, gap = tuning.aslant * max(one.threshold, other.threshold), max(one.gap, other.gap)
            found.append(Line((x, y, z), threshold, gap, (j,) if i == 0 else (i, j)))
    return found
