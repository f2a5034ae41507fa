"""Surfaces of a thing's own, known to all that draw by the kind of the shape that shows them."""

from __future__ import annotations

import hashlib

import numpy as np
from numpy.typing import NDArray

__all__ = ["is_mesh", "keep", "triangles"]

_PREFIX = "mesh:"
_KEPT: dict[str, NDArray[np.float32]] = {}
"""By kind. What is in it is in a file that a world was made from, so it grows with the worlds of a process only."""


def is_mesh(kind: str) -> bool:
    """Whether a shape of this kind shows a surface of its own."""
    return kind.startswith(_PREFIX)


def keep(corners: NDArray[np.float32]) -> str:
    """The kind of the shapes that show these triangles: (n, 3, 3), within a cube of 1 round the origin, anticlockwise from outside.

    The same triangles have the same kind in every process.
    """
    kind = f"{_PREFIX}{hashlib.sha256(corners.tobytes()).hexdigest()[:16]}"
    _KEPT.setdefault(kind, corners)
    return kind


def triangles(kind: str) -> NDArray[np.float32]:
    """The triangles of that kind, (n, 3, 3); KeyError for one that was never kept."""
    return _KEPT[kind]
