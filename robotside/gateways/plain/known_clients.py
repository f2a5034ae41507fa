"""Clients that are known for as long as something comes of them: who has no connection is gone when it falls silent."""

from __future__ import annotations

from typing import Generic, TypeVar

from robotside.door.station_door import StationDoor
from robotside.gateways.plain.visitor import Visitor

__all__ = ["IDLE_TIMEOUT", "MAX_VISITORS", "SILENT_TIMEOUT", "KnownClients"]

K = TypeVar("K")

MAX_VISITORS = 64
"""Clients of one gateway at a time."""
IDLE_TIMEOUT = 60.0
"""A client that is silent for this long is gone [s]; its control has lapsed long before."""
SILENT_TIMEOUT = 5.0
"""One that is silent for this long yields to a newcomer where all places are taken [s]."""


class KnownClients(Generic[K]):
    """Clients by that which they are known by. Who is let in where there is no room is for those that build on this."""

    def __init__(self, door: StationDoor) -> None:
        self._door = door
        self._known: dict[K, Visitor] = {}

    def __len__(self) -> int:
        return len(self._known)

    def leave_silent(self) -> None:
        """Clients that are silent for `IDLE_TIMEOUT` are gone; to be called every second or so."""
        now = self._door.now()
        for key, visitor in list(self._known.items()):
            if now - visitor.operator.last_heard > IDLE_TIMEOUT:
                self._leave(key)

    def leave_all(self) -> None:
        """All of them are gone: a robot that one of them drives stops."""
        for key in list(self._known):
            self._leave(key)

    def _keep(self, key: K, visitor: Visitor) -> None:
        """Know this client until it leaves or may not stay."""
        self._known[key] = visitor
        visitor.operator.on_expelled = lambda: self._leave(key)

    def _leave(self, key: K) -> None:
        visitor = self._known.pop(key, None)
        if visitor is not None:
            visitor.leave()
