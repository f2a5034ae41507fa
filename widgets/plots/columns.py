"""One trace as quads for the graphics card, a column of pixels at a time: its least and greatest value, never fewer. No Kivy.

Quads hold times and values, not pixels: the shader scales them. So a new sample changes one column, and whatever scrolls
or is scaled anew changes nothing at all.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from widgets.plots.history import History

__all__ = ["FLOATS", "LINE", "NOTHING", "PIECE", "Columns", "empty_quads", "quad_indices"]

FLOATS = 7
"""Of a vertex: from (time, value), to (time, value), corner (2), kind."""
NOTHING, LINE = -1.0, 0.0
"""Kinds of quads; above 0 are marks."""
SPARE = 4
"""Columns beyond those in sight, for what comes in from beyond the edges."""
MAX_VALUE = 1e30
"""Greater ones are drawn here: the graphics card has 32 bits."""
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float32)
EMPTY = -(2**62)
"""Number of a column that there is not."""
PIECE = 48
"""Quads that go to the graphics card together: a new sample changes one or two of these pieces, not all that is seen."""
MARKS = 64
"""Marks that a trace has in sight at most."""

Quads = NDArray[np.float32]


def empty_quads(count: int) -> Quads:
    """So many quads that show nothing, shape (count, 4, FLOATS)."""
    quads = np.zeros((count, 4, FLOATS), np.float32)
    quads[:, :, 4:6] = CORNERS
    quads[:, :, 6] = NOTHING
    return quads


def quad_indices(count: int) -> NDArray[np.uint16]:
    """Two triangles for each of so many quads."""
    corners = 4 * np.arange(count)[:, None] + np.array([0, 1, 2, 2, 3, 0])
    return np.asarray(corners, np.uint16).ravel()


class Columns:
    """The quads of one trace: for each column of pixels a bar from its least to its greatest value, and a line to the next."""

    def __init__(self) -> None:
        self.count = 0
        """Columns that there is room for."""
        self.quads = empty_quads(1)
        """Bars, then the lines to them, then marks; a column's place is its number modulo `count`."""
        self.changed: set[int] = {0}
        """Which pieces of so many quads as `PIECE` are others than whoever draws them has seen; it takes out what it has."""
        self.gap = math.inf
        """Two samples farther apart [s] are not joined."""
        self._origin, self._base, self._wide = 0.0, 0.0, 1.0
        self._low, self._high = np.empty(0), np.empty(0)
        self._numbers = np.empty(0, np.int64)
        self._column = 0
        self._last: tuple[float, float] | None = None
        self._kind, self._every, self._phase = 0, 0.0, 0.0
        self._mark, self._next_mark = 0, math.inf
        self._broken = True
        """The newest sample told nothing: the next one is not joined to what was before."""

    def resize(self, columns: int) -> None:
        """Make room for so many columns in sight; empties all where that is a change."""
        count = columns + SPARE
        if count != self.count:
            self.count = count
            self.quads = empty_quads(2 * count + MARKS)
            self._low, self._high = np.zeros(count), np.zeros(count)
            self._numbers = np.full(count, EMPTY, np.int64)

    def mark(self, kind: int, every: float, phase: float) -> None:
        """Put a mark of `kind` on the line every so many seconds, `phase` [s] behind round times; 0 for none."""
        self._kind, self._every, self._phase = kind, every, phase

    def rebuild(
        self, history: History, left: float, right: float, *, origin: float, base: float, wide: float
    ) -> None:
        """Draw everything anew from `left` to `right` [s].

        Quads hold times from `origin` [s] and values from `base`; a column is `wide` [s], with its number counted from `origin`.
        """
        self._origin, self._base, self._wide = origin, base, wide
        self.quads[:, :, 6] = NOTHING
        self.changed = set(range(-(-len(self.quads) // PIECE)))
        self._numbers[:] = EMPTY
        self._last, self._mark, self._next_mark = None, 0, math.inf
        first, last = history.within(left, right)
        known = np.flatnonzero(np.isfinite(history.values[first:last]))
        if not len(known):
            self._broken = True
            return
        times = history.times[first:last][known]
        values = history.values[first:last][known]
        joined = np.zeros(len(known), np.bool_)
        joined[1:] = (np.diff(known) == 1) & (np.diff(times) <= self.gap)
        numbers = np.floor((times - origin) / wide).astype(np.int64)
        edge = math.floor((left - origin) / wide)
        np.clip(numbers, edge - 1, edge + self.count - 2, out=numbers)
        self._fill(times, values, joined, numbers)
        self._column = int(numbers[-1])
        self._last = (float(times[-1]), float(values[-1]))
        self._broken = bool(known[-1] != last - first - 1)
        self._mark_all(times, values)

    def _fill(
        self,
        times: NDArray[np.float64],
        values: NDArray[np.float64],
        joined: NDArray[np.bool_],
        numbers: NDArray[np.int64],
    ) -> None:
        starts = np.flatnonzero(np.diff(numbers, prepend=numbers[0] - 1))
        slots = numbers[starts] % self.count
        low, high = np.minimum.reduceat(values, starts), np.maximum.reduceat(values, starts)
        self._low[slots], self._high[slots], self._numbers[slots] = low, high, numbers[starts]
        begun = times[starts] - self._origin
        self._write(slots, begun, self._drawn(low), begun, self._drawn(high))
        lines = starts[joined[starts]]
        into = self.count + numbers[lines] % self.count
        self._write(
            into,
            times[lines - 1] - self._origin,
            self._drawn(values[lines - 1]),
            times[lines] - self._origin,
            self._drawn(values[lines]),
        )

    def _drawn(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.clip(values - self._base, -MAX_VALUE, MAX_VALUE)

    def _write(self, slots: NDArray[np.int64], *numbers: NDArray[np.float64], kind: float = LINE) -> None:
        for place, each in enumerate(numbers):
            self.quads[slots, :, place] = each[:, None]
        self.quads[slots, :, 6] = kind

    def _mark_all(self, times: NDArray[np.float64], values: NDArray[np.float64]) -> None:
        if not self._kind or self._every <= 0:
            return
        first = math.ceil((times[0] - self._phase) / self._every)
        last = math.floor((times[-1] - self._phase) / self._every)
        wanted = np.arange(max(first, last - MARKS + 1), last + 1) * self._every + self._phase
        at = np.unique(np.searchsorted(times, wanted))
        slots = 2 * self.count + np.arange(len(at)) % MARKS
        where, what = times[at] - self._origin, self._drawn(values[at])
        self._write(slots, where, what, where, what, kind=self._kind)
        self._mark, self._next_mark = len(at), (last + 1) * self._every + self._phase

    def add(self, time: float, value: float) -> bool:
        """Draw one more sample, which is the newest; True when it began a new column."""
        if not math.isfinite(value):
            self._broken = True
            return False
        number = math.floor((time - self._origin) / self._wide)
        ago, drawn = time - self._origin, min(max(value - self._base, -MAX_VALUE), MAX_VALUE)
        last, self._last = self._last, (time, value)
        new = last is None or number != self._column
        slot = number % self.count
        if new:
            self._begin(number)
            self._low[slot] = self._high[slot] = value
            if last is not None and not self._broken and time - last[0] <= self.gap:
                before = min(max(last[1] - self._base, -MAX_VALUE), MAX_VALUE)
                self._put(self.count + slot, last[0] - self._origin, before, ago, drawn, LINE)
        else:
            self._low[slot], self._high[slot] = min(self._low[slot], value), max(self._high[slot], value)
        low, high = self._low[slot] - self._base, self._high[slot] - self._base
        self._put(slot, ago, max(low, -MAX_VALUE), ago, min(high, MAX_VALUE), LINE)
        self._broken = False
        if (self._kind and time >= self._next_mark) or self._next_mark == math.inf:
            self._add_mark(time, ago, drawn)
        return new

    def _begin(self, number: int) -> None:
        """Make room for a column, and empty those that were skipped."""
        if self._last is not None and self._column < number:
            for skipped in range(max(self._column + 1, number - self.count + 1), number):
                self._empty(skipped % self.count)
        self._empty(number % self.count)
        self._numbers[number % self.count] = number
        self._column = number

    def _empty(self, slot: int) -> None:
        for place in (slot, self.count + slot):
            self.quads[place, :, 6] = NOTHING
            self.changed.add(place // PIECE)
        self._numbers[slot] = EMPTY

    def _put(self, slot: int, *numbers: float) -> None:
        time, value, to_time, to_value, kind = numbers
        self.changed.add(slot // PIECE)
        quad = self.quads[slot]
        quad[:, 0:4] = time, value, to_time, to_value
        quad[:, 6] = kind

    def _add_mark(self, time: float, ago: float, drawn: float) -> None:
        if self._kind and self._every > 0:
            self._put(2 * self.count + self._mark % MARKS, ago, drawn, ago, drawn, float(self._kind))
            self._mark += 1
            self._next_mark = (math.floor((time - self._phase) / self._every) + 1) * self._every + self._phase

    def extent(self, left: float, right: float) -> tuple[float, float]:
        """Least and greatest value from `left` to `right` [s]; infinity and its opposite where there is none."""
        if not self.count:
            return math.inf, -math.inf
        first = math.floor((left - self._origin) / self._wide)
        last = math.floor((right - self._origin) / self._wide)
        seen = (self._numbers >= first) & (self._numbers <= last)
        return (
            float(np.min(self._low, where=seen, initial=math.inf)),
            float(np.max(self._high, where=seen, initial=-math.inf)),
        )
