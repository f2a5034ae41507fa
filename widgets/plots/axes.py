"""Scales of a plot: round figures between two ends, and their words. No Kivy."""

from __future__ import annotations

import math
import time

from widgets.core.language import figure, language

__all__ = ["clock_text", "nice_range", "nice_step", "tick_text", "ticks", "time_step"]

MINUS = "−"
TIME_STEPS = (1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 43_200, 86_400)
"""Round pieces of time from a second on [s]."""
FLAT = 1e-9
"""Ends of a scale closer than this, as a part of their size, are one value."""
MAX_PLAIN, MIN_PLAIN = 1e6, 1e-4
"""Figures beyond are written with an exponent."""


def nice_step(span: float, most: int) -> float:
    """Between two lines of a scale that spans `span`, so that there are at most `most`: 1, 2 or 5 times a power of ten."""
    least = span / max(most, 1)
    if not (least > 0 and math.isfinite(least)):
        return 1.0
    power = 10.0 ** math.floor(math.log10(least))
    return next((factor * power for factor in (1, 2, 5) if factor * power >= least * (1 - 1e-9)), 10 * power)


def time_step(span: float, most: int) -> float:
    """The same for a time [s], which is told in minutes and hours from a minute on."""
    least = span / max(most, 1)
    if least <= 1:
        return nice_step(span, most)
    return float(next((step for step in TIME_STEPS if step >= least), TIME_STEPS[-1]))


def nice_range(low: float, high: float) -> tuple[float, float]:
    """Ends of a scale that has room for all from `low` to `high`, at round figures a little beyond them."""
    if not (math.isfinite(low) and math.isfinite(high)):
        return 0.0, 1.0
    size = max(abs(low), abs(high))
    if high - low <= size * FLAT:
        half = max(size * 0.1, 0.5 if size == 0 else 0.0)
        low, high = low - half, high + half
    step = nice_step(high - low, 5)
    margin = (high - low) * 0.04
    return math.floor((low - margin) / step) * step, math.ceil((high + margin) / step) * step


def ticks(low: float, high: float, step: float) -> list[float]:
    """Round figures from `low` to `high`, both with it."""
    first, last = math.ceil(low / step - 1e-6), math.floor(high / step + 1e-6)
    return [number * step for number in range(first, last + 1)] if last - first < 1000 else []


def tick_text(value: float, step: float) -> str:
    """A figure of a scale whose lines are `step` apart: as many decimals as tell them apart."""
    if abs(value) < step * 1e-6:
        return "0"
    if not MIN_PLAIN <= step < MAX_PLAIN or abs(value) >= 1e7:
        text = f"{value:.3g}".replace("e+0", "e").replace("e-0", "e-").replace("-", MINUS)
        return text.replace(".", language.tongue.point)
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    return figure(value, decimals)


def clock_text(at: float, step: float) -> str:
    """A time of day [s since 1970] by this device's zone; seconds and parts of them where lines are that close [s]."""
    whole = math.floor(at + (0.0005 if step < 1 else 0.5))
    if step >= 60:
        return time.strftime("%H:%M", time.localtime(whole))
    text = time.strftime("%H:%M:%S", time.localtime(whole))
    return (
        text
        if step >= 1
        else f"{text}.{math.floor((at - whole) * 1000 + 0.5) % 1000:03d}".rstrip("0").rstrip(".")
    )
