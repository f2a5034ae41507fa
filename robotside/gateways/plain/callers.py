"""Clients of requests that stand alone: who gives the same id is the same client in the next one, and keeps control until then."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable
from typing import NamedTuple

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator
from bridge.server.reception.reception import neighbourhood
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.plain.known_clients import MAX_VISITORS, SILENT_TIMEOUT, KnownClients
from robotside.gateways.plain.visitor import Visitor

__all__ = ["MAX_OF_HOST", "Callers", "stand_in"]

MAX_OF_HOST = 16
"""Clients of one host without a key: whoever makes up ids takes no more places than these."""


class _Key(NamedTuple):
    """By what a client is known."""

    host: str
    person: str
    """The proven identity; empty for none."""
    client: str
    """The id that it gives."""


def stand_in(door: StationDoor, operator: Operator) -> Operator:
    """Another operator at the door for the person of `operator`, who stays when that one's request is answered."""
    identity = operator.identity
    other = door.join(operator.address, way=operator.way, secure=operator.secure, role=identity.role)
    other.identity = identity
    return other


class Callers(KnownClients[_Key]):
    """Those that asked lately."""

    def __init__(self, door: StationDoor, keys: Collection[str]) -> None:
        """They reach the payloads `keys`."""
        super().__init__(door)
        self._keys = keys

    def visit(
        self, operator: Operator, client_id: str, stay: Callable[[Operator], Operator], name: str = ""
    ) -> Visitor:
        """The client behind a request of `operator`. Raises Refused without room.

        `stay(operator)` is the operator of one that is new, for as long as it is known; `name` is how it calls itself. One whose
        role is another one than before begins anew: what it had, it has no more.
        """
        key = _key(operator, client_id)
        visitor = self._known.get(key)
        if visitor is not None and visitor.operator.identity != operator.identity:
            self._leave(key)
            visitor = None
        if visitor is None:
            self._make_room(key.host, operator)
            visitor = self.newcomer(stay(operator), name)
            self._keep(key, visitor)
        visitor.heard()
        return visitor

    def newcomer(self, operator: Operator, name: str = "") -> Visitor:
        """A client for one request."""
        # how long the request lay on its way nobody knows: without a stamp it drives nothing
        operator.answered = -math.inf
        return Visitor(self._door, operator, self._keys, name)

    def leave(self, operator: Operator, client_id: str) -> None:
        """That client is gone, if it was there."""
        self._leave(_key(operator, client_id))

    def _make_room(self, host: str, newcomer: Operator) -> None:
        if not newcomer.identity.proven:
            near = neighbourhood(host)
            keyless = [key for key in self._known if neighbourhood(key.host) == near and not key.person]
            if len(keyless) >= MAX_OF_HOST:
                self._displace(keyless, newcomer, f"{MAX_OF_HOST} clients without a key of your computer use")
        if len(self._known) >= MAX_VISITORS:
            self._displace(self._known, newcomer, f"{MAX_VISITORS} clients use")

    def _displace(self, among: Iterable[_Key], newcomer: Operator, full: str) -> None:
        """One of them leaves: who is silent, or else who may less than the newcomer; of several the least, and the quietest."""
        now = self._door.now()

        def rank(operator: Operator) -> tuple[bool, int]:
            return operator.identity.proven, int(operator.role(now))

        heard = {key: self._known[key].operator for key in among}
        silent = {key: each for key, each in heard.items() if now - each.last_heard >= SILENT_TIMEOUT}
        least = silent or {key: each for key, each in heard.items() if rank(each) < rank(newcomer)}
        if not least:
            said = f"{full} this gateway already; only STOP is answered to others."
            raise Refused(Notice(Code.GATEWAY_FULL, said, max=len(heard)))
        self._leave(min(least, key=lambda key: (rank(least[key]), least[key].last_heard)))


def _key(operator: Operator, client_id: str) -> _Key:
    identity = operator.identity
    host = operator.address.rpartition(":")[0]
    return _Key(host, identity.id if identity.proven else "", client_id)
