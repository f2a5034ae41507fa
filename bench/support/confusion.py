"""What a detector found in scenes against their truth: right, missed, taken for another class, and made up."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from bench.support.sights import FARTHEST, Truth
from robotside.perception.sighting import Sighting

__all__ = ["MIN_PIXELS", "MIN_SEEN", "NOTHING", "Confusion"]

MIN_PIXELS = 100.0
"""A thing counts when at least so many of its pixels can be seen in a picture of 640 x 480 …"""
MIN_SEEN = 0.5
"""… at least so much of it is not hidden, nor cut off by the picture's sides …"""
MAX_DISTANCE = FARTHEST
"""… and its middle is at most so far away [m]. What can be seen and does not count is neither to be found nor wrong to be found."""
SAME = 0.5
"""A box is of a thing when both share this of what they cover together."""
WITHIN = 0.4
"""A box of which so much lies within a thing that does not count is not judged."""
NOTHING = "nothing"

Box = tuple[float, float, float, float]


class Share(NamedTuple):
    """Precision and recall; NaN where there was nothing to judge."""

    precision: float
    recall: float


class Confusion:
    """Counts of scenes."""

    def __init__(self) -> None:
        self.table: Counter[tuple[str, str]] = Counter()
        """By true and told class; a class that was missed is told as nothing, and what was made up is truly nothing."""

    def add(self, truths: Sequence[Truth], found: Sequence[Sighting]) -> None:
        """Judge one picture."""
        wanted = [truth for truth in truths if counts(truth)]
        others = [truth for truth in truths if not counts(truth) and truth.pixels > 0]
        boxes = [(one.left, one.top, one.right, one.bottom) for one in found]
        left, open_ = set(range(len(found))), set(range(len(wanted)))
        for same in (True, False):
            pairs = sorted(
                (
                    (_overlap(wanted[t].box, boxes[f]), t, f)
                    for t in open_
                    for f in left
                    if not same or wanted[t].kind == found[f].kind
                ),
                reverse=True,
            )
            for overlap, t, f in pairs:
                if overlap >= SAME and t in open_ and f in left:
                    open_.discard(t)
                    left.discard(f)
                    self.table[wanted[t].kind, found[f].kind] += 1
        for t in open_:
            self.table[wanted[t].kind, NOTHING] += 1
        for f in left:
            if not any(_part_within(boxes[f], truth.box) >= WITHIN for truth in others):
                self.table[NOTHING, found[f].kind] += 1

    def share(self, kind: str) -> Share:
        """How much of what was told as `kind` is, and how much of what is was told."""
        right = self.table[kind, kind]
        told = sum(count for (_, each), count in self.table.items() if each == kind)
        true = sum(count for (each, _), count in self.table.items() if each == kind)
        return Share(right / told if told else float("nan"), right / true if true else float("nan"))

    def worst(self, kinds: Iterable[str]) -> float:
        """The least precision or recall of all `kinds` that there was something to judge of."""
        found = [part for kind in kinds for part in self.share(kind) if part == part]  # noqa: PLR0124 - NaN
        return min(found, default=float("nan"))

    def lines(self, kinds: Sequence[str]) -> list[str]:
        """The table for people: a line for each true class."""
        told = [*kinds, NOTHING]
        rows = ["".join(f"{word:>9}" for word in ("", *told))]
        rows += [
            "".join((f"{true:>9}", *(f"{self.table[true, each]:>9}" for each in told)))
            for true in (*kinds, NOTHING)
        ]
        return rows


def counts(truth: Truth) -> bool:
    """It is to be found."""
    return truth.pixels >= MIN_PIXELS and truth.seen >= MIN_SEEN and truth.distance <= MAX_DISTANCE


def _area(box: Box) -> float:
    return max(0.0, box[2] - box[0]) * max(0.0, box[3] - box[1])


def _shared(one: Box, other: Box) -> float:
    return _area((max(one[0], other[0]), max(one[1], other[1]), min(one[2], other[2]), min(one[3], other[3])))


def _overlap(one: Box, other: Box) -> float:
    shared = _shared(one, other)
    return shared / max(_area(one) + _area(other) - shared, 1e-12)


def _part_within(box: Box, other: Box) -> float:
    return _shared(box, other) / max(_area(box), 1e-12)
