"""Services and actions that a client provides: calls and goals that it carries out for others."""

from __future__ import annotations

import asyncio
import inspect
import logging
from collections.abc import Awaitable, Callable
from typing import Any

import msgspec
from msgspec import Raw

from bridge.codec import to_server_json
from bridge.core.errors import BridgeError, ProtocolError
from bridge.msgs import TYPES, Msg
from bridge.msgs.action_msgs import GoalStatus
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    CallService,
    ClientSession,
    Id,
    Op,
    SendActionGoal,
    ServiceResponse,
    arguments,
)

__all__ = ["Call", "ServiceProvider", "Run"]

log = logging.getLogger(__name__)
Call = Callable[[Any], Msg | Awaitable[Msg]]
"""Takes the request and returns the response, at once or as an awaitable. Raises Refused with a sentence to refuse."""
Run = Callable[[Any, Callable[[Msg], None]], Awaitable[Msg]]
"""Takes the goal and a function for feedback, and returns the result. It is cancelled when the goal is cancelled."""

MAX_CALLS = 100
"""Most calls that are answered at a time."""


class ServiceProvider:
    """The calls and goals under way. They end with the connection that they came over."""

    def __init__(
        self, session: ClientSession, send: Callable[[Op], bool], foreign: Callable[[], bool]
    ) -> None:
        """`send` sends an operation to the server; `foreign` returns whether that is not one of ours."""
        self._session = session
        self._send = send
        self._foreign = foreign
        self._types: dict[str, str] = {}
        self._calls: set[asyncio.Task[None]] = set()
        self._goals: dict[Id, asyncio.Task[None]] = {}

    def serve(self, service: str, type: str, request: type[Msg], call: Call) -> Op:
        """Answer calls of `service` from now on; returns the operation to send."""
        self._types[service] = type
        return self._session.serve(service, type, lambda op: self._called(op, request, call))

    def provide(self, action: str, type: str, goal: type[Msg], run: Run) -> Op:
        """Carry out goals of `action` from now on; returns the operation to send."""
        return self._session.provide(action, type, lambda op: self._begin(op, goal, run), self._take_back)

    async def on_lost(self) -> None:
        """Cancel all calls and goals of a connection that is lost, in 0.2 s at most."""
        tasks = {*self._calls, *self._goals.values()}
        for task in tasks:
            task.cancel()
        if tasks:
            await asyncio.wait(tasks, timeout=0.2)

    def refuse(self, op: CallService | SendActionGoal, error: ProtocolError) -> None:
        """Answer the server that its request cannot be carried out."""
        if isinstance(op, CallService):
            self._decline(op, str(error))
        else:
            self._send(self._aborted(op, str(error)))

    def _called(self, op: CallService, request: type[Msg], call: Call) -> None:
        if len(self._calls) >= MAX_CALLS:
            raise ProtocolError(
                f"{op.service} cannot be called: {MAX_CALLS} calls are being answered already."
            )
        task = asyncio.create_task(self._respond(op, request, call))
        self._calls.add(task)
        task.add_done_callback(self._calls.discard)

    async def _respond(self, op: CallService, request: type[Msg], call: Call) -> None:
        try:
            answer = call(arguments(op.args, request))
            text = to_server_json(await answer if inspect.isawaitable(answer) else answer, self._session.ros2)
        except BridgeError as error:
            self._decline(op, str(error))
        except Exception:
            log.exception("Answering %s failed", op.service)
            self._decline(op, f"{op.service} failed.")
        else:
            self._answer(op, text, ok=True)

    def _decline(self, op: CallService, sentence: str) -> None:
        """Refuse a call. rosbridge_server drops values that are no object, and the caller would wait for ever."""
        values: object = sentence
        if self._foreign():
            response = TYPES.get(f"{self._types.get(op.service)}Response")
            says = response is not None and "message" in response.__struct_fields__
            values = {"message": sentence} if says else {}
        self._answer(op, msgspec.json.encode(values), ok=False)

    def _answer(self, op: CallService, values: bytes, *, ok: bool) -> None:
        self._send(ServiceResponse(id=op.id, service=op.service, values=Raw(values), result=ok))

    def _begin(self, op: SendActionGoal, goal: type[Msg], run: Run) -> None:
        task = asyncio.create_task(self._carry_out(op, goal, run))
        self._goals[op.id] = task
        task.add_done_callback(lambda done: self._ended(op, done))

    def _ended(self, op: SendActionGoal, task: asyncio.Task[None]) -> None:
        if self._goals.get(op.id) is task:
            del self._goals[op.id]
        if task.cancelled() and self._session.goal_ended(op.id):  # taken back before it began
            self._send(_result(op, b"{}", GoalStatus.STATUS_CANCELED, ok=True))

    def _take_back(self, id: Id) -> None:
        if task := self._goals.get(id):
            task.cancel()

    async def _carry_out(self, op: SendActionGoal, goal: type[Msg], run: Run) -> None:
        def on_feedback(feedback: Msg) -> None:
            if op.feedback and op.id in self._session.given:
                values = Raw(to_server_json(feedback, self._session.ros2))
                self._send(ActionFeedback(id=op.id, action=op.action, values=values))

        try:
            found = await run(arguments(op.args, goal), on_feedback)
            outcome = _result(
                op, to_server_json(found, self._session.ros2), GoalStatus.STATUS_SUCCEEDED, ok=True
            )
        except asyncio.CancelledError:
            outcome = _result(op, b"{}", GoalStatus.STATUS_CANCELED, ok=True)
        except BridgeError as error:
            outcome = self._aborted(op, str(error))
        except Exception:
            log.exception("Carrying out %s failed", op.action)
            outcome = self._aborted(op, f"{op.action} failed.")
        if self._session.goal_ended(op.id):
            self._send(outcome)

    def _aborted(self, op: SendActionGoal, sentence: str) -> ActionResult:
        """The result of a goal that was aborted; without the sentence for rosbridge_server, which drops values that
        are no object."""
        values = b"{}" if self._foreign() else msgspec.json.encode(sentence)
        return _result(op, values, GoalStatus.STATUS_ABORTED, ok=False)


def _result(op: SendActionGoal, values: bytes, status: int, *, ok: bool) -> ActionResult:
    return ActionResult(id=op.id, action=op.action, values=Raw(values), status=status, result=ok)
