"""Whether something grows: the slope of a series with its uncertainty."""

from __future__ import annotations

import itertools
import math
import statistics
from collections.abc import Sequence
from typing import NamedTuple

__all__ = ["BLOCKS", "Trend", "trend"]

BLOCKS = 12
"""Neighbouring samples depend on each other; the means of so many stretches hardly do."""


class Trend(NamedTuple):
    """A straight line through a series."""

    slope: float
    """Per unit of time; NaN for too short a series."""
    doubt: float
    """Its standard error; NaN likewise."""

    @property
    def grows(self) -> float:
        """Growth that is certain: the slope less twice its standard error, 0 where that is below; NaN when not known."""
        return math.nan if math.isnan(self.slope) else max(0.0, self.slope - 2 * self.doubt)


def trend(times: Sequence[float], values: Sequence[float], blocks: int = BLOCKS) -> Trend:
    """The least-squares line through the means of `blocks` stretches of the series."""
    if len(values) < 2 * blocks:
        return Trend(math.nan, math.nan)
    cuts = [round(number * len(values) / blocks) for number in range(blocks + 1)]
    x = [statistics.fmean(times[a:b]) for a, b in itertools.pairwise(cuts)]
    y = [statistics.fmean(values[a:b]) for a, b in itertools.pairwise(cuts)]
    line = statistics.linear_regression(x, y)
    left = sum((v - line.intercept - line.slope * t) ** 2 for t, v in zip(x, y, strict=True))
    spread = sum((t - statistics.fmean(x)) ** 2 for t in x)
    return Trend(line.slope, math.sqrt(left / (blocks - 2) / spread))
