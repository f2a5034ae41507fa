"""A figure, its samples and their statistics."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal

__all__ = ["Figure", "Outcome", "Samples", "Stated", "percentile"]

Verdict = Literal["reached", "MISSED", "not measured", ""]


def percentile(values: Iterable[float], share: float) -> float:
    """The value below which `share` [0..1] of the values lie, linear between neighbours; NaN of none."""
    ordered = sorted(values)
    if not ordered:
        return math.nan
    place = share * (len(ordered) - 1)
    below = math.floor(place)
    above = min(below + 1, len(ordered) - 1)
    if ordered[below] == ordered[above] or place == below:  # the second also where what follows is infinite
        return ordered[below]
    return ordered[below] + (place - below) * (ordered[above] - ordered[below])


@dataclass(frozen=True, slots=True)
class Stated:
    """Value of another program from an earlier measurement by others: given beside ours, not measured in this run."""

    of: str
    """The program, and where the value is from."""
    value: float
    """In the figure's unit."""


@dataclass(frozen=True, slots=True)
class Figure:
    """One number that a bench measures."""

    name: str
    unit: str
    meaning: str
    """One line for a reader who has not seen the code."""
    target: float | None = None
    """Target, in `unit`, of what a person feels or a safeguard promises; None where there is none."""
    better: Literal["less", "more"] = "less"
    against: str = ""
    """What the peer's value is of; empty where there is no peer."""
    share: float | None = None
    """Target as a multiple of the peer's value in the same run, which holds on any machine; None where there is none."""
    stated: Stated | None = None
    """A value for comparison that is not of this run; None where there is none."""
    needs_data: bool = False
    """Measured on recordings alone: a run without them has missed nothing."""

    def verdict(self, value: float, peer: float = math.nan) -> Verdict:
        """Whether `value` reaches each target, beside the peer's; empty without a target. NaN reaches nothing."""
        limits = [] if self.target is None else [self.target]
        limits += [] if self.share is None else [self.share * peer]
        if not limits:
            return ""
        fits = all(value <= limit if self.better == "less" else value >= limit for limit in limits)
        return "reached" if fits else "MISSED"


@dataclass(frozen=True, slots=True)
class Samples:
    """One value a repeat."""

    values: Sequence[float]

    @property
    def median(self) -> float:
        """NaN without values."""
        return statistics.median(self.values) if self.values else math.nan

    @property
    def low(self) -> float:
        """The least value; NaN without values."""
        return min(self.values, default=math.nan)

    @property
    def high(self) -> float:
        """The greatest value; NaN without values."""
        return max(self.values, default=math.nan)

    @property
    def spread(self) -> float:
        """Greatest less least, as a share of the median; NaN without values or with a median of 0."""
        return (self.high - self.low) / self.median if self.values and self.median else math.nan


@dataclass(frozen=True, slots=True)
class Outcome:
    """What was measured of one figure."""

    figure: Figure
    ours: Samples
    peer: Samples = field(default_factory=lambda: Samples(()))

    @property
    def verdict(self) -> Verdict:
        """Of the median; `not measured` where the recordings that it needs were not there."""
        if self.figure.needs_data and self.figure.target is not None and not self.ours.values:
            return "not measured"
        return self.figure.verdict(self.ours.median, self.peer.median)

    @property
    def ratio(self) -> float:
        """How many times better than the peer, median by median: above 1 is better. NaN without a peer."""
        return self._better_than(self.peer.median)

    @property
    def stated_ratio(self) -> float:
        """How many times better than what was stated of another program; NaN where nothing was."""
        return math.nan if self.figure.stated is None else self._better_than(self.figure.stated.value)

    def _better_than(self, other: float) -> float:
        ours = self.ours.median
        above, below = (other, ours) if self.figure.better == "less" else (ours, other)
        return above / below if below else math.nan
