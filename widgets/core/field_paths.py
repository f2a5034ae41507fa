"""Ways to a number in any message, written as people write them: `twist.twist.linear.x`, `ranges[3]`, `velocity.1`. No Kivy.

speed = number_at(odometry, "twist.twist.linear.x")
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import Any

__all__ = ["number_at", "value_at", "written"]

PART = re.compile(r"\[(-?\d+)\]|([^.\[\]]+)")
"""One step of a way: `[3]`, a name, or a number between dots."""


@lru_cache(maxsize=1024)
def _steps(path: str) -> tuple[str | int, ...]:
    """Names and places in lists, from the message inwards."""
    steps: list[str | int] = []
    for place, name in PART.findall(path):
        digits = place or (name if name.lstrip("-").isdigit() else "")
        steps.append(int(digits) if digits else name)
    return tuple(steps)


def written(steps: tuple[str | int, ...]) -> str:
    """A way as text: `('ranges', 3)` is `ranges[3]`."""
    text = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps)
    return text.removeprefix(".")


def value_at(message: Any, path: str) -> Any:
    """What is at `path`; several of a vector's letters, as in `twist.twist.linear.xy`, are how long it is in those directions.

    AttributeError, IndexError or TypeError when the message has no such field.
    """
    found = message
    for step in _steps(path):
        if isinstance(step, int):
            found = found[step]
        elif len(step) > 1 and set(step) <= set("xyz"):
            found = math.hypot(*(getattr(found, letter) for letter in step))
        else:
            found = getattr(found, step)
    return found


def number_at(message: Any, path: str) -> float:
    """The number at `path`; NaN for None. As `value_at`, and TypeError or ValueError for what is no number."""
    found = value_at(message, path)
    return math.nan if found is None else float(found)
