"""Ink of a laser sweep: free space as a fan and a dot for each return, in vertices that are made once and then moved.

ink = SweepInk()
ink.put(measured, angles, at=(x, y), scale=50.0, reach=6.0, look=Look(...))
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from widgets.core.canvas_ink import Ink
from widgets.core.shapes import EDGES, FLOATS

__all__ = ["Look", "SweepInk"]

AHEAD = math.pi / 2
"""Where straight ahead is on the screen [rad]."""
MAX_BEAMS = 13_000
"""More have no room in a mesh of 16 bit indices; of a longer sweep every second, third … is drawn."""
_FAR, _FEATHER = 1e3, 1.0
"""As in `widgets.core.shapes`: the distance to an edge that is none, and how far a shape is drawn beyond its own edge [px]."""
_CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float32)
_QUAD = np.array([0, 1, 2, 2, 3, 0], np.int64)


@dataclass(frozen=True)
class Look:
    """Size and colours of what is drawn."""

    radius: float
    """Of a dot [px]."""
    free: Sequence[float]
    """Colour of free space."""
    levels: tuple[Sequence[float], Sequence[float], Sequence[float]]
    """Colours of returns that are too close, near, and farther."""
    bounds: tuple[float, float]
    """Up to where a return is too close, and up to where it is near [m]."""


class SweepInk(Ink):
    """A beam whose return is not known has neither dot nor free space: its corners fall together."""

    def __init__(self) -> None:
        super().__init__()
        self._made: tuple[object, ...] = ()
        self._units = np.zeros((0, 2))
        self._corners = _CORNERS
        self._vertices = np.zeros((0, FLOATS), np.float32)
        self._indices = np.zeros(0, np.uint16)
        self._colours = np.zeros((3, 4), np.float32)
        self._levels: NDArray[np.int8] | None = None

    def put(
        self,
        measured: NDArray[np.float64],
        angles: NDArray[np.float64],
        at: tuple[float, float],
        scale: float,
        reach: float,
        look: Look,
    ) -> None:
        """Draw a sweep instead of that before: ranges [m], NaN for not known, in directions [rad] from straight ahead.

        The robot is `at` [px], with so many pixels to a metre; free space ends at `reach` [m], and so do the dots.
        """
        step = -(-len(measured) // MAX_BEAMS) if len(measured) else 1
        measured, angles = measured[::step], angles[::step]
        count = len(measured)
        if not count:
            self._made = ()
            self._mesh.vertices, self._mesh.indices = np.zeros(FLOATS, np.float32), np.zeros(3, np.uint16)
            return
        key = (count, float(angles[0]), float(angles[-1]), look)
        if key != self._made:
            self._make(angles, look)
            self._made = key
        known = measured == measured  # noqa: PLR0124 - false for NaN alone
        ends = (
            np.fmin(measured, reach) * known
            if known.all()
            else np.where(known, np.fmin(measured, reach), 0.0)
        )
        rim = self._units * (ends * scale)[:, None]
        rim += at
        self._vertices[0, :2] = at
        self._vertices[1 : count + 1, :2] = rim
        dots = self._vertices[count + 1 :].reshape(count, 4, FLOATS)
        hit = known & (measured <= reach)
        places = rim[:, None, :] + self._corners
        if not hit.all():
            places[~hit] = rim[~hit][:, None, :]
        dots[:, :, :2] = places
        self._tint(dots, measured, look)
        self._mesh.vertices = self._vertices.ravel()

    def _tint(self, dots: NDArray[np.float32], measured: NDArray[np.float64], look: Look) -> None:
        close, near = look.bounds
        levels = (measured >= close).astype(np.int8)
        levels += measured >= near
        if self._levels is None or not np.array_equal(levels, self._levels):
            self._levels = levels
            dots[:, :, 8:] = self._colours[levels][:, None, :]

    def _make(self, angles: NDArray[np.float64], look: Look) -> None:
        """All that stays the same while the beams and their look do."""
        count = len(angles)
        self._units = np.stack([np.cos(angles + AHEAD), np.sin(angles + AHEAD)], axis=1)
        self._vertices = np.zeros((1 + 5 * count, FLOATS), np.float32)
        fan = self._vertices[: count + 1]
        fan[:, 2:6] = _FAR, _FAR, EDGES, _FAR
        fan[:, 8:] = look.free
        self._corners = _CORNERS * (look.radius + _FEATHER)
        dots = self._vertices[count + 1 :].reshape(count, 4, FLOATS)
        dots[:, :, 2:4] = self._corners
        dots[:, :, 5] = look.radius
        self._colours = np.array(look.levels, np.float32)
        self._levels = None
        order = np.arange(1, count + 1)
        if _goes_round(angles):
            order = np.append(order, 1)
        free = np.stack([np.zeros(len(order) - 1, np.int64), order[:-1], order[1:]], axis=1).ravel()
        quads = ((count + 1 + 4 * np.arange(count))[:, None] + _QUAD).ravel()
        self._mesh.indices = np.concatenate([free, quads]).astype(np.uint16)


def _goes_round(angles: NDArray[np.float64]) -> bool:
    """The last beam has the first for its neighbour."""
    if len(angles) < 3:
        return False
    return bool(math.tau - abs(angles[-1] - angles[0]) < 1.5 * abs(angles[1] - angles[0]))
