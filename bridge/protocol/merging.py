"""Merging of several subscriptions of one client to one topic into one delivery."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from msgspec import UNSET

from bridge.codec import shown
from bridge.core.compat import Compat
from bridge.protocol.names import MAX_NAME_LENGTH, spells_ros2, wrong
from bridge.protocol.ops import COMPRESSIONS, Op, Reduction, Subscribe

__all__ = ["Subscribed", "checked_size", "merged", "wish"]

MAX_FIELDS = 100
"""Most paths in `Reduction.fields`."""


@dataclass(frozen=True, slots=True)
class Subscribed:
    """The delivery of one topic to one client, merged from all its subscriptions. Hashable."""

    name: str
    """The topic as the client wrote it."""
    period: float = 0.0
    """Shortest time between two messages [s]."""
    queue: int = 0
    """Most messages that may wait; 0 for the server's choice."""
    compression: str = "none"
    """One of `COMPRESSIONS`."""
    fragment_size: int | None = None
    """Longest text frame [characters]; None for no limit. Binary frames are never cut."""
    reduction: Reduction | None = None
    """The part of each message that is sent; None for all."""
    ros2: bool = False
    """Whether it spells types as `pkg/msg/Type` and wants times as `sec` and `nanosec`."""


def wish(op: Subscribe, compat: Compat, ros2: bool = False) -> Subscribed:
    """The delivery that one subscription asks for. `ros2` is the client's spelling of types when `op` names none.

    ProtocolError, with the field, its value and what is allowed, when it is impossible.
    """
    compression = op.compression or "none"
    if compression not in COMPRESSIONS:
        if not compat.unknown_compression_as_none:
            raise wrong(
                op, f"compression must be one of {', '.join(COMPRESSIONS)}, not {shown(compression)}."
            )
        compression = "none"
    if op.reduce is not None:
        _check_reduction(op, op.reduce)
    named = op.type not in (None, "", "*")
    return Subscribed(
        name=op.topic,
        period=_number(op, "throttle_rate", op.throttle_rate) / 1000,
        queue=int(_number(op, "queue_length", op.queue_length)),
        compression=compression,
        fragment_size=checked_size(op),
        reduction=op.reduce,
        ros2=spells_ros2(op.type) if named else ros2,
    )


def merged(wishes: Iterable[Subscribed], compat: Compat) -> Subscribed:
    """One delivery for several subscriptions, under the name of the first.

    The faster rate wins, the smaller fragments, the later in `COMPRESSIONS`; the same reduction stays, with different
    ones everything is sent. For the queue see `Compat.shortest_queue`.
    """
    several = list(wishes)
    first = several[0]
    queues = [each.queue for each in several]
    longest = 0 if 0 in queues else max(queues)
    alike = all(each.reduction == first.reduction for each in several)
    return Subscribed(
        name=first.name,
        period=min([each.period for each in several]),
        queue=min(queues) if compat.shortest_queue else longest,
        compression=max({each.compression for each in several}, key=COMPRESSIONS.index),
        fragment_size=min(
            [size for each in several if (size := each.fragment_size) is not None], default=None
        ),
        reduction=first.reduction if alike else None,
        ros2=any(each.ros2 for each in several),
    )


def checked_size(op: Op) -> int | None:
    """The `fragment_size` of an operation; None where it has none. ProtocolError when it is no usable size."""
    size = op.fragment_size
    if size is UNSET or size is None:
        return None
    if 1 <= size < math.inf:
        return int(size)
    raise wrong(op, f"fragment_size must be at least 1 or null, not {shown(size)}.")


def _number(op: Subscribe, field: str, value: float | None) -> float:
    """A number from 0; a negative one counts as 0, as it does for the servers in use."""
    if value is None or value <= 0:
        return 0
    if value <= 2**53:
        return value
    raise wrong(op, f"{field} must be at most {2**53}, not {shown(value)}.")


def _check_reduction(op: Subscribe, wanted: Reduction) -> None:
    for name, value, least, most in (
        ("beams", wanted.beams, 1, 2**31),
        ("width", wanted.width, 1, 2**31),
        ("quality", wanted.quality, 1, 95),
    ):
        if value is not None and not least <= value <= most:
            raise wrong(
                op, f"reduce.{name} must be a whole number from {least} to {most}, not {shown(value)}."
            )
    if wanted.resolution is not None and not 0 < wanted.resolution < math.inf:
        raise wrong(op, f"reduce.resolution must be above 0, not {shown(wanted.resolution)}.")
    fields = wanted.fields
    if fields is None:
        return
    if len(fields) > MAX_FIELDS:
        raise wrong(op, f"reduce.fields may name at most {MAX_FIELDS} fields, not {len(fields)}.")
    for path in fields:
        if not 0 < len(path) <= MAX_NAME_LENGTH:
            raise wrong(op, f"reduce.fields: a path has 1 to {MAX_NAME_LENGTH} characters, not {len(path)}.")
