"""The actions that one client of the plain WebSocket runs."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable

import msgspec
from msgspec import Raw

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import Refused
from bridge.protocol import Subscribed
from bridge.server.flow.outgoing_messages import text_frame
from bridge.server.flow.priority_lanes import Lane, Stream
from bridge.server.flow.send_queue import SendQueue
from bridge.server.reception.log_limit import STRANGERS
from robotside.gateways.plain.visitor import Visitor, refusal
from robotside.gateways.websocket.plain_messages import PlainMessage
from robotside.gateways.websocket.requests import Run

__all__ = ["MAX_GOALS", "Goals"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

MAX_GOALS = 8
"""Actions that a client runs at a time."""


class Goals:
    """The goals that are under way, by the id that the client gave them."""

    def __init__(self, visitor: Visitor, queue: SendQueue) -> None:
        self._visitor, self._queue = visitor, queue
        self._tasks: dict[int | str, asyncio.Task[None]] = {}

    def begin(self, asked: Run, name: str, *, dated: bool) -> None:
        """Run an action; its result goes to the client. Raises BridgeError when it is not begun."""
        if asked.id in self._tasks:
            raise Refused(f"An action with the id {asked.id!r} is under way.")
        if len(self._tasks) >= MAX_GOALS:
            raise Refused(f"{MAX_GOALS} actions of this client are under way.")
        stream = Stream(f"{name} {asked.id}", Lane.TELEMETRY, Subscribed(name))
        work = self._visitor.run(
            name,
            bytes(asked.goal),
            asked.stamp,
            dated=dated,
            on_feedback=self._teller(name, asked.id, stream),
        )
        task = self._tasks[asked.id] = asyncio.create_task(self._follow(name, asked.id, work))
        task.add_done_callback(lambda _: self._end(asked.id, stream))

    def cancel(self, id: int | str) -> None:
        """Cancel an action; its result is still to come. Raises Refused when none of that id is under way."""
        task = self._tasks.get(id)
        if task is None:
            raise Refused(f"No action with the id {id!r} is under way.")
        task.cancel()

    async def close(self) -> None:
        """Cancel all of them: the client is gone."""
        await cancel_all(list(self._tasks.values()))

    def _teller(self, name: str, id: int | str, stream: Stream) -> Callable[[bytes], None]:
        def tell(feedback: bytes) -> None:
            said = msgspec.json.encode({"feedback": name, "id": id, "message": Raw(feedback)})
            self._queue.offer(stream, PlainMessage(name, Raw(said)))

        return tell

    def _end(self, id: int | str, stream: Stream) -> None:
        self._tasks.pop(id, None)
        self._queue.remove(stream)

    async def _follow(self, name: str, id: int | str, work: Awaitable[bytes]) -> None:
        success = False
        try:
            result = await work
            success = msgspec.json.decode(result).get("success") is not False
        except asyncio.CancelledError:
            result = refusal(Refused(f"{name} was cancelled."))
        except Exception:
            log.exception("The result of %s cannot be sent", name)
            result = refusal(Refused(f"The robot failed at {name}; its log says why."))
        said = {"result": name, "id": id, "success": success, "response": Raw(result)}
        self._queue.send(Lane.REPLY, text_frame(msgspec.json.encode(said)))
