"""Clients without a connection of their own, as those of a broker: they come and go, and are known by host, name and token."""

from __future__ import annotations

import math
from collections.abc import Collection

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.plain.visitor import Visitor

__all__ = ["IDLE_TIMEOUT", "MAX_VISITORS", "Visitors"]

MAX_VISITORS = 64
"""Clients of one gateway at a time."""
IDLE_TIMEOUT = 60.0
"""A client that is silent for this long is gone [s]; its control has lapsed long before."""
SILENT_TIMEOUT = 5.0
"""One that is silent for this long yields to a newcomer where all places are taken [s]."""


class Visitors:
    """The clients that a broker passes on."""

    def __init__(
        self,
        door: StationDoor,
        way: str,
        address: str,
        keys: Collection[str],
        *,
        role: Role | None,
        secure: bool,
    ) -> None:
        """They come by the gateway `way` from the broker at `address`, `HOST:PORT`, and reach the payloads `keys`.

        `role` is that of who shows no token, None where the address decides. Who does not come from the broker has an address
        of its own.
        """
        self._door, self._way, self._address, self._keys = door, way, address, keys
        self._role, self._secure = role, secure
        self._known: dict[tuple[str, str, str], Visitor] = {}

    def __len__(self) -> int:
        return len(self._known)

    def visit(self, name: str, token: str = "", address: str = "") -> Visitor:
        """The client of that name and token, from whom a message came. Raises Refused for a wrong token, or without room."""
        key = (_host(address), name, token)
        visitor = self._known.get(key)
        if visitor is None:
            self._make_room()
            visitor = self._known[key] = self.newcomer(name, token, address)
            visitor.operator.on_expelled = lambda: self._leave(key)
        visitor.heard()
        return visitor

    def newcomer(self, name: str, token: str = "", address: str = "") -> Visitor:
        """A client that is not remembered, for one message; `leave` it afterwards. Raises Refused for a wrong token."""
        operator = self._door.join(
            address or self._address,
            way=self._way,
            secure=self._secure,
            token=token,
            trusted=True,
            role=self._role,
            client="" if address else name,  # who has an address of its own chooses its name
        )
        # how long a broker kept what comes next nobody knows: without a stamp it drives nothing
        operator.answered = -math.inf
        return Visitor(self._door, operator, self._keys, name)

    def leave(self, visitor: Visitor) -> None:
        """This client is gone."""
        visitor.leave()

    def leave_name(self, name: str, token: str = "", address: str = "") -> None:
        """The client of that name and token is gone, if it was there."""
        self._leave((_host(address), name, token))

    def leave_silent(self) -> None:
        """Clients that are silent for `IDLE_TIMEOUT` are gone; to be called every second or so."""
        now = self._door.now()
        for key, visitor in list(self._known.items()):
            if now - visitor.operator.last_heard > IDLE_TIMEOUT:
                self._leave(key)

    def leave_all(self) -> None:
        """The broker is gone, and all of them with it: a robot that one of them drives stops."""
        for key in list(self._known):
            self._leave(key)

    def _leave(self, key: tuple[str, str, str]) -> None:
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


def _host(address: str) -> str:
    """The host of `HOST:PORT`: programs that send one message each have another port each time."""
    return address.rpartition(":")[0]
