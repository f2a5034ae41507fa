"""The search of a whole map for places that fit one look of the laser, whatever the robot believes.

A sweep is laid on the map in every direction and at every place, in cells of 0.4 m first: a map is made for that in
which each cell has the best of what lies about it, so that a place is never passed over for being between two cells.
The best of these are looked at in the map's own cells, then by Gauss-Newton, and last by what their beams
would have gone through.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import wrap
from robotside.core.pose2 import Points, Pose2
from robotside.core.worker import Work
from robotside.localisation.explanation import Explanation, Look, explained
from robotside.localisation.field import Field
from robotside.localisation.scan_matching import Localiser

__all__ = ["Found", "differ", "search"]

COARSE = 0.4
"""Width of the first cells [m]."""

YAW_STEP = math.tau / 120
"""Between two directions of the first search [rad]."""

NEAR = 0.2
"""Ends of beams count by how near to a surface they are; this is near [m]."""

MAX_COARSE = 1500
"""Places of the first search that are looked at again; of each direction a part."""

PER_DIRECTION = 40
"""Places kept of each direction."""

PER_STEP = 100
"""Places that one step looks at again."""

MAX_MODES = 24
"""Places that are told apart and matched."""

MAX_FOUND = 8
"""Places that are handed back."""

APART, TURNED = 0.6, 0.35
"""Two places at least so far apart [m], or turned by that against each other [rad], are two."""

MAX_CELLS = 400_000
"""Of the first search, in each direction; with more they become wider."""


@dataclass(frozen=True, slots=True)
class Found:
    """A place that fits."""

    pose: Pose2
    explanation: Explanation


def differ(one: Pose2, other: Pose2) -> bool:
    """They are two places, not one that is known a little better or worse."""
    return one.distance(other.x, other.y) > APART or abs(wrap(one.yaw - other.yaw)) > TURNED


def search(field: Field, look: Look) -> Work[list[Found]]:
    """The places on the map that explain `look`, the best first; step by step."""
    if not look.tells:
        return []
    sheet = _Sheet(field, look.ends)
    yield
    heap: list[NDArray[np.float64]] = []
    for yaw in np.arange(0.0, math.tau - 1e-9, YAW_STEP):
        heap.append(sheet.coarse(float(yaw)))
        yield
    rough = np.concatenate(heap)
    rough = rough[np.argsort(-rough[:, 0], kind="stable")[:MAX_COARSE]]
    fine = []
    for first in range(0, len(rough), PER_STEP):
        fine.append(sheet.fine(rough[first : first + PER_STEP]))
        yield
    found = []
    for pose in _modes(np.concatenate(fine)):
        found.append(matched(field, pose, look))
        yield
    found.sort(key=lambda each: -each.explanation.evidence)
    kept: list[Found] = []
    for each in found:
        if all(differ(each.pose, other.pose) for other in kept):
            kept.append(each)
    return kept[:MAX_FOUND]


def matched(field: Field, pose: Pose2, look: Look) -> Found:
    """The place at or beside `pose` that fits best."""
    trial = Localiser(field)
    trial.place(pose, spread=0.15, turn=0.05)
    for _ in range(2):
        trial.correct(look.ends)
    better = trial.pose or pose
    before, after = explained(field, pose, look), explained(field, better, look)
    return Found(better, after) if after.evidence >= before.evidence else Found(pose, before)


def _modes(rated: NDArray[np.float64]) -> list[Pose2]:
    """The best of the places, each far from those before it; rows are score, x, y, yaw."""
    modes: list[Pose2] = []
    for _, x, y, yaw in rated[np.argsort(-rated[:, 0], kind="stable")].tolist():
        pose = Pose2(x, y, wrap(yaw))
        if all(differ(pose, other) for other in modes):
            modes.append(pose)
            if len(modes) == MAX_MODES:
                break
    return modes


class _Sheet:
    """The map as it is searched, with a margin round it that no beam leaves."""

    def __init__(self, field: Field, ends: Points) -> None:
        grid = field.grid
        self._grid, self._ends = grid, ends
        stride = max(1, 2 ** round(math.log2(COARSE / grid.resolution)))
        rows, columns = grid.occupied.shape
        while (rows // stride) * (columns // stride) > MAX_CELLS:
            stride *= 2
        self._stride = stride
        self._pad = math.ceil(float(np.hypot(ends[:, 0], ends[:, 1]).max()) / grid.resolution) + 2 * stride
        near = np.exp(-0.5 * (field.distances / NEAR) ** 2) * 255.0
        self._near = np.pad(near.astype(np.uint8), self._pad)
        self._wide = _widened(self._near, stride)
        free = ~grid.occupied
        free = np.pad(free, ((0, -rows % stride), (0, -columns % stride)))
        self._shape = free.shape[0] // stride, free.shape[1] // stride
        blocks = free.reshape(self._shape[0], stride, self._shape[1], stride)
        self._free = np.asarray(blocks.any(axis=(1, 3)))

    def coarse(self, yaw: float) -> NDArray[np.float64]:
        """The best places of one direction; rows are score, row and column of the cell, yaw."""
        stride, (rows, columns) = self._stride, self._shape
        total = np.zeros(self._shape, dtype=np.uint16)
        for down, across in (self._cells(yaw) + self._pad).tolist():
            total += self._wide[
                down : down + rows * stride : stride, across : across + columns * stride : stride
            ]
        score = np.where(self._free, total, 0).ravel()
        most = min(PER_DIRECTION, score.size)
        best = np.argpartition(score, score.size - most)[score.size - most :]
        row, column = np.divmod(best, columns)
        return np.column_stack([score[best], row * stride, column * stride, np.full(most, yaw)])

    def fine(self, rough: NDArray[np.float64]) -> NDArray[np.float64]:
        """The best place in each of the cells `rough`; rows are score, x, y [m] and yaw [rad]."""
        stride, grid = self._stride, self._grid
        width = self._near.shape[1]
        step = np.arange(stride)
        inner = (step[:, None] * width + step[None, :]).ravel()
        flat = self._near.ravel()
        origin = (rough[:, 1].astype(np.intp) + self._pad) * width + rough[:, 2].astype(np.intp) + self._pad
        best = np.zeros((len(rough), 4))
        for turn in (-YAW_STEP / 3, 0.0, YAW_STEP / 3):
            for each, yaw in enumerate((rough[:, 3] + turn).tolist()):
                cells = self._cells(yaw)
                at = origin[each] + inner[:, None] + (cells[:, 0] * width + cells[:, 1])[None, :]
                score = flat[at].sum(axis=1, dtype=np.int64)
                top = int(score.argmax())
                if score[top] > best[each, 0]:
                    down, across = divmod(top, stride)
                    x = grid.x + (rough[each, 2] + across + 0.5) * grid.resolution
                    y = grid.y + (rough[each, 1] + down + 0.5) * grid.resolution
                    best[each] = float(score[top]), x, y, yaw
        return best

    def _cells(self, yaw: float) -> NDArray[np.intp]:
        """Where the beams end, turned by `yaw` and counted in cells from the robot's own, shape (n, 2): row, column."""
        turned = Pose2(0.0, 0.0, yaw).apply(self._ends) / self._grid.resolution
        return np.asarray(np.round(turned[:, ::-1]).astype(np.intp))


def _widened(near: NDArray[np.uint8], stride: int) -> NDArray[np.uint8]:
    """Of each cell the best of those from one before it to `stride` after it: a beam's end may come to lie on any of them."""
    wide = near
    for axis in (0, 1):
        best = wide
        for shift in range(-1, stride + 1):
            best = np.maximum(best, np.roll(wide, -shift, axis))
        wide = best
    return wide
