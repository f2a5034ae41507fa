"""Triangles as pieces of a part: a surface to look at, and boxes that stand in the way."""

from __future__ import annotations

import math

import numpy as np
import trimesh
from numpy.typing import NDArray

from sim.core.meshes import keep
from sim.core.shapes import Colour, Shape
from sim.parts.errors import PartError

__all__ = ["MAX_BOXES", "MAX_SIZE", "MIN_SIZE", "MAX_TRIANGLES", "MIN_CELL", "boxes", "check", "surface"]

MAX_TRIANGLES = 200_000
"""Of one part."""
MIN_SIZE, MAX_SIZE = 0.001, 300.0
"""Of one part, along its longest axis [m]."""
MAX_SURFACE_STEPS = 200_000
"""Squares of half a cell that the surface of one part may have, by its area; with more, the cells are made larger."""
MIN_CELL = 0.05
"""Edge of the cells that boxes are made of: so finely a surface is felt at best [m]."""
MAX_CELLS = 64
"""Along the longest side of a part; a longer one is felt more coarsely."""
MAX_BOXES = 300
"""Of one part; with more, the cells are made larger."""
_THINNEST = 1e-3
"""A flat surface counts as so thick [m]."""

Triangles = NDArray[np.floating]


def check(name: str, corners: Triangles) -> None:
    """PartError when these triangles, (n, 3, 3) [m], are none, too many, no numbers, too small or too large."""
    if not len(corners):
        raise PartError(f"{name} has no surface")
    if len(corners) > MAX_TRIANGLES:
        raise PartError(f"{name} has {len(corners)} triangles; at most {MAX_TRIANGLES} can be")
    if not np.isfinite(corners).all():
        raise PartError(f"{name} has a corner that is no number")
    longest = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
    if not MIN_SIZE <= longest <= MAX_SIZE:
        raise PartError(f"{name} is {longest:.4g} m long; {MIN_SIZE:g} to {MAX_SIZE:g} m can be")


def surface(corners: Triangles, colour: Colour) -> Shape:
    """The shape that shows these triangles, (n, 3, 3) [m], in one colour."""
    points = corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    size, middle = np.maximum(high - low, _THINNEST), (low + high) / 2
    unit = ((corners - middle) / size).astype(np.float32)
    return Shape(keep(unit), _three(size), _three(middle), colour=colour)


def boxes(corners: Triangles, colour: Colour) -> tuple[Shape, ...]:
    """Boxes that fill what the triangles, (n, 3, 3) [m], enclose, to half a cell."""
    longest = float(np.ptp(corners.reshape(-1, 3), axis=0).max())
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = float(np.linalg.norm(sides, axis=1).sum()) / 2
    # triangles may lie over each other as often as they like, and each is looked at in steps of half a cell
    cell = max(MIN_CELL, longest / MAX_CELLS, 2 * math.sqrt(area / MAX_SURFACE_STEPS))
    while True:
        low, full = _filled(corners, cell)
        found = _merged(full, MAX_BOXES)
        if found is not None:
            break
        cell *= 1.5
    return tuple(
        Shape("box", _three((end - start) * cell), _three(low + (start + end) / 2 * cell), colour=colour)
        for start, end in found
    )


def _filled(corners: Triangles, cell: float) -> tuple[Triangles, NDArray[np.bool_]]:
    """The lowest corner of the cells [m], and which of them the triangles touch or enclose."""
    vertices, _ = trimesh.remesh.subdivide_to_size(  # type: ignore[no-untyped-call]
        corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3), max_edge=cell / 2, max_iter=24
    )
    low = vertices.min(axis=0)
    places = np.floor((vertices - low) / cell + 1e-9).astype(np.int64)
    full = np.zeros(places.max(axis=0) + 1, dtype=np.bool_)
    full[tuple(places.T)] = True
    # what lies on the far face of the last cell is in that cell, not in one beyond it
    for axis in range(3):
        if full.shape[axis] > 1 and np.ptp(vertices[:, axis]) <= (full.shape[axis] - 1) * cell + 1e-9:
            first = full.take(range(full.shape[axis] - 1), axis=axis)
            first |= _back(full, axis)
            full = first
    return low, ~_outside(full)


def _back(full: NDArray[np.bool_], axis: int) -> NDArray[np.bool_]:
    """The last layer along `axis`, where it belongs: in the one before it."""
    last = np.zeros_like(full.take(range(full.shape[axis] - 1), axis=axis))
    at: list[int | slice] = [slice(None)] * 3
    at[axis] = -1
    last[tuple(at)] = full.take(-1, axis=axis)
    return last


def _outside(full: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The cells from which a way through empty ones leads out."""
    free = np.pad(~full, 1, constant_values=True)
    out = np.zeros_like(free)
    out[0, 0, 0] = True
    while True:
        grown = out.copy()
        for axis in range(3):
            for step in (1, -1):
                grown |= np.roll(out, step, axis=axis)
        grown &= free
        if np.array_equal(grown, out):
            return out[1:-1, 1:-1, 1:-1]
        out = grown


Box = tuple[NDArray[np.int64], NDArray[np.int64]]


def _merged(full: NDArray[np.bool_], most: int) -> list[Box] | None:
    """First and last corner of boxes that make up the `full` cells; None when `most` are not enough."""
    left, found = full.copy(), list[Box]()
    while left.any():
        if len(found) == most:
            return None
        start = np.array(np.unravel_index(int(left.argmax()), left.shape))
        end = start + 1
        for axis in (0, 1, 2):
            while end[axis] < left.shape[axis]:
                layer = [slice(a, b) for a, b in zip(start, end, strict=True)]
                layer[axis] = slice(end[axis], end[axis] + 1)
                if not left[tuple(layer)].all():
                    break
                end[axis] += 1
        left[tuple(slice(a, b) for a, b in zip(start, end, strict=True))] = False
        found.append((start, end))
    return found


def _three(values: Triangles) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    if not math.isfinite(x + y + z):
        raise PartError("a part has a corner that is no number")
    return x, y, z
