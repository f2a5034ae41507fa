"""Subscriptions, advertisements, services and actions of a client, renewed after each reconnect."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from msgspec import UNSET

from bridge.client.client_goals import part_of
from bridge.client.service_provider import Call, Run, ServiceProvider
from bridge.msgs import Msg, ros1_name
from bridge.protocol import ClientSession, Op, Reduction, Subscribe

__all__ = ["Registrations"]

M = TypeVar("M", bound=Msg)


class Registrations:
    """The part of a client that says what it wants and what it offers."""

    def __init__(self, session: ClientSession, foreign: Callable[[], bool]) -> None:
        """`foreign` tells whether the server is not one of ours."""
        self._session = session
        self._provider = ServiceProvider(session, self._send, foreign)

    def _send(self, op: Op) -> bool:
        """Send now; False without a connection."""
        raise NotImplementedError

    def subscribe(
        self,
        topic: str,
        type: type[M],
        callback: Callable[[M, float], object],
        *,
        throttle_rate: int = 0,
        queue_length: int = 1,
        compression: str = "none",
        fragment_size: int | None = None,
        reduce: Reduction | None = None,
    ) -> Callable[[], None]:
        """Subscribe `topic`; returns the unsubscriber.

        `callback(msg, received)` is called for each message, `received` on the client's clock [s]. `throttle_rate` is the
        shortest time between two messages [ms]; `compression` is one of `protocol.COMPRESSIONS`, of which `png` needs Pillow;
        `fragment_size` is the longest text frame [characters]. `reduce` asks for less of each message, which only our servers
        can do: fields that were left out have their defaults. A message that does not fit `type` is logged and skipped.
        """
        wanted = Subscribe(
            topic=topic,
            type=type.MSGTYPE,
            throttle_rate=throttle_rate,
            queue_length=queue_length,
            compression=compression,
            fragment_size=UNSET if fragment_size is None else fragment_size,  # rosbridge_server refuses null
            reduce=reduce,
        )
        first, last = self._session.subscribe(wanted, type, callback)
        self._send(first)

        def unsubscribe() -> None:
            if self._session.unsubscribe(last):
                self._send(last)

        return unsubscribe

    def advertise(self, topic: str, type: type[Msg], *, latch: bool = False) -> None:
        """Announce that this client publishes on `topic`, which foreign servers require before the first message.

        With `latch` later subscribers get the last message at once.
        """
        self._send(self._session.advertise(topic, type, latch=latch))

    def unadvertise(self, topic: str) -> None:
        """Announce that this client no longer publishes on `topic`."""
        if op := self._session.unadvertise(topic):
            self._send(op)

    def serve(
        self, service: str, type: str, call: Call, *, request: type[Msg] | None = None
    ) -> Callable[[], None]:
        """Answer calls of `service`, of ROS type `type`, from now on; returns a function that ends it.

        `call(request)` returns the response at once or as an awaitable; it raises Refused with a sentence to refuse. `request`
        is needed for types that are not in `bridge.msgs.TYPES`; ProtocolError without.
        """
        name = ros1_name(type)
        kind = request or part_of(name, "Request")
        self._send(self._provider.serve(service, name, kind, call))

        def end() -> None:
            if op := self._session.stop_serving(service):
                self._send(op)

        return end

    def provide_action(
        self, action: str, type: str, run: Run, *, goal: type[Msg] | None = None
    ) -> Callable[[], None]:
        """Carry out goals of `action`, of ROS type `type`, from now on; returns a function that ends it.

        `run(goal, on_feedback)` returns the result when it is done and calls `on_feedback(feedback)` meanwhile; it is cancelled
        when the goal is cancelled or the connection is lost, and raises Refused with a sentence to refuse. `goal` is needed for
        types that are not in `bridge.msgs.TYPES`; ProtocolError without.
        """
        name = ros1_name(type)
        self._send(self._provider.provide(action, name, goal or part_of(name, "Goal"), run))

        def end() -> None:
            if op := self._session.stop_providing(action):
                self._send(op)

        return end
