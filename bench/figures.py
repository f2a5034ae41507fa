"""A measured figure: samples, what they mean, the limit they should keep, what they are measured against."""

from __future__ import annotations

import math
import os
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

__all__ = ["Figure", "machine", "percentile", "table", "timed"]


def percentile(samples: Sequence[float], percent: float) -> float:
    """The least sample that `percent` of all do not exceed; NaN without samples."""
    ordered = sorted(samples)
    return ordered[max(0, math.ceil(len(ordered) * percent / 100) - 1)] if ordered else math.nan


@dataclass(frozen=True)
class Figure:
    """One line of the table."""

    name: str
    unit: str
    samples: tuple[float, ...]
    """One per repetition, or one per event where `percent` is given."""
    limit: float = math.nan
    """What it should keep; NaN when it is only told."""
    at_least: bool = False
    """The limit is a least value, not a greatest."""
    percent: float = 50.0
    """Which percentile of the samples is the value."""
    against: str = ""
    """What was measured, and what with."""

    @property
    def value(self) -> float:
        """The figure; NaN without samples."""
        return percentile(self.samples, self.percent)

    @property
    def spread(self) -> float:
        """Half the distance between the quartiles of the samples; NaN for fewer than two."""
        if len(self.samples) < 2:
            return math.nan
        return (percentile(self.samples, 75) - percentile(self.samples, 25)) / 2

    @property
    def ok(self) -> bool | None:
        """Within the limit; None when there is none."""
        if math.isnan(self.limit):
            return None
        return self.value >= self.limit if self.at_least else self.value <= self.limit

    def record(self) -> dict[str, Any]:
        """For the JSON file."""
        limit = None if math.isnan(self.limit) else self.limit
        spread = None if math.isnan(self.spread) else self.spread
        return {
            "name": self.name,
            "unit": self.unit,
            "value": None if math.isnan(self.value) else self.value,
            "percentile": self.percent,
            "spread": spread,
            "samples": len(self.samples),
            "limit": limit,
            "at_least": self.at_least,
            "ok": self.ok,
            "against": self.against,
        }


def timed(work: Callable[[], object], repeat: int = 15, least: float = 0.02) -> tuple[float, ...]:
    """Seconds that one call of `work` takes, `repeat` times; each time is the mean of calls that last `least` [s]."""
    calls, started = 0, time.perf_counter()
    while time.perf_counter() - started < least:
        work()
        calls += 1
    samples = []
    for _ in range(repeat):
        started = time.perf_counter()
        for _ in range(calls):
            work()
        samples.append((time.perf_counter() - started) / calls)
    return tuple(samples)


def _arithmetic() -> int:
    return sum(number * number % 7 for number in range(20_000))


def machine() -> Figure:
    """How long a fixed piece of arithmetic takes here and now: its spread is the machine's own noise."""
    load = os.getloadavg()[0]
    samples = tuple(second * 1e3 for second in timed(_arithmetic, repeat=30))
    against = f"load {load:.1f} on {os.cpu_count()} cores; the spread is the noise of this run"
    return Figure("fixed arithmetic", "ms", samples, against=against)


def _number(value: float) -> str:
    return "–" if math.isnan(value) else f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"


def table(figures: Sequence[Figure]) -> str:
    """The figures as text, one a line."""
    rows = [("figure", "value", "±", "limit", "", "measured")]
    for figure in figures:
        sign = "≥" if figure.at_least else "≤"
        limit = "" if math.isnan(figure.limit) else f"{sign} {_number(figure.limit)}"
        verdict = {True: "ok", False: "OVER", None: ""}[figure.ok]
        if verdict == "OVER" and figure.at_least:
            verdict = "UNDER"
        value = f"{_number(figure.value)} {figure.unit}"
        spread = "" if math.isnan(figure.spread) else _number(figure.spread)
        rows.append((figure.name, value, spread, limit, verdict, figure.against))
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    lines = []
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=False)]
        lines.append("  ".join([*cells, row[5]]).rstrip())
    return "\n".join(lines)
