"""Clients that observe topics: how many there may be, what each is sent, and when it is over."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from typing import Any

from aiocoap.message import Message
from aiocoap.numbers.codes import Code as CoapCode

from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from robotside.door.station_door import StationDoor
from robotside.gateways.coap.blocks import BlocksOut
from robotside.gateways.coap.datagrams import DatagramSocket, Tuning
from robotside.gateways.coap.observation import Observation
from robotside.gateways.coap.requests import JSON, Asked, Body, address_of, body_of, failure, key_of_request
from robotside.gateways.gateway_url import MAX_RATE
from robotside.gateways.plain.visitors import Visitors

__all__ = ["FIRST_TIMEOUT", "MAX_OBSERVERS", "MAX_OBSERVERS_OF_HOST", "Observers"]

MAX_OBSERVERS, MAX_OBSERVERS_OF_HOST = 64, 16
"""Observations at a time, and those of one host; beyond them a client is answered once, as CoAP has it."""
FIRST_TIMEOUT = 10.0
"""For the first message of a topic that is made on demand [s]."""
_NUMBERS = 1 << 24
"""Of notifications; they begin anew then."""


class _Confirmed(Tuning):
    reliability = True


class _Unconfirmed(Tuning):
    reliability = False


class Observers:
    """All observations of one gateway."""

    def __init__(
        self,
        door: StationDoor,
        clients: Visitors,
        rate: float,
        blocks: BlocksOut,
        clock: Callable[[], float],
    ) -> None:
        """`rate` is that of who observes without one [Hz]; `clock` only goes forward [s]."""
        self._door, self._clients, self._rate = door, clients, rate
        self._blocks, self._clock = blocks, clock
        self._count: Counter[str] = Counter()
        self._pipes: set[Any] = set()
        self.socket: DatagramSocket | None = None
        """Knows what was acknowledged; set when it listens."""

    def __len__(self) -> int:
        return self._count.total()

    def has_room(self, host: str) -> bool:
        """Whether one more from there is notified."""
        return len(self) < MAX_OBSERVERS and self._count[host] < MAX_OBSERVERS_OF_HOST

    async def observe(self, pipe: Any, asked: Asked, topic: Topic) -> None:
        """Notify until the client is gone, which cancels this. Raises BridgeError, or Failure for a bad rate."""
        rate = self._rate if math.isnan(asked.rate) else asked.rate
        if not 0 < rate <= MAX_RATE:
            raise failure(f"The rate is above 0 and at most {MAX_RATE:g} Hz, not {rate:g}.")
        remote = pipe.request.remote
        # an operator of its own: who only listens says nothing for a long time
        watcher = self._clients.newcomer(asked.client, asked.token, address_of(pipe.request))
        self._count[remote.host] += 1
        self._pipes.add(pipe)
        try:
            expelled = "Your key counts no more."
            watcher.operator.on_expelled = lambda: self._end(pipe, CoapCode.UNAUTHORIZED, expelled)
            self._door.check(watcher.operator, "subscribe", topic.name)
            observation = Observation(self._door, watcher.operator, topic, 1 / rate, self._clock)
            await self._notify(pipe, asked, topic, observation, watcher.operator)
        finally:
            self._pipes.discard(pipe)
            self._count[remote.host] -= 1
            self._count += Counter()  # without hosts that have none
            self._clients.leave(watcher)
            if self.socket is not None:
                self.socket.forget(remote)

    def close(self) -> None:
        """Tell all of them that it is over; who runs the requests ends them."""
        for pipe in list(self._pipes):
            self._end(pipe, CoapCode.SERVICE_UNAVAILABLE, "This gateway goes down.")

    async def _notify(
        self, pipe: Any, asked: Asked, topic: Topic, observation: Observation, operator: Operator
    ) -> None:
        request, number = pipe.request, 0
        key = key_of_request(request, asked)
        msg, tuning = await observation.first(FIRST_TIMEOUT), Tuning()
        while self._door.permits(operator, "subscribe", topic.name):
            body = Body(b"null", JSON) if msg is None else body_of(msg, asked)
            response = self._blocks.answer(request, key, body, self._clock(), observe=number)
            response.transport_tuning = tuning
            pipe.add_response(response)
            number = (number + 1) % _NUMBERS
            msg, confirms = await observation.next(lambda: self._acknowledged(request.remote))
            tuning = _Confirmed() if confirms else _Unconfirmed()
        self._end(pipe, CoapCode.FORBIDDEN, f"{topic.name} is not for you any more.")

    async def _acknowledged(self, remote: Any) -> None:
        if self.socket is not None:
            await self.socket.acknowledged(remote)

    def _end(self, pipe: Any, code: CoapCode, said: str) -> None:
        """End an observation, which cancels its task."""
        self._pipes.discard(pipe)
        last = Message(code=code, payload=said.encode(), transport_tuning=_Unconfirmed())
        pipe.add_response(last, is_last=True)
