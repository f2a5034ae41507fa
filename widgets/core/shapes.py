"""Discs, rings, lines, dashes and triangles as vertices for one mesh. No Kivy in here; `widgets.core.canvas_ink` draws them.

Every vertex has twelve floats: place (2), local place (2), form (4) and colour (4). The form tells the
shader which distance to the shape's edge to compute, so that edges are smooth at any size without
multisampling. All lengths are pixels.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from widgets.core.geometry import Points

__all__ = ["FLOATS", "Shapes"]

FLOATS = 12
"""Floats to a vertex."""

LINE, EDGES, SECTOR = -1.0, -2.0, -3.0
"""Values of form[0] for what is no ring; a ring has its radius there, a disc has 0."""

_CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=np.float32)
_QUAD = np.array([0, 1, 2, 2, 3, 0], dtype=np.uint16)
RING_SIDES = 32
"""Corners of the rim that stands for a large ring: the shader makes it round."""
MIN_HOLLOW = 12.0
"""Within a ring less room is shaded with it [px]."""
_AROUND = np.stack(
    [
        np.cos(np.arange(RING_SIDES) * math.tau / RING_SIDES),
        np.sin(np.arange(RING_SIDES) * math.tau / RING_SIDES),
    ],
    axis=1,
)
_RIM = np.stack(
    [
        [
            side,
            side + RING_SIDES,
            (side + 1) % RING_SIDES + RING_SIDES,
            (side + 1) % RING_SIDES + RING_SIDES,
            (side + 1) % RING_SIDES,
            side,
        ]
        for side in range(RING_SIDES)
    ]
).ravel()
"""Of the rim's corners, first the inner and then the outer ones, those of its triangles."""
_DASH = 0.28
"""Half a dash of a ring, of the way from one to the next."""
_FEATHER = 1.0
_MITRE = 2.0
"""Longest mitre at a sharp corner, in half widths."""
_FAR = 1e3
"""Distance to an edge that is none [px]."""
_SAME = 1e-6
"""Points that are nearer to each other are one [px]."""
_STRAIGHT = np.array([0, 1, 3, 3, 2, 0], dtype=np.uint16)
_MOST = 65_535
"""Vertices that 16-bit indices can name."""

Colour = Sequence[float]


