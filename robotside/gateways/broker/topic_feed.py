"""A robot's topics on their way to a broker: the newest of each at a rate, numbered so that a reader sees what was lost."""

from __future__ import annotations

import asyncio
import logging
import math
from collections import Counter
from collections.abc import Awaitable, Callable, Iterator
from functools import partial
from typing import NamedTuple, TypeVar

import msgspec

from bridge.codec import to_json
from bridge.core.async_tasks import wait
from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.outbox import Outbox
from robotside.gateways.plain.visitor import Visitor

__all__ = ["Sent", "TopicFeed"]

_R = TypeVar("_R")

log = logging.getLogger(__name__)

MAX_READS = 64
"""Topics on demand that one client may ask for at a time."""


class Sent(NamedTuple):
    """A message of the robot."""

    name: str
    """Absolute name of the topic."""
    payload: bytes
    """JSON."""
    number: int
    """How many of this topic were sent before since the birth."""
    latched: bool
    """The newest counts for who comes later."""


class TopicFeed:
    """What a gateway publishes; sends only while the broker is there."""

    def __init__(self, door: StationDoor, way: str, url: GatewayUrl, role: Role | None) -> None:
        """It goes by the gateway `way` to who has the `role`, None for that of the broker's address."""
        self._door, self._way, self._url, self._role = door, way, url, role
        self._outbox = Outbox(1 / url.rate)
        self._wake = asyncio.Event()
        self._numbers: Counter[str] = Counter()
        self._births = 0

    def audience(self) -> Role:
        """The role of who reads along."""
        return self._with_audience(lambda operator: operator.role(self._door.now()))

    def names(self) -> list[str]:
        """The topics that `begin` publishes, and those that are made on demand."""
        return self._with_audience(lambda operator: [each.name for each in self._carried(operator)])

    def birth(self) -> bytes:
        """What is published from `begin` on, as JSON: each topic with its ROS type, and by what number each of them begins."""
        self._births += 1
        health = self._door.health
        topics = {
            each.name: {"type": each.type.MSGTYPE, "rate": each.rate, "latched": each.latched}
            | ({"on_demand": True} if each.on_demand else {})
            for each in self._with_audience(lambda operator: list(self._carried(operator)))
        }
        return msgspec.json.encode(
            {
                "robot": health.robot,
                "boot": health.boot,
                "birth": self._births,
                "time": self._door.now(),
                "seq": 0,
                "topics": topics,
            }
        )

    def begin(self) -> None:
        """The broker is there: publish."""
        self._numbers.clear()
        for topic in self._with_audience(lambda operator: list(self._carried(operator))):
            if not topic.on_demand:
                self._door.subscribe(self, topic.name, partial(self._put, topic), wanted=False)

    def end(self) -> None:
        """The broker is gone: nothing waits for it."""
        self._door.leave(self)
        self._outbox.clear()

    def read(self, visitor: Visitor, name: str) -> str:
        """A client asks for a topic that is made on demand, or for pictures; what it is told. Raises Refused.

        It is published for as long as one of those who asked for it is there.
        """
        if key_of(name) not in self._url.keys:
            said = f"This gateway does not carry {name[:100]}."
            raise Refused(Notice(Code.GATEWAY_LEFT_OUT, said, operation=name[:100]))
        self._door.check(visitor.operator, "subscribe", name)
        topic = self._door.topics.get(name)
        if topic is not None and topic.to == "robot":
            raise Refused(f"This robot does not publish on {name[:100]}, it listens there.")
        if topic is not None and not topic.on_demand:
            return f"{name} comes without being asked for."
        if name not in visitor.reads:
            if len(visitor.reads) >= MAX_READS:
                raise Refused(f"{MAX_READS} topics are read by this client already.")
            topic = topic or Topic(
                name, CompressedImage, self._url.rate, "handheld", "pictures", on_demand=True
            )
            put = partial(self._put, topic)
            visitor.reads[name] = self._door.subscribe(visitor.operator, name, put)
        return f"{name} comes while you are there; say something once a minute."

    async def run(self, send: Callable[[Sent], Awaitable[None]]) -> None:
        """Publish what the robot says, as fast as the broker takes it, until cancelled."""
        clock = asyncio.get_running_loop().time
        while True:
            found = self._outbox.take(clock())
            if found is None:
                left = self._outbox.wait(clock())
                await wait(self._wake, None if math.isinf(left) else left)
                continue
            name, msg = found
            payload, topic = _written(name, msg), self._door.topics.get(name)
            if payload:
                number = self._numbers[name]
                self._numbers[name] += 1
                await send(Sent(name, payload, number, topic is not None and topic.latched))

    def _with_audience(self, call: Callable[[Operator], _R]) -> _R:
        """What `call` gives for somebody who shows no token."""
        operator = self._door.join(self._url.address, way=self._way, role=self._role)
        try:
            return call(operator)
        finally:
            self._door.leave(operator)

    def _carried(self, audience: Operator) -> Iterator[Topic]:
        """What the robot publishes here for who shows no token, with what it makes on demand."""
        for topic in self._door.topics.values():
            if topic.to == "robot" or key_of(topic.name) not in self._url.keys:
                continue
            if self._door.permits(audience, "subscribe", topic.name):
                yield topic

    def _put(self, topic: Topic, name: str, msg: Msg) -> None:
        self._outbox.put(topic, msg)
        self._wake.set()


def _written(name: str, msg: Msg) -> bytes:
    """The message as JSON; empty for one that cannot be written, which is logged and ends no other."""
    try:
        return to_json(msg)
    except Exception:
        log.exception("A message on %s cannot be written as JSON", name)
        return b""
