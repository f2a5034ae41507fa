"""Placement of a pad: beside its target, never over STOP."""

from __future__ import annotations

from collections.abc import Sequence

from app.inputs.switch_access.window.finding import Box

__all__ = ["beside"]

EDGE_MARGIN = 8.0
"""From the edge of the glass, and from what is kept free [px]."""


def beside(size: tuple[float, float], room: Box, keep: Sequence[Box]) -> tuple[float, float]:
    """Lower left corner of a card of `size` in `room` that covers none of `keep`, the first of which count most [px].

    Where there is no such place it covers as little of them as it can.
    """
    width, height = size
    left, low, right, top = (
        room[0] + EDGE_MARGIN,
        room[1] + EDGE_MARGIN,
        room[2] - EDGE_MARGIN - width,
        room[3] - EDGE_MARGIN - height,
    )
    middle = (left + right) / 2
    across = {left, middle, right}
    up = {low, (low + top) / 2, top}
    for box in keep:
        across |= {box[0] - EDGE_MARGIN - width, box[2] + EDGE_MARGIN}
        up |= {box[1] - EDGE_MARGIN - height, box[3] + EDGE_MARGIN}
    places = [
        (x, y) for x in across if left <= x <= max(left, right) for y in up if low <= y <= max(low, top)
    ]
    weights = [10.0 ** (-2 * number) for number in range(len(keep))]

    def cost(place: tuple[float, float]) -> tuple[float, float, float]:
        covered = sum(
            weight * _shared((*place, place[0] + width, place[1] + height), box)
            for weight, box in zip(weights, keep, strict=True)
        )
        return round(covered, 6), abs(place[0] - middle), place[1]

    return min(places or [(left, low)], key=cost)


def _shared(one: Box, other: Box) -> float:
    wide = min(one[2], other[2]) - max(one[0], other[0])
    high = min(one[3], other[3]) - max(one[1], other[1])
    return max(wide, 0.0) * max(high, 0.0)