class Shapes:
    """A pile of shapes, later ones above earlier ones. Methods with `centres` draw many at once.

    What does not fit into 65,535 vertices any more is left out.
    """

    def __init__(self) -> None:
        self._vertices: list[NDArray[np.float32]] = []
        self._indices: list[NDArray[np.uint16]] = []
        self._count = 0

    def arrays(self) -> tuple[NDArray[np.float32], NDArray[np.uint16]]:
        """Flat vertices and indices of everything put in so far."""
        if not self._vertices:
            return np.zeros(0, np.float32), np.zeros(0, np.uint16)
        return np.concatenate(self._vertices).reshape(-1), np.concatenate(self._indices)

    def discs(self, centres: Points, radius: float, colour: Colour | NDArray[np.float32]) -> None:
        """Filled circles; `colour` may be one, or one for each of them, shape (n, 4)."""
        self._rounds(centres, 0.0, radius, colour)

    def disc(self, x: float, y: float, radius: float, colour: Colour) -> None:
        """One filled circle."""
        self._rounds(np.array([[x, y]]), 0.0, radius, colour)

    def ring(
        self, x: float, y: float, radius: float, width: float, colour: Colour, *, dashes: int = 0
    ) -> None:
        """A circle `width` wide, in `dashes` dashes when that is not 0."""
        period = math.tau * radius / dashes if dashes else 0.0
        hollow = radius - width / 2 - _FEATHER
        if hollow < MIN_HOLLOW:
            self._rounds(np.array([[x, y]]), radius, width / 2, colour, period)
            return
        # of a large one only the rim is shaded: within it and beyond its corners there is nothing to see
        reach = (radius + width / 2 + _FEATHER) / math.cos(math.pi / RING_SIDES)
        local = np.concatenate([_AROUND * hollow, _AROUND * reach])
        vertices = np.zeros((2 * RING_SIDES, FLOATS), np.float32)
        vertices[:, :2] = local + np.array([x, y])
        vertices[:, 2:4] = local
        vertices[:, 4:8] = radius, width / 2, period, period * _DASH
        vertices[:, 8:] = colour
        self._add(vertices, _RIM)

    def line(self, points: Points, width: float, colour: Colour | NDArray[np.float32]) -> None:
        """A line through `points`; `colour` may be one, or one for each point, shape (n, 4)."""
        if len(points) == 2 and not isinstance(colour, np.ndarray):
            self._straight(points.tolist(), width / 2, colour)
            return
        kept = _no_repeats(points)
        if len(kept) < 2:
            return
        points, colour = points[kept], _per_shape(colour)
        half = width / 2
        across = _mitres(points)
        vertices = np.zeros((len(points), 2, FLOATS), np.float32)
        for side, sign in enumerate((-1.0, 1.0)):
            vertices[:, side, :2] = points + across * (sign * (half + _FEATHER))
            vertices[:, side, 3] = sign * (half + _FEATHER)
        vertices[:, :, 4:6] = LINE, half
        vertices[:, :, 8:] = colour[kept] if colour.ndim == 3 else colour
        starts = 2 * np.arange(len(points) - 1)[:, None]
        self._add(vertices.reshape(-1, FLOATS), (starts + np.array([0, 1, 3, 3, 2, 0])).ravel())

    def _straight(self, ends: Sequence[Sequence[float]], half: float, colour: Colour) -> None:
        """A line without corners: plain arithmetic is a tenth of what so short arrays cost."""
        (x, y), (end_x, end_y) = ends
        if max(abs(end_x - x), abs(end_y - y)) <= _SAME:
            return
        reach = half + _FEATHER
        share = reach / math.hypot(end_x - x, end_y - y)
        aside_x, aside_y = (y - end_y) * share, (end_x - x) * share
        rest = (LINE, half, 0.0, 0.0, *colour)
        rows = [
            (x - aside_x, y - aside_y, 0.0, -reach, *rest),
            (x + aside_x, y + aside_y, 0.0, reach, *rest),
            (end_x - aside_x, end_y - aside_y, 0.0, -reach, *rest),
            (end_x + aside_x, end_y + aside_y, 0.0, reach, *rest),
        ]
        self._add(np.array(rows, np.float32), _STRAIGHT)

    def stamp(self, stamped: tuple[NDArray[np.float32], NDArray[np.uint16]], x: float, y: float) -> None:
        """What the `arrays` of other shapes hold, moved by (x, y): cheaper than to make the same shapes again."""
        vertices = stamped[0].reshape(-1, FLOATS).copy()
        vertices[:, 0] += x
        vertices[:, 1] += y
        self._add(vertices, stamped[1])

    def dashes(self, points: Points, width: float, colour: Colour, *, period: float, dash: float) -> None:
        """A line through `points` in dashes with round ends, `dash` long between the ends, one each `period`."""
        kept = points[_no_repeats(points)]
        if len(kept) < 2:
            return
        vertices = _straights(kept[:-1], kept[1:], width / 2)
        length = np.hypot(*np.diff(kept, axis=0).T)
        done = np.concatenate([[0.0], np.cumsum(length)])
        vertices[:, :, 2] = np.stack([done[:-1], done[1:], done[1:], done[:-1]], axis=1)
        vertices[:, :, 4:8] = LINE, width / 2, period, dash / 2
        vertices[:, :, 8:] = colour
        self._quads(vertices)

    def segments(
        self, starts: Points, ends: Points, width: float, colour: Colour | NDArray[np.float32]
    ) -> None:
        """Separate straight lines with square ends."""
        if not len(starts):
            return
        vertices = _straights(starts, ends, width / 2)
        vertices[:, :, 4:6] = LINE, width / 2
        vertices[:, :, 8:] = _per_shape(colour)
        self._quads(vertices)

    def sector(
        self, x: float, y: float, radius: float, *, yaw: float, half_angle: float, colour: Colour
    ) -> None:
        """A slice of a disc to `half_angle` (below pi / 2) [rad] on both sides of the direction `yaw` [rad]; nothing for what is no angle."""
        if not (math.isfinite(half_angle) and math.isfinite(yaw)):
            return
        reach, narrow = radius + _FEATHER, math.sin(half_angle)
        behind, aside = min(reach, _FEATHER / max(narrow, 1e-9)), reach * narrow + _FEATHER
        local = np.array([[-behind, -aside], [reach, -aside], [reach, aside], [-behind, aside]])
        turned = local @ np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
        vertices = np.zeros((1, 4, FLOATS), np.float32)
        vertices[0, :, :2] = turned + np.array([x, y])
        vertices[0, :, 2:4] = local
        vertices[0, :, 4:8] = SECTOR, radius, narrow, math.cos(half_angle)
        vertices[0, :, 8:] = colour
        self._quads(vertices)

    def fan(self, x: float, y: float, rim: Points, joined: NDArray[np.bool_], colour: Colour) -> None:
        """Triangles from (x, y) to each two neighbours of `rim` that are `joined`, shape (n - 1,); edges not smooth."""
        vertices = np.zeros((len(rim) + 1, FLOATS), np.float32)
        vertices[0, :2] = x, y
        vertices[1:, :2] = rim
        vertices[:, 2:6] = _FAR, _FAR, EDGES, _FAR
        vertices[:, 8:] = colour
        first = np.flatnonzero(joined) + 1
        self._add(vertices, np.stack([np.zeros_like(first), first, first + 1], axis=1).ravel())

    def polygon(self, points: Sequence[tuple[float, float]], colour: Colour) -> None:
        """A filled shape that can be seen whole from its first corner; corners in order."""
        corners = [(float(x), float(y)) for x, y in points]
        last = len(corners) - 2
        rows: list[list[float]] = []
        for index in range(1, last + 1):
            inner = (False, index != last, index != 1)
            rows += _triangle((corners[0], corners[index], corners[index + 1]), inner, colour)
        self._add(np.array(rows, np.float32).reshape(-1, FLOATS), np.arange(len(rows)))

    def _rounds(
        self,
        centres: Points,
        radius: float,
        half: float,
        colour: Colour | NDArray[np.float32],
        period: float = 0.0,
    ) -> None:
        reach = radius + half + _FEATHER
        vertices = np.zeros((len(centres), 4, FLOATS), np.float32)
        vertices[:, :, :2] = centres[:, None, :] + _CORNERS * reach
        vertices[:, :, 2:4] = _CORNERS * reach
        vertices[:, :, 4:8] = radius, half, period, period * _DASH
        vertices[:, :, 8:] = _per_shape(colour)
        self._quads(vertices)

    def _quads(self, vertices: NDArray[np.float32]) -> None:
        starts = 4 * np.arange(len(vertices))[:, None]
        self._add(vertices.reshape(-1, FLOATS), (starts + _QUAD).ravel())

    def _add(self, vertices: NDArray[np.float32], indices: NDArray[np.int64] | NDArray[np.uint16]) -> None:
        if not len(vertices) or self._count + len(vertices) > _MOST:
            return
        self._vertices.append(vertices)
        self._indices.append((indices + self._count).astype(np.uint16))
        self._count += len(vertices)


