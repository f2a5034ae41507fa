"""What a bar leaves out, one thing after the other, until the rest has room."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping

__all__ = ["giving_way"]


def giving_way(
    room: float, order: Iterable[str], width: Callable[[Mapping[str, int]], float]
) -> dict[str, int]:
    """How often each thing gives way so that all fit into `room` [px], as its name comes in `order`: the first goes first.

    `width` tells how wide all are [px] where so much gave way. Where nothing helps, everything in `order` has given way.
    """
    given: Counter[str] = Counter()
    for name in order:
        if width(given) <= room:
            break
        given[name] += 1
    return dict(given)
