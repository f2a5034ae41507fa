"""Distances between cells and between points, for whole maps and sweeps at once.

In numpy alone: SciPy, which has the same, takes 40 MB for as long as the robot runs.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robotside.core.pose2 import Points

__all__ = ["distance_from", "within"]

_ROWS_PER_CHECK = 8
"""Rows after which it is looked what is still to do."""

_MAX_DISTANCE = 1 << 14
"""Distances end at this [cells]: its square is still a number of 32 bits, and so is the sum of two."""


def distance_from(full: NDArray[np.bool_], most: int = _MAX_DISTANCE) -> NDArray[np.float64]:
    """Of each cell's centre to the nearest one that is `full` [cells]; 16384 when none is nearer.

    Beyond `most` [cells] it may be too large, never too small: who needs no more has it far sooner.
    """
    along = _along_rows(full)
    squared = along.copy()
    step, rows, columns = 0, slice(0, full.shape[0]), slice(0, full.shape[1])
    while step < min(len(full) - 1, most, _MAX_DISTANCE - 1):
        if step % _ROWS_PER_CHECK == 0:
            # no row farther off can be nearer than what is found
            left = squared[rows, columns] > (step + 1) ** 2
            if not left.any():
                break
            rows, columns = _box(left, rows, columns)
        step += 1
        _lower(squared, along, rows, columns, step)
        _lower(squared, along, rows, columns, -step)
    return np.sqrt(squared, dtype=np.float64)


def _along_rows(full: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Squared, to the nearest full cell of the same row."""
    width = full.shape[1]
    places = np.arange(width, dtype=np.int32)
    none = np.int32(width + _MAX_DISTANCE)
    before = np.maximum.accumulate(np.where(full, places, -none), axis=1)
    after = np.minimum.accumulate(np.where(full, places, 2 * none)[:, ::-1], axis=1)[:, ::-1]
    nearest = np.minimum(places - before, after - places)
    return np.square(np.minimum(nearest, np.int32(_MAX_DISTANCE)))


def _box(left: NDArray[np.bool_], rows: slice, columns: slice) -> tuple[slice, slice]:
    """Round those that are left, of these rows and columns."""
    up, across = np.flatnonzero(left.any(axis=1)), np.flatnonzero(left.any(axis=0))
    return (
        slice(rows.start + int(up[0]), rows.start + int(up[-1]) + 1),
        slice(columns.start + int(across[0]), columns.start + int(across[-1]) + 1),
    )


def _lower(
    squared: NDArray[np.int32], along: NDArray[np.int32], rows: slice, columns: slice, step: int
) -> None:
    """Take the way by the row that is `step` rows on, where it is shorter."""
    first, last = max(rows.start, -step), min(rows.stop, len(squared) - step)
    if first < last:
        there = along[first + step : last + step, columns] + np.int32(step * step)
        here = squared[first:last, columns]
        np.minimum(here, there, out=here)


def within(points: Points, others: Points, reach: float) -> NDArray[np.bool_]:
    """Which of `points` have one of `others` nearer than `reach` [m]."""
    found = np.zeros(len(points), dtype=np.bool_)
    if not len(points) or not len(others):
        return found
    corner = np.minimum(points.min(axis=0), others.min(axis=0))
    cells = np.floor((others - corner) / reach).astype(np.int64)
    width = int(max(cells[:, 1].max(), np.floor((points[:, 1] - corner[1]).max() / reach))) + 3
    keys = cells[:, 0] * width + cells[:, 1] + 1
    order = np.argsort(keys, kind="stable")
    keys, others = keys[order], others[order]
    own = np.floor((points - corner) / reach).astype(np.int64)
    for beside in (-1, 0, 1):
        middle = (own[:, 0] + beside) * width + own[:, 1] + 1
        first = np.searchsorted(keys, middle - 1, side="left")
        counts = np.searchsorted(keys, middle + 1, side="right") - first
        who = np.repeat(np.arange(len(points)), counts)
        place = np.arange(len(who)) - np.repeat(np.cumsum(counts) - counts, counts) + np.repeat(first, counts)
        gap = points[who] - others[place]
        found[who[np.einsum("ij,ij->i", gap, gap) < reach * reach]] = True
    return found
