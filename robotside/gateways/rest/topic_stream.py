"""A topic as server-sent events: the newest message as often as asked for, each happening once, for as long as it is read."""

from __future__ import annotations

import asyncio
import math
from typing import Any

from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from bridge.codec import to_json
from bridge.core.async_tasks import cancel_all, wait
from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import Topic
from bridge.msgs import Msg
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.http.mounts import LONG
from robotside.gateways.plain.outbox import Outbox
from robotside.gateways.rest.forms import EVENTS

__all__ = ["ALIVE_PERIOD", "MAX_STREAMS", "TopicStreams"]

MAX_STREAMS = 32
"""Streams of one gateway at a time."""
ALIVE_PERIOD = 5.0
"""So often something is sent where the robot says nothing [s], so that one who is gone is noticed."""
_ALIVE = b": alive\n\n"


class TopicStreams:
    """The streams of one gateway."""

    def __init__(self, door: StationDoor, rate: float) -> None:
        """Of each at most `rate` messages a second are sent [Hz]."""
        self._door, self._rate = door, rate
        self._open: set[_Stream] = set()

    def __len__(self) -> int:
        return len(self._open)

    def stream(self, operator: Operator, topic: Topic, rate: float) -> Response:
        """An answer with the messages of `topic`, at most `rate` a second [Hz]. Raises Refused without room."""
        if len(self._open) >= MAX_STREAMS:
            said = f"{MAX_STREAMS} streams are read already; close one of them."
            raise Refused(Notice(Code.GATEWAY_FULL, said, max=MAX_STREAMS))
        return _Stream(self._door, self._open, operator, topic, min(rate, self._rate))


class _Stream(Response):
    """One answer that does not end by itself."""

    def __init__(
        self, door: StationDoor, opened: set[_Stream], operator: Operator, topic: Topic, rate: float
    ) -> None:
        headers = {"Cache-Control": "no-store", "X-Content-Type-Options": "nosniff"}
        super().__init__(None, 200, headers, media_type=EVENTS)
        del self.headers["content-length"]
        self._door, self._opened, self._operator, self._topic = door, opened, operator, topic
        self._outbox, self._wake, self._over = Outbox(1 / rate), asyncio.Event(), asyncio.Event()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send messages until who reads is gone, or may not read any more."""
        scope["state"][LONG] = True
        self._opened.add(self)
        self._operator.on_expelled = self._over.set
        tasks: list[asyncio.Task[Any]] = []
        try:
            self._door.subscribe(self, self._topic.name, self._put)
            start = {"type": "http.response.start", "status": self.status_code, "headers": self.raw_headers}
            await send(start)
            tasks = [
                asyncio.create_task(each) for each in (self._show(send), _gone(receive), self._over.wait())
            ]
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._opened.discard(self)
            self._door.leave(self)
            await cancel_all(tasks)
        await send({"type": "http.response.body", "body": b"", "more_body": False})

    def _put(self, _: str, msg: Msg) -> None:
        self._outbox.put(self._topic, msg)
        self._wake.set()

    async def _show(self, send: Send) -> None:
        clock = asyncio.get_running_loop().time
        while True:
            taken = self._outbox.take(clock())
            if taken is not None:
                if not self._may_read():
                    return
                await _send(send, b"data: %b\n\n" % to_json(taken[1]))
                continue
            left = self._outbox.wait(clock())
            await wait(self._wake, min(left, ALIVE_PERIOD))
            if math.isinf(left) and math.isinf(self._outbox.wait(clock())):
                await _send(send, _ALIVE)

    def _may_read(self) -> bool:
        try:
            self._door.check(self._operator, "subscribe", self._topic.name)
        except Refused:
            return False
        return True


async def _send(send: Send, body: bytes) -> None:
    await send({"type": "http.response.body", "body": body, "more_body": True})


async def _gone(receive: Receive) -> None:
    """Until who reads has left."""
    while (await receive())["type"] != "http.disconnect":
        pass
