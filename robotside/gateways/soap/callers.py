"""Clients of requests that stand alone: who gives an id is the same client in the next one, and keeps control until then.

Who gives none comes for one request, and is gone once that is answered.
"""

from __future__ import annotations

import math
from collections.abc import Collection

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.plain.visitor import Visitor
from robotside.gateways.plain.visitors import IDLE_TIMEOUT, MAX_VISITORS, SILENT_TIMEOUT

__all__ = ["Callers", "stand_in"]

_Key = tuple[str, str, str]
"""The host, the proven identity, empty for none, and the client id that a client gives."""


def stand_in(door: StationDoor, operator: Operator) -> Operator:
    """Another operator at the door for the person of `operator`, who stays when that one's request is answered."""
    identity = operator.identity
    other = door.join(operator.address, way=operator.way, secure=operator.secure, role=identity.role)
    other.identity = identity
    return other


class Callers:
    """The clients that gave an id."""

    def __init__(self, door: StationDoor, keys: Collection[str]) -> None:
        """They reach the payloads `keys`."""
        self._door, self._keys = door, keys
        self._known: dict[_Key, Visitor] = {}

    def __len__(self) -> int:
        return len(self._known)

    def visit(self, operator: Operator, client_id: str) -> Visitor:
        """The client behind a request of `operator`, empty `client_id` for one who gives none. Raises Refused without room."""
        if not client_id:
            return self.newcomer(operator)
        key = _key(operator, client_id)
        visitor = self._known.get(key)
        if visitor is not None and visitor.operator.identity != operator.identity:
            self._leave(key)  # with another role it begins anew: what it had, it has no more
            visitor = None
        if visitor is None:
            self._make_room()
            visitor = self._known[key] = self.newcomer(stand_in(self._door, operator))
            visitor.operator.on_expelled = lambda: self._leave(key)
        visitor.heard()
        return visitor

    def newcomer(self, operator: Operator) -> Visitor:
        """A client for one request."""
        # how long the request lay on its way nobody knows: without a stamp it drives nothing
        operator.answered = -math.inf
        return Visitor(self._door, operator, self._keys)

    def leave(self, operator: Operator, client_id: str) -> None:
        """That client is gone, if it was there."""
        self._leave(_key(operator, client_id))

    def leave_silent(self) -> None:
        """Who was silent for too long is gone."""
        now = self._door.now()
        for key, visitor in list(self._known.items()):
            if now - visitor.operator.last_heard > IDLE_TIMEOUT:
                self._leave(key)

    def leave_all(self) -> None:
        """All of them are gone: a robot that one of them drives stops."""
        for key in list(self._known):
            self._leave(key)

    def _leave(self, key: _Key) -> None:
        visitor = self._known.pop(key, None)
        if visitor is not None:
            visitor.leave()

    def _make_room(self) -> None:
        if len(self._known) < MAX_VISITORS:
            return
        key, quietest = min(self._known.items(), key=lambda each: each[1].operator.last_heard)
        if self._door.now() - quietest.operator.last_heard < SILENT_TIMEOUT:
            said = f"{MAX_VISITORS} clients use this gateway already; only STOP is answered to others."
            raise Refused(Notice(Code.GATEWAY_FULL, said, max=MAX_VISITORS))
        self._leave(key)


def _key(operator: Operator, client_id: str) -> _Key:
    identity = operator.identity
    return operator.address.rpartition(":")[0], identity.id if identity.proven else "", client_id
