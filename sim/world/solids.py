"""The unit solids as triangles, and shapes as rows of numbers that stretch and place them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sim.core.meshes import is_mesh, triangles
from sim.core.shapes import Shape, Vec3

__all__ = ["FLOATS", "KINDS", "mesh", "rows"]

KINDS = ("box", "cylinder", "sphere", "leaves")
"""Of plain shapes; others show a surface of their own."""
FLOATS = 17
"""Numbers in a shape's row: position 3, rotation 4, size 3, taper 2, tint 3, gloss and glow."""

Triangle = tuple[tuple[Vec3, Vec3], ...]
"""Three corners, each with its normal."""


def rows(shapes: Iterable[Shape]) -> NDArray[np.float32]:
    """Each shape as `FLOATS` numbers: (n, 17)."""
    table = [(*s.position, *s.rotation, *s.size, *s.taper, *s.colour, s.gloss, s.glow) for s in shapes]
    return np.array(table, dtype=np.float32).reshape(-1, FLOATS)


def mesh(kind: str) -> tuple[bytes, bytes]:
    """The unit solid: its corners (float32 position in [-0.5, 0.5] and normal), and three indices (int32) a triangle.

    Leaves have in place of the normal their place in a picture: once round and from bottom to top, 0 to 1.
    """
    if is_mesh(kind):
        return _own_surface(kind)
    faces = {"box": _box, "cylinder": _cylinder, "sphere": _sphere, "leaves": _leaves}[kind]()
    every = np.array([(*corner, *normal) for face in faces for corner, normal in face], dtype=np.float32)
    corners, order = np.unique(every.round(6), axis=0, return_inverse=True)
    return corners.tobytes(), order.astype(np.int32).tobytes()


def _own_surface(kind: str) -> tuple[bytes, bytes]:
    """Each triangle with corners of its own, flat: what has to be seen well is made of many."""
    corners = triangles(kind)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 0, normals / np.maximum(lengths, 1e-12), (0.0, 0.0, 1.0))
    both = np.concatenate((corners, np.repeat(normals[:, None, :], 3, axis=1)), axis=2)
    return both.astype(np.float32).tobytes(), np.arange(3 * len(corners), dtype=np.int32).tobytes()


def _quad(a: Vec3, b: Vec3, c: Vec3, d: Vec3, normals: tuple[Vec3, Vec3, Vec3, Vec3]) -> Iterator[Triangle]:
    na, nb, nc, nd = normals
    yield (a, na), (b, nb), (c, nc)
    yield (a, na), (c, nc), (d, nd)


def _box() -> Iterator[Triangle]:
    for axis in range(3):
        for sign in (-1.0, 1.0):
            corners = []
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                point = [0.0, 0.0, 0.0]
                point[axis] = sign / 2
                point[(axis + 1) % 3], point[(axis + 2) % 3] = u * sign / 2, v / 2
                corners.append((point[0], point[1], point[2]))
            normal = tuple(sign if i == axis else 0.0 for i in range(3))
            yield from _quad(*corners, (normal,) * 4)  # type: ignore[arg-type,call-arg]  # four of each by the loops


def _ring(facets: int) -> list[tuple[float, float]]:
    return [(math.cos(math.tau * i / facets), math.sin(math.tau * i / facets)) for i in range(facets + 1)]


def _cylinder(facets: int = 18) -> Iterator[Triangle]:
    ring = _ring(facets)
    for (x, y), (u, v) in pairwise(ring):
        low, next_low = (x / 2, y / 2, -0.5), (u / 2, v / 2, -0.5)
        high, next_high = (x / 2, y / 2, 0.5), (u / 2, v / 2, 0.5)
        here, there = (x, y, 0.0), (u, v, 0.0)
        yield from _quad(low, next_low, next_high, high, (here, there, there, here))
        up, down = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
        yield ((0.0, 0.0, 0.5), up), (high, up), (next_high, up)
        yield ((0.0, 0.0, -0.5), down), (next_low, down), (low, down)


def _sphere(facets: int = 18) -> Iterator[Triangle]:
    bands = facets // 2
    grid = []
    for j in range(bands + 1):
        height, radius = -math.cos(math.pi * j / bands), math.sin(math.pi * j / bands)
        grid.append([(x * radius, y * radius, height) for x, y in _ring(facets)])
    for below, above in pairwise(grid):
        for i in range(facets):
            normals = (below[i], below[i + 1], above[i + 1], above[i])
            a, b, c, d = ((n[0] / 2, n[1] / 2, n[2] / 2) for n in normals)
            yield from _quad(a, b, c, d, normals)


def _leaves(facets: int = 12) -> Iterator[Triangle]:
    """A sphere."""
    bands = facets // 2
    ring = _ring(facets)

    def corner(i: int, j: int) -> tuple[Vec3, Vec3]:
        height, radius = -math.cos(math.pi * j / bands) / 2, math.sin(math.pi * j / bands) / 2
        x, y = ring[i]
        return (x * radius, y * radius, height), (i / facets, j / bands, 0.0)

    for j in range(bands):
        for i in range(facets):
            a, b, c, d = corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)
            yield a, b, c
            yield a, c, d
