"""Narrow passages of a way: how wide each gap is, and where its middle is.

A map's cells tell a width only to a cell or two; here it is measured between what stands to either side.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points
from robotside.mapping.occupancy_grid import Grid

__all__ = ["Gap", "squeezed"]

POINTS_PER_STEP = 8
"""Points of a way that one step measures."""

MAX_SHIFT = 0.2
"""A point of a way is moved no farther than this towards the middle of its gap [m]."""

ACCURACY = 0.01
"""A gap counts as wide enough when this is missing [m]."""

OPPOSITE = -0.5
"""What stands on the other side lies at an angle of this cosine or less."""


@dataclass(frozen=True, slots=True)
class Gap:
    """A passage between two things."""

    x: float
    """Of its middle, in `map` [m]."""
    y: float
    width: float
    """Between the two things [m]."""
    needed: float
    """Of the robot and what it keeps to either side [m]."""

    def __str__(self) -> str:
        """As part of a sentence."""
        where = f"({self.x:.1f}, {self.y:.1f})"
        return f"the gap at {where} is {self.width:.2f} m wide and the robot needs {self.needed:.2f} m"


def squeezed(
    grid: Grid, path: Points, obstacles: Points, need: float, free: NDArray[np.bool_]
) -> Generator[None, None, tuple[Points, Gap | None]]:
    """`path` through the middle of its gaps, for who needs `need` [m] to each side; and the narrowest that is too narrow.

    A full cell of `grid` is taken for a thing in its middle, `obstacles` stand beside it. `free` are points that need no look.
    """
    moved, worst = path.copy(), None
    for first in range(0, len(path), POINTS_PER_STEP):
        which = np.arange(first, min(first + POINTS_PER_STEP, len(path)))
        which = which[~free[which]]
        if not len(which):
            continue
        yield
        things = _near(grid, path[which], obstacles, 2 * need + grid.resolution)
        for number in which.tolist():
            gap = _measured(path[number], things, need)
            if gap is None:
                continue
            moved[number], width, (x, y) = gap
            if width < 2 * need - ACCURACY and (worst is None or width < worst.width):
                worst = Gap(x, y, width, 2 * need)
    return moved, worst


def _near(grid: Grid, points: Points, obstacles: Points, reach: float) -> Points:
    """The middles of full cells, and the obstacles, in the box round `points` that reaches so far [m]."""
    low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
    (top, left), (bottom, right) = grid.cell(*low.tolist()), grid.cell(*high.tolist())
    top, left = max(top, 0), max(left, 0)
    rows, columns = np.nonzero(grid.occupied[top : bottom + 1, left : right + 1])
    x = grid.x + (columns + left + 0.5) * grid.resolution
    y = grid.y + (rows + top + 0.5) * grid.resolution
    there = ((obstacles >= low) & (obstacles <= high)).all(axis=1)
    return np.concatenate([np.column_stack([x, y]), obstacles[there]])


def _measured(point: Points, things: Points, need: float) -> tuple[Points, float, tuple[float, float]] | None:
    """`point` moved to the middle of its gap, the gap's width and its middle [m]; None where nothing is near on both sides."""
    if not len(things):
        return None
    ways = things - point
    far = np.hypot(ways[:, 0], ways[:, 1])
    one = int(far.argmin())
    if far[one] >= need or far[one] < 1e-6:
        return None
    towards = ways[one] / far[one]
    across = ways @ towards
    behind = np.flatnonzero(across < OPPOSITE * far)
    if not len(behind):
        return None
    other = behind[far[behind].argmin()]
    width = float(np.hypot(*(things[one] - things[other])))
    if width > 2 * need + MAX_SHIFT:
        return None
    middle = (things[one] + things[other]) / 2
    # across the gap only: along it the way stays as long as it was
    axis = (things[one] - things[other]) / max(width, 1e-6)
    by = float(np.clip((middle - point) @ axis, -MAX_SHIFT, MAX_SHIFT))
    return point + by * axis, width, (float(middle[0]), float(middle[1]))
