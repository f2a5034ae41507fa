"""The robot's own map, as this handheld judges places by it beforehand: walls, what the map does not know, and ways.

The robot judges by itself; this says in its words what it is going to say (`robotside/navigation/planner.py`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bridge.msgs.nav_msgs import OccupancyGrid
from widgets.core.language import figure, tr
from widgets.core.quantities import said

__all__ = ["CLEARANCE", "Fault", "Ground"]

OCCUPIED_FROM = 50
"""Cells of at least this value are occupied, of 0 to 100; those below 0 are not known and no place to stand either."""
MIN_CELL = 0.1
"""Least width of a cell that is judged by [m]: a finer map is looked at in blocks."""
CLEARANCE = 0.05
"""Kept in a gap on the way, where a robot's limits say no other figure [m]."""
MARGIN = 0.03
"""More than that is kept at a place [m]."""
ESCAPE_DISTANCE = 0.6
"""A robot that stands too close to something finds its way out within this distance [m]."""
MIN_RESOLUTION = 1e-4
"""Of a map that is judged by [m]; what tells less tells nonsense."""
MAX_YAW = 1e-3
"""A map that is turned by more against its own frame is not judged by [rad]."""
MAX_JUDGED = 5000
"""Blocks whose judgement is kept."""
UNKNOWN, SOLID = -2.0, -1.0
"""In the place of the room at a block where the map knows nothing, and at one with an obstacle."""
MAX_WAY_CELLS = 600_000
"""On a larger map nothing is said about ways: looking for them would stop the glass."""

Mask = NDArray[np.bool_]
Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Fault:
    """Why a robot would not go to a place."""

    sentence: str
    """As the robot says it."""
    brief: str
    """The same beside a mark on the map."""


