"""Goals of one client, carried out by the robot or by another client."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable

import msgspec
from msgspec import Raw

from bridge.codec import to_json
from bridge.core.async_tasks import cancel_all
from bridge.core.errors import BridgeError
from bridge.core.robot_catalogue import Action, Operator
from bridge.core.robot_door import RobotDoor
from bridge.msgs import Msg
from bridge.msgs.action_msgs import GoalStatus
from bridge.protocol import (
    MISSING,
    ActionFeedback,
    ActionResult,
    CancelActionGoal,
    Id,
    SendActionGoal,
    Subscribed,
    absolute,
    arguments,
    goal_status,
    too_deep,
)
from bridge.server.client_services import ClientServices, Peer
from bridge.server.flow.outgoing_messages import OutgoingMessage, op_frames
from bridge.server.flow.priority_lanes import Lane, Stream
from bridge.server.flow.send_queue import SendQueue

__all__ = ["ActionGoals"]

log = logging.getLogger(__name__)


class ActionGoals:
    """The goals of one client that are under way."""

    def __init__(
        self,
        client: Peer,
        operator: Operator,
        queue: SendQueue,
        door: RobotDoor,
        client_services: ClientServices,
    ) -> None:
        """`queue` holds the messages that wait to be sent to the client."""
        self._client = client
        self._operator = operator
        self._queue = queue
        self._door = door
        self._client_services = client_services
        self._cancel: dict[Id, Callable[[], object]] = {}
        self._feedback: dict[Id, Stream] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def begin(self, op: SendActionGoal) -> None:
        """Begin a goal; what is wrong with it is sent as its result. ProtocolError for an id in use."""
        self._client.protocol.begin_goal(op)
        self._feedback[op.id] = Stream(f"{op.action} {op.id}", Lane.TELEMETRY, Subscribed(op.action))
        try:
            self._cancel[op.id] = self._start(op)
        except BridgeError as error:
            self._end(op, _failed(op, str(error)))

    def cancel(self, op: CancelActionGoal) -> None:
        """Cancel a goal; its result is still to come. ProtocolError when it is not under way."""
        goal = self._client.protocol.goal_to_cancel(op)
        self._cancel[goal.id]()

    async def close(self) -> None:
        """Cancel all goals of a client that is gone."""
        for cancel in list(self._cancel.values()):
            cancel()
        await cancel_all(self._tasks)

    def _start(self, op: SendActionGoal) -> Callable[[], object]:
        name = absolute(op.action)
        told = msgspec.structs.replace(op, args=MISSING)  # which would keep all of its frame until it is over
        if name in self._client_services.actions:
            self._door.check(self._operator, "relay", name)
            return self._client_services.hand_goal(
                self._client,
                name,
                op,
                lambda feedback: self._send_feedback(told, feedback.values),
                lambda end: self._on_result(told, end),
            )
        action = self._door.action(name)
        self._door.check(self._operator, "run", name)
        goal = arguments(op.args, action.goal)
        op = told
        task = asyncio.create_task(self._carry_out(op, action, goal))
        self._tasks.add(task)

        def ended(task: asyncio.Task[None]) -> None:
            self._tasks.discard(task)
            if task.cancelled():
                self._end(op, _done(op, to_json(action.result()), GoalStatus.STATUS_CANCELED))

        task.add_done_callback(ended)
        return task.cancel

    async def _carry_out(self, op: SendActionGoal, action: Action, goal: Msg) -> None:
        def on_feedback(feedback: Msg) -> None:
            if op.feedback:
                self._send_feedback(op, Raw(to_json(feedback)))

        try:
            result = await self._door.run(self._operator, action.name, goal, on_feedback)
            self._end(op, _done(op, to_json(result), GoalStatus.STATUS_SUCCEEDED))
        except BridgeError as error:
            self._end(op, _failed(op, str(error)))
        except Exception:
            log.exception("%s from %s failed", op.action, self._operator.address)
            self._end(op, _failed(op, f"The robot failed at {op.action}; its log says why."))

    def _send_feedback(self, op: SendActionGoal, values: Raw) -> None:
        feedback = self._feedback.get(op.id)
        if feedback is not None and not too_deep(bytes(values)):
            self._queue.offer(feedback, _Feedback(op, values, self._client.protocol.answer_size(op)))

    def _on_result(self, op: SendActionGoal, told: ActionResult | None) -> None:
        """End a goal with the result of another client."""
        if told is None:
            self._end(op, _failed(op, f"The client that carries {op.action} out is gone."))
        elif too_deep(bytes(told.values)):
            self._end(op, _failed(op, f"The result of {op.action} is nested too deeply."))
        else:
            self._end(op, msgspec.structs.replace(told, id=op.id, action=op.action, status=goal_status(told)))

    def _end(self, op: SendActionGoal, result: ActionResult) -> None:
        self._client.protocol.end_goal(op.id)
        self._cancel.pop(op.id, None)
        feedback = self._feedback.pop(op.id, None)
        if feedback is not None:
            self._queue.remove(feedback)
            self._client.send(result, size=self._client.protocol.answer_size(op))


class _Feedback(OutgoingMessage):
    """Feedback of a goal; sent as a message of a topic, so that a newer one replaces it while it waits."""

    __slots__ = ("_op", "_size", "_values")

    def __init__(self, op: SendActionGoal, values: Raw, size: int | None) -> None:
        super().__init__(op.action, values)
        self._op = op
        self._values = values
        self._size = size

    def frame(self, form: object) -> bytes:
        """The operation in WebSocket frames."""
        return op_frames(
            ActionFeedback(id=self._op.id, action=self._op.action, values=self._values), self._size
        )


def _done(op: SendActionGoal, values: bytes, status: int) -> ActionResult:
    return ActionResult(id=op.id, action=op.action, values=Raw(values), status=status)


def _failed(op: SendActionGoal, reason: str) -> ActionResult:
    """A failed result as the servers in use send it: the reason in the place of the values, and the status unknown."""
    return ActionResult(id=op.id, action=op.action, values=Raw(msgspec.json.encode(reason)), result=False)
