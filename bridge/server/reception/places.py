"""Places on one listening socket: who gets one, who gives his up for a newcomer, and the reserve that only STOP can use."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

__all__ = ["FULL", "SILENT_TIMEOUT", "Limits", "Place", "Places", "Standing"]

FULL = "All places of this robot are taken; on this connection only STOP is answered."
"""Said to who is on the reserve."""
SILENT_TIMEOUT = 5.0
"""A connection that sent nothing for this long may be dead, and yields to the same person or machine [s]."""


class Limits(NamedTuple):
    """How many connections one socket has at a time."""

    total: int = 128
    """All places but the reserve."""
    per_address: int = 96
    """Places of one address, without those who proved who they are."""
    per_identity: int = 16
    """Places of one person who proved who it is."""
    reserve: int = 16
    """Places beyond `total`, on which only STOP is answered."""


class Standing(IntEnum):
    """What a connection has shown of itself."""

    STRANGER = 0
    """Nothing, or that it may nothing but STOP."""
    KNOWN = 1
    """It has a role by the address it came from."""
    PROVEN = 2
    """It proved by a key whose connection it is."""


@dataclass(slots=True, eq=False)
class Place:
    """The place of one connection, from the moment it was accepted."""

    host: str
    """The address it came from, without the port."""
    give_up: Callable[[], None]
    """Cuts the connection, for somebody else to have its place."""
    heard: float
    """When something came of it [s, the clock of its `Places`]."""
    number: int
    """Later ones have larger numbers."""
    places: Places
    standing: Standing = Standing.STRANGER
    identity: str = ""
    """Public id of the person who proved to be at its other end."""
    asked: bool = False
    """It has asked for something, or is being answered."""
    only_stop: bool = False
    """It is on a place of the reserve: nothing but STOP and the time is answered."""

    @property
    def is_idle(self) -> bool:
        """It is given up for a newcomer: nobody knows it, or it has asked for nothing."""
        return self.standing is Standing.STRANGER or (self.standing is Standing.KNOWN and not self.asked)

    def hear(self) -> None:
        """Something came of it."""
        self.heard = self.places.clock()

    def meet(self, identity: str, *, proven: bool) -> None:
        """It has a role, with the public id `identity` when that was `proven`; from the reserve it moves up if it can."""
        self.places.meet(self, identity, proven=proven)

    def leave(self) -> None:
        """The connection is gone."""
        self.places.leave(self)


class Places:
    """The places of one listening socket."""

    def __init__(self, limits: Limits, clock: Callable[[], float] = time.monotonic) -> None:
        """`clock` only goes forward [s]."""
        self.limits = limits
        self.clock = clock
        self._taken: dict[Place, None] = {}
        self._reserve: dict[Place, None] = {}
        self._number = 0

    def __len__(self) -> int:
        return len(self._taken) + len(self._reserve)

    def arrive(self, host: str, give_up: Callable[[], None]) -> Place:
        """The place of a connection that was accepted just now; when all others are taken, one of the reserve.

        `give_up` cuts it when its place is needed more.
        """
        self._number += 1
        place = Place(host, give_up, self.clock(), self._number, self)
        if self._is_room(host) or self._give_up_idle(host):
            self._taken[place] = None
            return place
        if len(self._reserve) >= self.limits.reserve:
            self._give_up(self._least(self._reserve))
        place.only_stop = True
        self._reserve[place] = None
        return place

    def meet(self, place: Place, identity: str, *, proven: bool) -> None:
        """See `Place.meet`."""
        place.standing = Standing.PROVEN if proven else Standing.KNOWN
        place.identity = identity if proven else ""
        if place not in self._taken and place not in self._reserve:
            return
        if proven:
            own = [each for each in self._taken if each.identity == identity and each is not place]
            if len(own) >= self.limits.per_identity:
                self._give_up(min(own, key=_quietest))
        if place.only_stop and self._make_room_for(place):
            del self._reserve[place]
            place.only_stop = False
            self._taken[place] = None

    def leave(self, place: Place) -> None:
        """See `Place.leave`."""
        self._taken.pop(place, None)
        self._reserve.pop(place, None)

    def give_up_all(self) -> None:
        """Cut every connection."""
        for place in [*self._taken, *self._reserve]:
            self._give_up(place)

    def _is_room(self, host: str, *, proven: bool = False) -> bool:
        if len(self._taken) >= self.limits.total:
            return False
        return proven or self._counts()[host] < self.limits.per_address

    def _counts(self) -> Counter[str]:
        """Places of each address; who proved who it is does not count for its address."""
        return Counter(each.host for each in self._taken if each.standing is not Standing.PROVEN)

    def _give_up_idle(self, host: str) -> bool:
        """Make room for a newcomer from `host`; False when everybody who could go has something to do."""
        idle = [each for each in self._taken if each.is_idle]
        if self._counts()[host] >= self.limits.per_address:
            idle = [each for each in idle if each.host == host]
        if not idle:
            return False
        self._give_up(self._least(idle))
        return True

    def _make_room_for(self, place: Place) -> bool:
        """Make room for one who has a role and stands on the reserve; False when there is none."""
        proven = place.standing is Standing.PROVEN
        if self._is_room(place.host, proven=proven) or self._give_up_idle(place.host):
            return True
        now, counts = self.clock(), self._counts()
        same = [
            each
            for each in self._taken
            if (each.identity == place.identity if proven else each.host == place.host)
            and each.standing <= place.standing
            and now - each.heard >= SILENT_TIMEOUT
        ]
        if not same and (proven or counts[place.host] < self.limits.per_address):
            most = max(counts.values(), default=0)
            same = [
                each
                for each in self._taken
                if each.standing is not Standing.PROVEN
                and counts[each.host] == most
                and (proven or most > counts[place.host] + 1)
            ]
        if not same:
            return False
        self._give_up(min(same, key=_quietest))
        return True

    def _least(self, places: Iterable[Place]) -> Place:
        """The place that is needed least: of the address with the most of these, of least standing, the oldest."""
        among = list(places)
        counts = Counter(each.host for each in among)
        return min(among, key=lambda each: (-counts[each.host], each.standing, each.number))

    def _give_up(self, place: Place) -> None:
        self.leave(place)
        place.give_up()


def _quietest(place: Place) -> tuple[float, int]:
    return place.heard, place.number
