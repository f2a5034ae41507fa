"""How old pictures are when they are written to those who look, measured while somebody looks."""

from __future__ import annotations

from collections import deque
from typing import NamedTuple

__all__ = ["MAX_SAMPLES", "Delay", "Delays"]

MAX_SAMPLES = 300
"""Pictures of each camera and kind that count, the newest ones."""


class Delay(NamedTuple):
    """From the moment a picture was taken to its last byte handed to the network."""

    median: float
    """Half of the pictures are no older [s]."""
    most: float
    """99 of 100 are no older [s]."""
    pictures: int
    """So many were measured."""


class Delays:
    """The delays of one robot's cameras, by camera and by the kind of stream."""

    def __init__(self) -> None:
        self._ages: dict[tuple[str, str], deque[float]] = {}

    def note(self, topic: str, kind: str, age: float) -> None:
        """A picture of the camera with that topic was written when it was `age` old [s]."""
        self._ages.setdefault((topic, kind), deque(maxlen=MAX_SAMPLES)).append(age)

    def of(self, topic: str, kind: str) -> Delay | None:
        """What was measured; None while nobody has looked that way."""
        ages = sorted(self._ages.get((topic, kind), ()))
        if not ages:
            return None
        return Delay(ages[len(ages) // 2], ages[min(len(ages) - 1, len(ages) * 99 // 100)], len(ages))
