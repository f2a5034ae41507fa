"""What one trace has been told: times and values in a ring of bounded length. No Kivy."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["MAX_SAMPLES", "History", "thinned"]

MAX_SAMPLES = 36_000
"""So many are kept [samples]: half an hour at 20 Hz."""
FIRST_SIZE = 512
"""Of a ring that is new [samples]; it grows as it fills."""
PAUSES = 257
"""So many samples tell how far apart they usually are."""
GAP_PERIODS = 5.0
"""After so many usual pauses between two samples the line is broken."""
MIN_GAP = 0.25
"""It is never broken for less [s]: messages come in bursts."""
MAX_STEP_BACK = 1.0
"""A time farther back than this [s] is that of another run, which begins anew."""

Floats = NDArray[np.float64]


def thinned(times: Floats, values: Floats, most: int) -> tuple[Floats, Floats]:
    """At most `most` samples of many: of each stretch the least and the greatest, so that no spike is lost.

    A stretch that holds anything unknown keeps that too, so that no hole is closed.
    """
    if len(times) <= most:
        return times, values
    stretch = math.ceil(len(times) / max(most // 3, 1))
    starts = np.arange(0, len(times), stretch)
    known = np.isfinite(values)
    kept = np.zeros(len(times), np.bool_)
    for start in starts:
        part, good = values[start : start + stretch], known[start : start + stretch]
        if good.any():
            kept[start + np.argmin(np.where(good, part, np.inf))] = True
            kept[start + np.argmax(np.where(good, part, -np.inf))] = True
        if not good.all():
            kept[start + np.argmin(good)] = True
    return times[kept], values[kept]


class History:
    """Samples in the order of their times, the oldest given up where there are too many.

    Each is written twice, half a ring apart: so what is kept always lies in one piece, and reading copies nothing.
    """

    def __init__(self, most: int = MAX_SAMPLES) -> None:
        """`most` samples are kept."""
        self.most = most
        self._room = min(FIRST_SIZE, most)
        self._times, self._values = np.empty(2 * self._room), np.empty(2 * self._room)
        self._start = self._count = 0

    def __len__(self) -> int:
        return self._count

    @property
    def times(self) -> Floats:
        """When each sample was taken [s], rising; a view, true until the next change."""
        return self._times[self._start : self._start + self._count]

    @property
    def values(self) -> Floats:
        """What was told at each time; NaN where that was nothing."""
        return self._values[self._start : self._start + self._count]

    @property
    def oldest(self) -> float:
        """Time of the oldest sample that is kept [s]; NaN before the first."""
        return float(self._times[self._start]) if self._count else math.nan

    @property
    def newest(self) -> float:
        """Time of the newest sample [s]; NaN before the first."""
        return float(self._times[self._start + self._count - 1]) if self._count else math.nan

    @property
    def last(self) -> float:
        """The newest value; NaN before the first."""
        return float(self._values[self._start + self._count - 1]) if self._count else math.nan

    def add(self, time: float, value: float) -> float:
        """Append a sample; returns the time that it was given [s].

        One a little before the newest counts as of the newest's time; one far before it begins a history anew.
        """
        if self._count:
            newest = self.newest
            if time < newest - MAX_STEP_BACK:
                self.clear()
            elif time < newest:
                time = newest
        if self._count == self._room and self._room < self.most:
            self._grow()
        at = (self._start + self._count) % self._room
        if self._count == self._room:
            self._start = (self._start + 1) % self._room
        else:
            self._count += 1
        for array, number in ((self._times, time), (self._values, value)):
            array[at] = array[at + self._room] = number
        return time

    def load(self, times: Floats, values: Floats) -> None:
        """Take these samples instead of what was there; rising times. Too many are thinned, spikes kept."""
        times, values = thinned(np.asarray(times, float), np.asarray(values, float), self.most)
        self._room = max(min(FIRST_SIZE, self.most), len(times))
        self._start, self._count = 0, len(times)
        self._times, self._values = np.empty(2 * self._room), np.empty(2 * self._room)
        for array, numbers in ((self._times, times), (self._values, values)):
            array[: len(times)] = array[self._room : self._room + len(times)] = numbers

    def clear(self) -> None:
        """Forget all samples."""
        self._start = self._count = 0

    def _grow(self) -> None:
        times, values = self.times.copy(), self.values.copy()
        self._room = min(2 * self._room, self.most)
        self._times, self._values = np.empty(2 * self._room), np.empty(2 * self._room)
        self._start = 0
        for array, numbers in ((self._times, times), (self._values, values)):
            array[: len(times)] = array[self._room : self._room + len(times)] = numbers

    def usual_gap(self) -> float:
        """How far apart two samples may be [s] before something is missing between them, as far as the newest tell."""
        if self._count < 3:
            return math.inf
        pauses = np.diff(self.times[-PAUSES:])
        return max(GAP_PERIODS * float(np.median(pauses)), MIN_GAP)

    def within(self, left: float, right: float) -> tuple[int, int]:
        """First and last + 1 of the samples from `left` to `right` [s], and one beyond at each end where there is one."""
        first, last = np.searchsorted(self.times, (left, right), side="left")
        return max(int(first) - 1, 0), min(int(last) + 1, self._count)

    def at(self, time: float, gap: float) -> float:
        """Value of the sample nearest to `time` [s]; NaN in a hole, which is where none is within `gap` [s]."""
        if not self._count:
            return math.nan
        times = self.times
        after = min(int(np.searchsorted(times, time)), self._count - 1)
        before = max(after - 1, 0)
        near = before if time - times[before] < times[after] - time else after
        return float(self.values[near]) if abs(times[near] - time) <= gap else math.nan
