"""Service calls of one client: answered by rosapi, by the robot or by another client."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any

import msgspec
from msgspec import Raw

from bridge.codec import to_json
from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError, Refused
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.protocol import MISSING, CallService, Id, ServiceResponse, arguments, service_and_id
from bridge.server.client_services import Peer
from bridge.server.flow.priority_lanes import Lane
from bridge.server.reception.log_limit import STRANGERS
from bridge.server.reception.places import FULL
from bridge.server.server_context import ServerContext

__all__ = ["ServiceOperations"]

log = logging.getLogger(__name__)
log.addFilter(STRANGERS)

STOP_SERVICE = "/stop"
TIME_SERVICE = "/rosapi/get_time"
"""A client that has called it knows the offset of its clock from the operators' clock."""
ON_RESERVE = (STOP_SERVICE, TIME_SERVICE)
"""The services that are answered where all places are taken."""


class ServiceOperations:
    """The calls that one client has made."""

    def __init__(
        self, client: Peer, operator: Operator, context: ServerContext, only_stop: Callable[[], bool]
    ) -> None:
        """Responses are sent by `client.send`. While `only_stop()` nothing but STOP and the time is answered."""
        self._client = client
        self._operator = operator
        self._context = context
        self._only_stop = only_stop
        self._tasks: set[asyncio.Task[None]] = set()

    def call(self, op: CallService) -> None:
        """Have a call answered, now or later; what fails is sent as the response."""
        name, id = service_and_id(op)
        try:
            if self._only_stop() and name not in ON_RESERVE:
                raise Refused(FULL)
            if name.startswith("/rosapi/"):
                self._context.door.check(self._operator, "rosapi", name)
            known = self._context.rosapi.answer(name, op.args)
            if known is not None:
                self._operator.asked_time = self._operator.asked_time or name == TIME_SERVICE
                self._respond(op, name, id, known)
                return
            if name in self._context.client_services.services:
                self._context.door.check(self._operator, "relay", name)
                self._context.client_services.call(self._client, name, id, op)
                return
            request = arguments(op.args, self._context.door.service(name).request)
            outcome = self._context.door.call(self._operator, name, request, op.timeout)
            # the arguments would keep the whole frame in memory while the call is under way
            op = msgspec.structs.replace(op, args=MISSING)
            if isinstance(outcome, Msg):
                self._respond(op, name, id, to_json(outcome))
            else:
                self._begin(self._await_outcome(op, name, id, outcome))
        except Exception as error:  # noqa: BLE001 -- an answer may be anything; caller and log get the reason
            self._refuse(op, name, id, error)

    async def close(self) -> None:
        """Cancel all calls that are under way."""
        await cancel_all(self._tasks)

    async def _await_outcome(self, op: CallService, name: str, id: Id, outcome: Awaitable[Msg]) -> None:
        try:
            answer = to_json(await outcome)
        except Exception as error:  # noqa: BLE001 -- as above
            self._refuse(op, name, id, error)
        else:
            self._respond(op, name, id, answer)

    def _refuse(self, op: CallService, name: str, id: Id, error: Exception) -> None:
        if not isinstance(error, BridgeError):
            log.error("The answer of %s to %s cannot be sent", name, self._operator.address, exc_info=error)
        reason = str(error) if isinstance(error, BridgeError) else f"The answer of {name} cannot be sent."
        self._respond(op, name, id, msgspec.json.encode(reason), result=False)

    def _respond(self, op: CallService, name: str, id: Id, values: bytes, *, result: bool = True) -> None:
        response = ServiceResponse(id=id, service=op.service, values=Raw(values), result=result)
        lane = Lane.CONTROL if self._context.door.is_urgent(name) else Lane.REPLY
        self._client.send(response, lane, self._client.protocol.answer_size(op))

    def _begin(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
