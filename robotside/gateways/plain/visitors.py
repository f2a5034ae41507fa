"""Clients without a connection of their own, as those of a broker: they come and go, and are known by host, name and token."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from functools import lru_cache

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.plain.known_clients import MAX_VISITORS, SILENT_TIMEOUT, KnownClients
from robotside.gateways.plain.visitor import Visitor
from robotside.trust.attempt_limit import host_of

__all__ = ["SHARE_OF_HOST", "Visitors"]

SHARE_OF_HOST = 16
"""Clients without a key of one host at a time, where hosts are known: names can be made up."""


class Visitors(KnownClients[tuple[str, str, str]]):
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
        hosts: bool = False,
    ) -> None:
        """They come by the gateway `way` from the broker at `address`, `HOST:PORT`, and reach the payloads `keys`.

        `role` is that of who shows no token, None where the address decides. Who does not come from the broker has an address
        of its own; where all do (`hosts`), those of one host without a key have a share of the places, and
        nothing proves the address.
        """
        super().__init__(door)
        self._way, self._address, self._keys = way, address, keys
        self._role, self._secure, self._hosts = role, secure, hosts

    def visit(self, name: str, token: str = "", address: str = "") -> Visitor:
        """The client of that name and token, from whom a message came. Raises Refused for a wrong token, or without room.

        Who has a key, or else a higher role, takes the place of the quietest of the lowest where there is no room.
        """
        key = (_host(address), name, token)
        visitor = self._known.get(key)
        if visitor is None:
            visitor = self.newcomer(name, token, address)
            try:
                self._make_room(key[0], self._rank(visitor))
            except Refused:
                visitor.leave()
                raise
            self._keep(key, visitor)
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
            forgeable=self._hosts,
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

    def _rank(self, visitor: Visitor) -> tuple[bool, Role]:
        operator = visitor.operator
        return operator.identity.proven, operator.role(self._door.now())

    def _make_room(self, host: str, rank: tuple[bool, Role]) -> None:
        """Have room for a newcomer from `host`; raises Refused without any."""
        if self._hosts and not rank[0]:
            source = _machine(host)
            there = [
                key
                for key, each in self._known.items()
                if _machine(key[0]) == source and not each.operator.identity.proven
            ]
            if len(there) >= SHARE_OF_HOST and not self._displace(there, rank):
                said = f"{SHARE_OF_HOST} clients of your address use this gateway already; show a token, or use STOP only."
                raise Refused(Notice(Code.GATEWAY_FULL, said, max=SHARE_OF_HOST))
        if len(self._known) >= MAX_VISITORS and not self._displace(self._known, rank):
            said = f"{MAX_VISITORS} clients use this gateway already; only STOP is answered to others."
            raise Refused(Notice(Code.GATEWAY_FULL, said, max=MAX_VISITORS))

    def _displace(self, keys: Iterable[tuple[str, str, str]], rank: tuple[bool, Role]) -> bool:
        """Whether one of `keys` leaves for a newcomer of that `rank`: the quietest of the lowest rank.

        One of its own rank does when it is silent, a higher one never.
        """
        ranks = {key: self._rank(self._known[key]) for key in keys}
        lowest = min(ranks.values())
        heard = {key: self._known[key].operator.last_heard for key in ranks if ranks[key] == lowest}
        quietest = min(heard, key=lambda key: heard[key])
        silent = self._door.now() - heard[quietest] >= SILENT_TIMEOUT
        yields = lowest < rank or (lowest == rank and silent)
        if yields:
            self._leave(quietest)
        return yields


def _host(address: str) -> str:
    """The host of `HOST:PORT`: programs that send one message each have another port each time."""
    return address.rpartition(":")[0]


@lru_cache(maxsize=256)
def _machine(host: str) -> str:
    """What has as many addresses as it likes is one, as a network of IPv6."""
    return host_of(f"{host}:0")
