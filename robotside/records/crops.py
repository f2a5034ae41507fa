"""The pictures of intruders, each kept with the event that reported it."""

from __future__ import annotations

from base64 import b64decode, b64encode

from robotside.records.ledger import Ledger

__all__ = ["MAX_CROPS", "Crops"]

MAX_CROPS = 100
"""The newest that are kept."""


class Crops:
    """All pictures, JPEG files, by the number of the event."""

    def __init__(self, ledger: Ledger) -> None:
        self._ledger = ledger

    def keep(self, event: int, picture: bytes) -> None:
        """Keep `picture` with an event; an empty one is none. Beyond `MAX_CROPS` the oldest goes."""
        if not picture:
            return
        with self._ledger.together():
            self._ledger.fact("crops", event, b64encode(picture).decode())
            rows = self._ledger.rows("crops")
            for old in sorted(rows)[: max(0, len(rows) - MAX_CROPS)]:
                self._ledger.fact("crops", old, None)

    def of(self, event: int) -> bytes:
        """The picture of an event; empty where there is none."""
        return b64decode(self._ledger.rows("crops").get(event, ""))

    def erase(self) -> None:
        """Delete all of them: nobody can tell whom they show."""
        with self._ledger.together():
            for event in list(self._ledger.rows("crops")):
                self._ledger.fact("crops", event, None)