def _triangle(
    corners: Sequence[tuple[float, float]], inner: tuple[bool, bool, bool], colour: Colour
) -> list[list[float]]:
    """Vertices of one triangle; `inner` says which edges, each by the corner across from it, are no edges of the whole shape."""
    (ax, ay), (bx, by), (cx, cy) = corners
    area = abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay))
    edges = math.hypot(cx - bx, cy - by), math.hypot(ax - cx, ay - cy), math.hypot(bx - ax, by - ay)
    heights = [area / max(edge, 1e-9) for edge in edges]
    rows = []
    for number, (x, y) in enumerate(corners):
        away = [
            _FAR if hidden else heights[number] if edge == number else 0.0
            for edge, hidden in enumerate(inner)
        ]
        rows.append([x, y, away[0], away[1], EDGES, away[2], 0.0, 0.0, *colour])
    return rows


def _per_shape(colour: Colour | NDArray[np.float32]) -> NDArray[np.float32]:
    array = np.asarray(colour, dtype=np.float32)
    return array[:, None, :] if array.ndim == 2 else array


def _no_repeats(points: Points) -> NDArray[np.int64]:
    """Indices of the points that are not where the one before them is."""
    if len(points) < 2:
        return np.arange(len(points))
    moved = np.abs(np.diff(points, axis=0)).max(axis=1) > _SAME
    return np.flatnonzero(np.concatenate([[True], moved]))


def _straights(starts: Points, ends: Points, half: float) -> NDArray[np.float32]:
    """Corners of straight lines, with their distance across filled in."""
    ahead = ends - starts
    length = np.maximum(np.hypot(ahead[:, 0], ahead[:, 1]), 1e-9)
    normal = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) / length[:, None] * (half + _FEATHER)
    vertices = np.zeros((len(starts), 4, FLOATS), np.float32)
    for corner, (end, sign) in enumerate(((starts, -1), (ends, -1), (ends, 1), (starts, 1))):
        vertices[:, corner, :2] = end + normal * sign
        vertices[:, corner, 3] = sign * (half + _FEATHER)
    return vertices


def _mitres(points: Points) -> Points:
    """The normal at each point of a line, long enough for the corner there."""
    ahead = np.diff(points, axis=0)
    length = np.hypot(ahead[:, 0], ahead[:, 1])
    normals = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) / length[:, None]
    before = np.concatenate([normals[:1], normals])
    after = np.concatenate([normals, normals[-1:]])
    middle = before + after
    squared = np.maximum((middle**2).sum(axis=1), 1e-9)
    return np.asarray(middle * np.minimum(2.0 / squared, _MITRE / np.sqrt(squared))[:, None])
