"""Spread of velocity over the directions of a movement: which way it went, and whether to and fro or round."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from app.inputs.motion.shake.gravity import Motion

__all__ = ["Spread", "Turning", "along", "principal"]

ITERATIONS = 6
"""Of the power iteration: enough for what is four times as long as wide."""
MIN_SHARE = 0.15
"""Share of the squared pace that forgetting leaves, however slow the movement."""


def principal(xx: float, yy: float, zz: float, xy: float, xz: float, yz: float) -> tuple[float, Motion]:
    """Largest eigenvalue of a covariance, and the direction that belongs to it, of length 1."""
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    way = rows[max(range(3), key=lambda i: rows[i][i])]
    length = 1.0
    for _ in range(ITERATIONS):
        x, y, z = (row[0] * way[0] + row[1] * way[1] + row[2] * way[2] for row in rows)
        length = math.sqrt(x * x + y * y + z * z) or 1.0
        way = (x / length, y / length, z / length)
    return length, way


def along(products: Sequence[float], way: Motion) -> float:
    """That of a direction of length 1, in their unit, from sums of products xx, yy, zz, xy, xz, yz."""
    xx, yy, zz, xy, xz, yz = products
    x, y, z = way
    return x * x * xx + y * y * yy + z * z * zz + 2.0 * (x * y * xy + x * z * xz + y * z * yz)


class Turning(NamedTuple):
    """What tells whether a movement goes round, besides its spread."""

    sums: Motion
    """Of the cross product of velocity and acceleration [m²/s³·s]."""
    power: float
    """Of the square of the acceleration [m²/s⁴·s]."""
    leak: float
    """Time constant with which the velocity was forgotten [s]."""


class Spread:
    """Of the velocity over some time, as sums of its products [m²/s²·s]."""

    def __init__(self, sums: Sequence[float], seconds: float, turning: Turning) -> None:
        """`sums` of xx, yy, zz, xy, xz, yz over `seconds`."""
        self._sums = xx, yy, zz, xy, xz, yz = tuple(sums)
        self._seconds = seconds
        self._total = xx + yy + zz
        length, self.way = principal(xx, yy, zz, xy, xz, yz)
        self.straight = length / self._total if self._total > 0.0 else 0.0
        """Share of the direction that has most of it, 1/3 to 1: 1 on a line, a half on a circle."""

        self.pace, self.round = _round(self._total, turning)
        """How quick it is [rad/s, 0 where nothing moved], and how much it goes round: 0 on a line, also on one that is bent
        to an arc and gone to and fro, 2 w / (1 + w²) on an ellipse w times as wide as long, 1 on a circle."""

    def along(self, way: Motion) -> float:
        """Speed along a direction of length 1 [m/s], root of the mean square; 0 where nothing was measured."""
        return math.sqrt(max(0.0, along(self._sums, way)) / self._seconds) if self._seconds > 0.0 else 0.0


def _round(total: float, turning: Turning) -> tuple[float, float]:
    """Of the sum of the squared velocity [m²/s²·s]: velocity turns by the pace in a circle, and by nothing in the mean where it swings."""
    if total <= 0.0:
        return 0.0, 0.0
    # a velocity that is forgotten is smaller than it was and turned ahead: the square of its own share is taken off
    square = turning.power / total
    pace = math.sqrt(max(square - 1.0 / turning.leak**2, MIN_SHARE * square, 1e-3))
    return pace, math.hypot(*turning.sums) / (total * pace)
