"""Clients by REST: each request comes by itself, and what they have, control above all, is theirs from one to the next."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import NamedTuple

from starlette.requests import Request

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.http.asker import operator_of
from robotside.gateways.http.mounts import STAYS
from robotside.gateways.plain.visitor import Visitor
from robotside.gateways.plain.visitors import IDLE_TIMEOUT, MAX_VISITORS, SILENT_TIMEOUT

__all__ = ["Clients"]


class _Key(NamedTuple):
    """By what a client is known."""

    person: str
    host: str
    client: str


class Clients:
    """Those that asked lately."""

    def __init__(self, door: StationDoor, keys: Collection[str]) -> None:
        """They reach the payloads `keys`."""
        self._door, self._keys = door, keys
        self._known: dict[_Key, Visitor] = {}

    def __len__(self) -> int:
        return len(self._known)

    def visit(self, request: Request, client_id: str, name: str) -> Visitor:
        """Who asks, as the person, address and `client_id` tell. Raises Refused without room.

        One whose role is another one than before begins anew: what it had, it has no more.
        """
        operator = operator_of(request)
        key = _Key(operator.identity.id, operator.address.rpartition(":")[0], client_id)
        known = self._known.get(key)
        if known is not None and known.operator.identity != operator.identity:
            self._leave(key)
            known = None
        if known is None:
            self._make_room()
            known = self._known[key] = self._newcomer(request, operator, client_id)
            operator.on_expelled = lambda: self._leave(key)
        known.name = name or known.name
        known.heard()
        return known

    def passing(self, request: Request) -> Visitor:
        """Who asks for something that leaves nothing behind."""
        return Visitor(self._door, operator_of(request), self._keys)

    def _newcomer(self, request: Request, operator: Operator, client_id: str) -> Visitor:
        setattr(request.state, STAYS, True)
        # the network may keep a request for any time: without a stamp it drives nothing
        operator.answered = -math.inf
        return Visitor(self._door, operator, self._keys, client_id)

    def leave_silent(self) -> None:
        """Those that were silent for long are gone."""
        now = self._door.now()
        for key, each in list(self._known.items()):
            if now - each.operator.last_heard > IDLE_TIMEOUT:
                self._leave(key)

    def leave_all(self) -> None:
        """All of them are gone."""
        for key in list(self._known):
            self._leave(key)

    def _leave(self, key: _Key) -> None:
        known = self._known.pop(key, None)
        if known is not None:
            known.leave()

    def _make_room(self) -> None:
        if len(self._known) < MAX_VISITORS:
            return
        key, quietest = min(self._known.items(), key=lambda each: each[1].operator.last_heard)
        if self._door.now() - quietest.operator.last_heard < SILENT_TIMEOUT:
            said = f"{MAX_VISITORS} clients use this gateway already; only STOP is answered to others."
            raise Refused(Notice(Code.GATEWAY_FULL, said, max=MAX_VISITORS))
        self._leave(key)
