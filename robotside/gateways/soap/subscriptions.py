"""Subscriptions: what came waits, bounded, until it is fetched; of each topic the newest, and each event.

Each ends by itself when nobody fetches it or lets it live on. Who opened one must have the role for its topics all the time.
"""

from __future__ import annotations

import asyncio
import math
import secrets
from collections.abc import Callable, Collection, Sequence
from functools import partial

from bridge.core.async_tasks import wait
from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.callers import stand_in
from robotside.gateways.plain.outbox import Outbox

__all__ = ["LIFETIME", "MAX_PER_HOST", "MAX_SUBSCRIPTIONS", "Subscribed", "Subscriptions", "readable"]

LIFETIME = 60.0
"""A subscription ends when it was not fetched or renewed for this long [s]."""
MAX_SUBSCRIPTIONS = 64
"""Of one gateway at a time."""
MAX_PER_HOST = 16
"""Of one address at a time."""

News = tuple[Topic, Msg]
Clock = Callable[[], float]


def readable(door: StationDoor, keys: Collection[str], operator: Operator, name: str) -> Topic:
    """The robot's topic of that name, that `operator` may read; raises Refused for any other, and for one that is not carried."""
    topic = door.topics.get(name)
    if topic is None or topic.to == "robot":
        raise Refused(f"This robot has no topic {name[:100]!r} to read.")
    if key_of(name) not in keys:
        said = f"This gateway does not carry {name[:100]}."
        raise Refused(Notice(Code.GATEWAY_LEFT_OUT, said, operation=name[:100]))
    door.check(operator, "subscribe", name)
    return topic


class Subscribed:
    """One subscription."""

    def __init__(
        self, door: StationDoor, operator: Operator, topics: Sequence[Topic], period: float, lifetime: float
    ) -> None:
        """For `operator`, that has joined for it alone; of each topic at most one message in each `period` [s]."""
        self.id = secrets.token_urlsafe(12)
        """Nobody guesses it."""
        self.operator = operator
        self.lifetime = lifetime
        """It ends so long after it was renewed [s]."""
        self.until = math.inf
        """When it ends, by the loop's clock [s]."""
        self.wake = asyncio.Event()
        """Something came."""
        self._door, self._topics = door, {topic.name: topic for topic in topics}
        self._outbox = Outbox(period)
        self.renew()
        for topic in topics:
            door.subscribe(operator, topic.name, partial(self._put, topic))

    def _put(self, topic: Topic, _: str, msg: Msg) -> None:
        self._outbox.put(topic, msg)
        self.wake.set()

    def renew(self) -> None:
        """It lives on."""
        self.until = asyncio.get_running_loop().time() + self.lifetime

    def check(self) -> None:
        """Raises Refused when its owner may not read one of its topics any more."""
        for name in self._topics:
            self._door.check(self.operator, "subscribe", name)

    def take(self) -> list[News]:
        """All that is due."""
        now, found = asyncio.get_running_loop().time(), []
        while (sent := self._outbox.take(now)) is not None:
            found.append((self._topics[sent[0]], sent[1]))
        return found

    async def news(self, patience: float) -> list[News]:
        """All that is due, or what comes first within `patience` [s]; empty when nothing does."""
        clock = asyncio.get_running_loop().time
        end = clock() + patience
        while not (found := self.take()) and (left := end - clock()) > 0:
            await wait(self.wake, min(left, self._outbox.wait(clock())))
        return found


class Subscriptions:
    """All subscriptions of one gateway."""

    def __init__(self, door: StationDoor, keys: Collection[str], period: float) -> None:
        """To topics of the payloads `keys`, as of `Subscribed`."""
        self._door, self._keys, self._period = door, keys, period
        self._open: dict[str, Subscribed] = {}
        self.on_end: Callable[[Subscribed], None] = lambda _: None
        """Called with each that has ended."""

    def __len__(self) -> int:
        return len(self._open)

    def open(self, operator: Operator, names: Collection[str], lifetime: float = LIFETIME) -> Subscribed:
        """Subscribe `operator`, or who stands in for it, to the topics of these names. Raises Refused for what may not be."""
        topics = [readable(self._door, self._keys, operator, name) for name in dict.fromkeys(names)]
        host = _host(operator)
        own = sum(_host(each.operator) == host for each in self._open.values())
        if len(self._open) >= MAX_SUBSCRIPTIONS or own >= MAX_PER_HOST:
            most = MAX_PER_HOST if own >= MAX_PER_HOST else MAX_SUBSCRIPTIONS
            said = f"There are {most} subscriptions already; end one of them, or wait for {LIFETIME:g} s."
            raise Refused(Notice(Code.GATEWAY_FULL, said, max=most))
        other = stand_in(self._door, operator)
        try:
            made = Subscribed(self._door, other, topics, self._period, lifetime)
        except BaseException:
            self._door.leave(other)
            raise
        other.on_expelled = partial(self.end, made)
        self._open[made.id] = made
        return made

    def find(self, id: str) -> Subscribed:
        """The subscription with that id, which lives on. Raises Refused for one that is over, or may not be read any more."""
        found = self._open.get(id)
        if found is None:
            raise Refused("There is no such subscription; it has ended, or there never was one.")
        try:
            found.check()
        except Refused:
            self.end(found)
            raise
        found.renew()
        return found

    def end(self, subscribed: Subscribed) -> None:
        """It is over; nothing happens when it was already."""
        if self._open.pop(subscribed.id, None) is not None:
            self._door.leave(subscribed.operator)
            self.on_end(subscribed)

    def end_overdue(self) -> None:
        """Those that nobody renewed are over."""
        now = asyncio.get_running_loop().time()
        for each in [each for each in self._open.values() if each.until < now]:
            self.end(each)

    def end_all(self) -> None:
        """All are over."""
        for each in list(self._open.values()):
            self.end(each)


def _host(operator: Operator) -> str:
    return operator.address.rpartition(":")[0]
