"""How velocity is spread over the directions during a movement: which way it went, and whether it went to and fro or round."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.shake.ground import Motion

__all__ = ["Spread", "along", "principal"]

STEPS = 6
"""Of the power iteration: enough for what is four times as long as wide."""


def principal(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> tuple[float, Motion]:
    """Largest eigenvalue of a covariance, and the direction that belongs to it, of length 1."""
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    way = rows[max(range(3), key=lambda i: rows[i][i])]
    length = 1.0
    for _ in range(STEPS):
        x, y, z = (row[0] * way[0] + row[1] * way[1] + row[2] * way[2] for row in rows)
        length = math.sqrt(x * x + y * y + z * z) or 1.0
        way = (x / length, y / length, z / length)
    return length, way


def along(products: Sequence[float], way: Motion) -> float:
    """That of a direction of length 1, in their unit, from sums of products xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = products
    x, y, z = way
    return x * x * xx + y * y * yy + z * z * zz + 2.0 * (x * y * xy + x * z * xz + y * z * yz)


class Spread:
    """Of the velocity over some time, as sums of its products [m²/s²·s]."""

    def __init__(self, sums: Sequence[float], seconds: float) -> None:
        """`sums` of xx, yy, zz, xy, xz, yz over `seconds`."""
        self._sums = xx, yy, zz, xy, xz, yz = tuple(sums)
        self._seconds = seconds
        self._total = xx + yy + zz
        length, self.way = principal(xx, yy, zz, xy, xz, yz)
        self.straight = length / self._total if self._total > 0.0 else 0.0
        """Share of the direction that has most of it, 1/3 to 1: 1 on a line, a half on a circle."""

    def along(self, way: Motion) -> float:
        """Speed along a direction of length 1 [m/s], root of the mean square; 0 where nothing was measured."""
        return math.sqrt(max(0.0, along(self._sums, way)) / self._seconds) if self._seconds > 0.0 else 0.0