class Ground:
    """One map and the room that one robot needs on it."""

    def __init__(self, grid: OccupancyGrid, radius: float, clearance: float = CLEARANCE) -> None:
        """`radius` is that of the robot's body, `clearance` what it keeps on its way [m]."""
        info = grid.info
        self._cells = np.frombuffer(grid.data, np.int8).reshape(info.height, info.width)
        self._block = max(1, math.floor(MIN_CELL / info.resolution + 1e-6))
        self._edge = info.resolution * self._block
        """Of a block [m]."""
        self._left, self._low = info.origin.position.x, info.origin.position.y
        self._need, self._tight = radius + clearance + MARGIN, radius + clearance
        rows, columns = self._cells.shape
        self._shape = -(-rows // self._block), -(-columns // self._block)
        self._rooms: dict[tuple[int, int], float] = {}
        """What was found at blocks that were asked of: a mission is judged each time that it is drawn."""

    @classmethod
    def of(cls, grid: OccupancyGrid | None, radius: float, clearance: float = CLEARANCE) -> Ground | None:
        """None where there is no map that places can be judged by; lengths as in the constructor."""
        if grid is None:
            return None
        info = grid.info
        place = info.origin.position
        finite = (
            math.isfinite(place.x) and math.isfinite(place.y) and MIN_RESOLUTION <= info.resolution < math.inf
        )
        usable = finite and info.width * info.height == len(grid.data) > 0
        straight = abs(info.origin.orientation.yaw) <= MAX_YAW
        return cls(grid, radius, clearance) if usable and straight else None

    def fault(self, name: str, x: float, y: float, robot: tuple[float, float] | None) -> Fault | None:
        """Why the robot would not go to (x, y) in `map` [m], called `name`; None when it would.

        `robot` is where it is [m]; None while it is not known, when nothing is said about ways.
        """
        where = tr("{name} at ({x}, {y})").format(name=name, x=figure(x, 1), y=figure(y, 1))
        row, column = self._block_at(x, y)
        if not (0 <= row < self._shape[0] and 0 <= column < self._shape[1]):
            return Fault(tr("{where} is off the map.").format(where=where), tr("off the map"))
        room = self._rooms.get((row, column))
        if room is None:
            if len(self._rooms) >= MAX_JUDGED:
                self._rooms.clear()
            room = self._rooms[row, column] = self._room(row, column)
        if room == UNKNOWN:
            return Fault(tr("{where} is where the map knows nothing.").format(where=where), tr("not known"))
        if room == SOLID:
            return Fault(tr("{where} is in a wall or another obstacle.").format(where=where), tr("in a wall"))
        if room < self._need:
            free, need = said(room, "height", 2).words, said(self._need, "height", 2).words
            words = tr("{where} is {room} from an obstacle; the robot needs {need}.")
            return Fault(words.format(where=where, room=free, need=need), tr("{room} free").format(room=free))
        if robot is not None and self._cut_off(row, column, robot):
            return Fault(tr("There is no way to {where}.").format(where=where), tr("no way there"))
        return None

    def _block_at(self, x: float, y: float) -> tuple[int, int]:
        if not (math.isfinite(x) and math.isfinite(y)):
            return -1, -1
        return math.floor((y - self._low) / self._edge), math.floor((x - self._left) / self._edge)

    def _piece(self, row: int, column: int, reach: int = 0) -> NDArray[np.int8]:
        """The cells of the blocks up to `reach` round one."""
        first, left = max(0, row - reach) * self._block, max(0, column - reach) * self._block
        end, right = (row + reach + 1) * self._block, (column + reach + 1) * self._block
        return self._cells[first:end, left:right]

    def _room(self, row: int, column: int) -> float:
        """From the middle of a block to the nearest surface [m], infinite where that is farther than is needed; else `UNKNOWN` or `SOLID`."""
        here = self._piece(row, column)
        if _no_place(here).any():
            return SOLID if (here >= OCCUPIED_FROM).any() else UNKNOWN
        reach = math.ceil(self._need / self._edge) + 1
        bad = _in_blocks(_no_place(self._piece(row, column, reach)), self._block)
        rows, columns = np.nonzero(bad)
        if not len(rows):
            return math.inf
        here_row, here_column = min(row, reach), min(column, reach)
        nearest = np.hypot(rows - here_row, columns - here_column).min()
        return float(nearest - 0.5) * self._edge

    # ways

    def _cut_off(self, row: int, column: int, robot: tuple[float, float]) -> bool:
        """No way leads there from where the robot is; False where that is not known."""
        patches = self._patches
        here_row, here_column = self._block_at(*robot)
        if patches is None or not (0 <= here_row < patches.shape[0] and 0 <= here_column < patches.shape[1]):
            return False
        reach = math.ceil(ESCAPE_DISTANCE / self._edge)
        near = patches[
            max(0, here_row - reach) : here_row + reach + 1,
            max(0, here_column - reach) : here_column + reach + 1,
        ]
        here = patches[here_row, here_column]
        mine = {int(here)} if here >= 0 else set(near[near >= 0].tolist())
        return bool(mine) and int(patches[row, column]) not in mine

    @cached_property
    def _patches(self) -> Indices | None:
        """The number of the patch of ground that each block belongs to, -1 where the robot cannot be; None for a map too large.

        A wall stands somewhere in its block, and the middle of a gap beside the middle of one: what may be wide enough is no fault.
        """
        if self._shape[0] * self._shape[1] > MAX_WAY_CELLS:
            return None
        bad = _in_blocks(_no_place(self._cells), self._block)
        return _numbered(~_widened(bad, max(self._tight / self._edge - 0.5, 0.5)))


def _no_place(cells: NDArray[np.int8]) -> Mask:
    return np.logical_or(cells >= OCCUPIED_FROM, cells < 0)


def _in_blocks(mask: Mask, block: int) -> Mask:
    """Blocks of which any cell is set."""
    if block == 1:
        return mask
    rows, columns = mask.shape
    padded = np.pad(mask, ((0, -rows % block), (0, -columns % block)))
    return np.asarray(
        padded.reshape(padded.shape[0] // block, block, padded.shape[1] // block, block).any(axis=(1, 3))
    )


def _widened(mask: Mask, reach: float) -> Mask:
    """All that is nearer than `reach` [cells] to what is set."""
    rows, columns = mask.shape
    counts = np.zeros((rows, columns + 1), np.int32)
    np.cumsum(mask, axis=1, out=counts[:, 1:])
    places, wide = np.arange(columns), mask.copy()
    for up in range(math.ceil(reach)):
        across = math.ceil(math.sqrt(reach * reach - up * up)) - 1
        if across < 0:
            break
        end, begin = np.minimum(places + across + 1, columns), np.maximum(places - across, 0)
        row_by_row = counts[:, end] > counts[:, begin]
        wide[up:] |= row_by_row[: rows - up]
        wide[: rows - up] |= row_by_row[up:]
    return wide


def _numbered(free: Mask) -> Indices:
    """The number of its patch for each cell that is free, -1 for the others; patches that meet at a corner are one."""
    rows, columns = free.shape
    edges = np.diff(np.pad(free, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    row, first = np.nonzero(edges == 1)
    _, last = np.nonzero(edges == -1)  # after the run
    numbers = np.full((rows, columns), -1, np.intp)
    if not len(row):
        return numbers
    patch = _joined(len(row), *_touching(row, first, last, columns))
    numbers[free] = np.repeat(patch, last - first)
    return numbers


def _touching(row: Indices, first: Indices, last: Indices, columns: int) -> tuple[Indices, Indices]:
    """Pairs of runs that touch, the upper of one row and the lower of the next."""
    pitch = columns + 2
    begins, ends = row * pitch + first, row * pitch + last
    low = np.searchsorted(ends, begins + pitch, side="left")  # ends at its corner or after it
    high = np.searchsorted(begins, ends + pitch, side="right")
    found = np.maximum(high - low, 0)
    one = np.repeat(np.arange(len(row)), found)
    other = np.arange(len(one)) - np.repeat(np.cumsum(found) - found, found) + np.repeat(low, found)
    return one, other


def _joined(count: int, one: Indices, other: Indices) -> Indices:
    """The least run that each run hangs together with."""
    patch = np.arange(count)
    while True:
        least = np.minimum(patch[one], patch[other])
        after = patch.copy()
        np.minimum.at(after, patch[one], least)
        np.minimum.at(after, patch[other], least)
        after = np.minimum(after, after[after])
        if np.array_equal(after, patch):
            return patch
        patch = after
