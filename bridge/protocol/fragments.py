"""Fragments of long operations: `fragment` operations from a text, and the text from `fragment` operations."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field

import msgspec
from msgspec import UNSET

from bridge.codec import shown
from bridge.core.errors import ProtocolError
from bridge.protocol.names import checked_id, plain_id, wrong
from bridge.protocol.ops import Fragment, Id

__all__ = ["MAX_SLICES", "Fragments", "split"]

MAX_SLICES = 1000
"""Most slices of one text; a longer text gets longer slices instead."""
SLICE_COST = 64
"""Memory of a waiting slice beside its text [byte]."""
_HIGH_HALF = re.compile(r"\\u[dD][89abAB][0-9a-fA-F]{2}")
_LOW_HALF = re.compile(r"\\u[dD][c-fC-F][0-9a-fA-F]{2}")
_ENCODER = msgspec.json.Encoder()


def split(text: bytes, size: int, id: str) -> list[bytes]:
    """`text`, the JSON of one operation, as `fragment` operations of at most `size` characters each.

    No slice ends within a character or an escape of JSON; one escape longer than `size` stays whole. A text that fits
    into one slice is returned as it is, alone. `id` should not be empty: roslib ignores slices with an empty id.
    ProtocolError when `size` is below 1 or `text` is not UTF-8.
    """
    if size < 1:
        raise ProtocolError(f"fragment_size must be at least 1, not {size}.")
    if len(text) <= size:
        return [text]
    try:
        whole = text.decode()
    except UnicodeDecodeError as error:
        raise ProtocolError(f"{len(text)} bytes that are not UTF-8 cannot be sliced.") from error
    slices = _slices(whole, max(size, math.ceil(len(whole) / MAX_SLICES)))
    if len(slices) == 1:
        return [text]
    return [
        _ENCODER.encode(Fragment(id=id, data=data, num=num, total=len(slices)))
        for num, data in enumerate(slices)
    ]


def _slices(text: str, size: int) -> list[str]:
    slices, start = [], 0
    while start < len(text):
        end = _cut(text, start, start + size)
        slices.append(text[start:end])
        start = end
    return slices


def _cut(text: str, start: int, end: int) -> int:
    """The end of a slice from `start`, which is not within an escape: `end`, or before an escape there."""
    if end >= len(text):
        return len(text)
    begin = _escape_before(text, start, end)
    if begin is None:
        return end
    after = _escape_end(text, begin)
    if after <= end:
        return end
    return begin if begin > start else after


def _escape_before(text: str, start: int, end: int) -> int | None:
    """The beginning of the last escape that begins before `end`, the first half of a pair counting for both."""
    place = text.rfind("\\", max(start, end - 6), end)
    if place < 0:
        return None
    run = text[start : place + 1]
    if (len(run) - len(run.rstrip("\\"))) % 2 == 0:
        place -= 1
    first = place - 6
    if _LOW_HALF.match(text, place) and first >= start and _HIGH_HALF.match(text, first):
        run = text[start : first + 1]
        return first if (len(run) - len(run.rstrip("\\"))) % 2 else place
    return place


def _escape_end(text: str, begin: int) -> int:
    if text[begin + 1 : begin + 2] != "u":
        return begin + 2
    pair = _HIGH_HALF.match(text, begin) and _LOW_HALF.match(text, begin + 6)
    return begin + (12 if pair else 6)


@dataclass(slots=True)
class _Unfinished:
    total: int
    heard: float
    cost: int = 0
    slices: dict[int, str] = field(default_factory=dict)


class Fragments:
    """Joins slices, several texts at a time, in any order."""

    def __init__(
        self,
        limit_bytes: int,
        most: int = 4,
        lifetime: float = 10.0,
        *,
        given_up: Callable[[ProtocolError], object] | None = None,
    ) -> None:
        """At most `limit_bytes` wait in at most `most` unfinished texts.

        A text without a new slice for `lifetime` [s] is given up, and so is the one that waited longest when there is
        one too many, or one that is begun anew. `given_up` is called with one error for each.
        """
        self._limit = limit_bytes
        self._most = most
        self._lifetime = lifetime
        self._given_up = given_up
        self._sets: dict[Id, _Unfinished] = {}
        self._held = 0

    @property
    def held(self) -> int:
        """Waiting bytes, each slice counted with `SLICE_COST` more than its text."""
        return self._held

    def __len__(self) -> int:
        """Number of unfinished texts."""
        return len(self._sets)

    def add(self, op: Fragment, now: float) -> str | None:
        """Add a slice at `now` [s], any clock that only goes forward; returns the text when it is complete.

        `num` and `total` may be floats, of which the whole part of `total` counts. A slice that contradicts those
        before it begins its text anew. ProtocolError for a slice that can belong to no text, or is one too many for
        `limit_bytes`; its text is given up then.
        """
        self.expire(now)
        checked_id(op)
        num, total = self._place(op)
        if total == 1:
            return op.data
        cost = len(op.data.encode("utf-8", "surrogatepass")) + SLICE_COST
        unfinished = self._sets.get(op.id)
        if unfinished is not None and (
            unfinished.total != total or unfinished.slices.get(num, op.data) != op.data
        ):
            self._give_up(op.id, "begun anew")
            unfinished = None
        if self._held + cost > self._limit:
            self._drop(op.id)
            raise _wrong(op, f"what waits to be put together must stay under {self._limit} bytes")
        if unfinished is None:
            unfinished = self._begin(op.id, total, now)
        if num not in unfinished.slices:
            unfinished.slices[num] = op.data
            unfinished.cost += cost
            unfinished.heard = now
            self._held += cost
        if len(unfinished.slices) < total:
            return None
        self._drop(op.id)
        return "".join(unfinished.slices[num] for num in range(total))

    def expire(self, now: float) -> None:
        """Give up every text that waits too long at `now` [s]; `add` does it too."""
        for id in [id for id, each in self._sets.items() if now - each.heard >= self._lifetime]:
            self._give_up(id, f"nothing more came within {self._lifetime:g} s")

    def _begin(self, id: Id, total: int, now: float) -> _Unfinished:
        while len(self._sets) >= self._most:
            stalest = min(self._sets, key=lambda each: self._sets[each].heard)
            self._give_up(stalest, f"only {self._most} texts may be unfinished at a time")
        return self._sets.setdefault(id, _Unfinished(total, now))

    def _place(self, op: Fragment) -> tuple[int, int]:
        if op.id is UNSET or op.id is None:
            raise _wrong(op, "it needs an id")
        if not 1 <= op.total < math.inf:
            raise _wrong(op, f"total must be a whole number from 1, not {shown(op.total)}")
        if int(op.total) * SLICE_COST > max(self._limit, SLICE_COST):
            raise _wrong(op, f"total must be at most {self._limit // SLICE_COST}, not {shown(op.total)}")
        if not 0 <= op.num < int(op.total) or op.num != int(op.num):
            raise _wrong(op, f"num must be a whole number from 0 to {int(op.total) - 1}, not {shown(op.num)}")
        return int(op.num), int(op.total)

    def _drop(self, id: Id) -> _Unfinished | None:
        dropped = self._sets.pop(id, None)
        self._held -= dropped.cost if dropped else 0
        return dropped

    def _give_up(self, id: Id, reason: str) -> None:
        dropped = self._drop(id)
        if dropped is not None and self._given_up is not None:
            sentence = f"{len(dropped.slices)} of {dropped.total} fragments are dropped: {reason}."
            self._given_up(ProtocolError(sentence, op="fragment", id=plain_id(id)))


def _wrong(op: Fragment, reason: str) -> ProtocolError:
    return wrong(op, f"A fragment cannot be used: {reason}.")
