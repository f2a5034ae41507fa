"""Connected components of a mask, also over corners."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

__all__ = ["boxes"]

Box = tuple[slice, slice]
"""Rows and columns."""


def boxes(mask: NDArray[np.bool_]) -> Iterator[Box]:
    """The box round each patch, in the order of their first pixels, row by row."""
    rows, first, last = _runs(mask)
    if not len(rows):
        return
    patch = _joined(len(rows), *_touching(rows, first, last, mask.shape[1]))
    order = np.argsort(patch, kind="stable")
    starts = np.flatnonzero(np.diff(patch[order], prepend=-1))
    ends = np.append(starts[1:], len(order)) - 1
    left = np.minimum.reduceat(first[order], starts)
    right = np.maximum.reduceat(last[order], starts)
    # runs come row by row, and so they do in each patch
    for top, bottom, west, east in zip(rows[order[starts]], rows[order[ends]], left, right, strict=True):
        yield slice(int(top), int(bottom) + 1), slice(int(west), int(east))


def _runs(mask: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Row, first column and the column after the last of each run of pixels, row by row."""
    edges = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    rows, first = np.nonzero(edges == 1)
    _, last = np.nonzero(edges == -1)
    return rows, first, last


def _touching(
    rows: NDArray[np.intp], first: NDArray[np.intp], last: NDArray[np.intp], width: int
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of runs, one below the other, that touch."""
    pitch = width + 2
    below = (rows + 1) * pitch
    begin = np.searchsorted(rows * pitch + last, below + first, side="left")
    counts = np.maximum(np.searchsorted(rows * pitch + first, below + last, side="right") - begin, 0)
    upper = np.repeat(np.arange(len(rows)), counts)
    lower = np.arange(len(upper)) - np.repeat(np.cumsum(counts) - counts, counts) + np.repeat(begin, counts)
    return upper, lower


def _joined(count: int, upper: NDArray[np.intp], lower: NDArray[np.intp]) -> NDArray[np.intp]:
    """The first run of the patch of each of `count` runs."""
    patch = np.arange(count)
    while True:
        least = np.minimum(patch[upper], patch[lower])
        before = patch.copy()
        np.minimum.at(patch, before[upper], least)
        np.minimum.at(patch, before[lower], least)
        np.minimum.at(patch, upper, least)
        np.minimum.at(patch, lower, least)
        patch = patch[patch]
        if np.array_equal(patch, before):
            return patch
