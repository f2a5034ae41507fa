"""What a client remembers about its server, without I/O."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import msgspec
from msgspec import Raw

from bridge.msgs import Msg
from bridge.protocol.ops import Advertise, CallService, Id, Op, ServiceResponse, Subscribe, Unsubscribe

__all__ = ["ClientSession", "Subscription"]


@dataclass(frozen=True, slots=True)
class Subscription:
    """One subscription of a client, remembered over reconnects."""

    op: Subscribe
    type: type[Msg]
    callback: Callable[[Any, float], object]
    """Takes the message and when it was received [s], the client's clock."""


@dataclass(slots=True)
class ClientSession:
    """What a client remembers: its subscriptions and advertisements for ever, its calls until answered."""

    subscriptions: dict[str, dict[Id, Subscription]] = field(default_factory=dict)
    """By topic and id."""
    advertised: dict[str, Advertise] = field(default_factory=dict)
    """By topic."""
    calls: dict[Id, Callable[[ServiceResponse | None], None]] = field(default_factory=dict)
    """What to do with each answer that is still to come, by id."""
    _numbers: Iterator[int] = field(default_factory=lambda: itertools.count(1))

    def subscribe(
        self, op: Subscribe, type: type[Msg], callback: Callable[[Any, float], object]
    ) -> tuple[Subscribe, Unsubscribe]:
        """Remember a subscription; gives what to send now and what to send at its end."""
        named = msgspec.structs.replace(op, id=f"subscribe:{op.topic}:{next(self._numbers)}")
        self.subscriptions.setdefault(op.topic, {})[named.id] = Subscription(named, type, callback)
        return named, Unsubscribe(topic=op.topic, id=named.id)

    def unsubscribe(self, op: Unsubscribe) -> bool:
        """Forget a subscription; False when it was forgotten before."""
        of_topic = self.subscriptions.get(op.topic, {})
        known = of_topic.pop(op.id, None) is not None
        if not of_topic:
            self.subscriptions.pop(op.topic, None)
        return known

    def advertise(self, topic: str, type: type[Msg]) -> Advertise:
        """Remember that this client publishes on `topic`; gives what to send now."""
        op = Advertise(topic=topic, type=type.MSGTYPE, id=f"advertise:{topic}")
        self.advertised[topic] = op
        return op

    def call(
        self, service: str, args: bytes, answer: Callable[[ServiceResponse | None], None]
    ) -> CallService:
        """Remember a call; gives what to send now.

        `answer` is called once at most, with None when the connection is lost first.
        """
        op = CallService(service=service, args=Raw(args), id=f"call:{service}:{next(self._numbers)}")
        self.calls[op.id] = answer
        return op

    def answered(self, op: ServiceResponse) -> bool:
        """Pass an answer to whoever waits for it; False when nobody does."""
        answer = self.calls.pop(op.id, None)
        if answer is not None:
            answer(op)
        return answer is not None

    def lose(self) -> None:
        """The connection is gone, and with it all answers."""
        calls, self.calls = self.calls, {}
        for answer in calls.values():
            answer(None)

    def opening(self) -> Iterator[Op]:
        """Everything to say on a new connection."""
        yield from self.advertised.values()
        for of_topic in self.subscriptions.values():
            for subscription in of_topic.values():
                yield subscription.op

    def subscribers(self, topic: str) -> list[Subscription]:
        """Who wants a message on `topic`."""
        return list(self.subscriptions.get(topic, {}).values())
