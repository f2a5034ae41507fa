"""Requests of a client to a robot: service calls, goals of actions, and descriptions of types."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, TypeVar

import msgspec
from msgspec import Raw

from bridge.client.client_goals import Goal, action_of, part_of, reason
from bridge.codec import from_json, to_server_json
from bridge.core.errors import NoReply, NotConnected, ProtocolError, Refused
from bridge.msgs import TYPES, Msg, ros1_name
from bridge.msgs.pilothouse_msgs import CommandResponse
from bridge.protocol import ClientSession, Id, Op, ServiceResponse, ros2_name

__all__ = ["ServiceCalls"]

M = TypeVar("M", bound=Msg)


class ServiceCalls:
    """The part of a client that asks; a request ends with its connection."""

    def __init__(self, session: ClientSession, place: str) -> None:
        """`place` is the robot's address as people say it."""
        self._session = session
        self._place = place
        self._learned: dict[str, type[Msg]] = {}

    def _send(self, op: Op) -> bool:
        """Send now; False without a connection."""
        raise NotImplementedError

    async def call(self, service: str, request: Msg | None, response: type[M], *, timeout: float = 2.0) -> M:
        """Call a service and wait for the response, for `timeout` [s] at most.

        Raises Refused with the robot's own sentence, NotConnected, NoReply, or ProtocolError for an answer that is no
        `response`.
        """
        args = b"{}" if request is None else to_server_json(request, self._session.ros2)
        return from_json(await self._ask(service, args, timeout), response)

    async def call_untyped(self, service: str, request: Msg | None, *, timeout: float = 2.0) -> Any:
        """As `call`, for a response whose class is not known: a CommandResponse where it says `success`, else its values as
        decoded JSON."""
        args = b"{}" if request is None else to_server_json(request, self._session.ros2)
        values = await self._ask(service, args, timeout)
        try:
            decoded = msgspec.json.decode(values)
        except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
            raise ProtocolError(f"The answer of {service} is not JSON: {error}.") from error
        if isinstance(decoded, dict) and isinstance(decoded.get("success"), bool):
            return from_json(values, CommandResponse)
        return decoded

    async def _ask(self, service: str, args: bytes, timeout: float) -> Raw:
        answer: asyncio.Future[ServiceResponse | None] = asyncio.get_running_loop().create_future()

        def answered(found: ServiceResponse | None) -> None:
            if not answer.done():
                answer.set_result(found)

        op = self._session.call(service, args, answered)
        try:
            if not self._send(op):
                raise NotConnected(f"There is no connection to {self._place}.")
            async with asyncio.timeout(timeout):
                found = await answer
        except TimeoutError as error:
            raise NoReply(f"The robot did not answer {service} within {timeout:g} s.") from error
        finally:
            self._session.calls.forget(op.id)
        if found is None:
            raise NotConnected(f"The connection was cut before the robot answered {service}.")
        if not found.result or bytes(found.values).startswith(b'"'):
            raise Refused(reason(found.values) or f"The robot refused {service}.")
        return found.values

    async def learn(self, type_name: str, *, timeout: float = 3.0) -> type[Msg]:
        """The class of a message type by its ROS name, in either spelling; the robot is asked once about an unknown
        one.

        Raises as `call` does; ProtocolError when the robot's description is no type.
        """
        from bridge.client.type_learning import learn

        name = ros1_name(type_name)
        found = TYPES.get(name) or self._learned.get(name)
        if found is None:
            asked = msgspec.json.encode({"type": ros2_name(name) if self._session.ros2 else name})
            answer = msgspec.json.decode(await self._ask("/rosapi/message_details", asked, timeout))
            typedefs = answer.get("typedefs") if isinstance(answer, dict) else None
            if not isinstance(typedefs, list) or not typedefs:
                raise ProtocolError(f"The robot does not know what {name} is made of.")
            found = self._learned[name] = learn(typedefs)
        return found

    def goal(
        self,
        action: str,
        goal: Msg,
        *,
        on_feedback: Callable[[Any], object] | None = None,
        result: type[M] | None = None,
        feedback: type[Msg] | None = None,
    ) -> Goal[Any]:
        """Send a goal of an action; `goal` is its message, `on_feedback(msg)` is called on its way.

        `result` and `feedback` are needed for types that are not in `bridge.msgs.TYPES`; ProtocolError without.
        NotConnected when there is no connection: a goal is never sent later.
        """
        name = action_of(goal)
        if on_feedback is not None and feedback is None:
            feedback = part_of(name, "Feedback")
        ids: list[Id] = []
        made = Goal(
            action,
            result or part_of(name, "Result"),
            feedback,
            on_feedback,
            lambda: self._cancel(ids[0]),
        )
        feedback_to = None if on_feedback is None else made.on_feedback
        op = self._session.goal(
            action, name, to_server_json(goal, self._session.ros2), feedback_to, made.on_result
        )
        ids.append(op.id)
        if not self._send(op):
            self._session.goals.forget(op.id)
            raise NotConnected(f"There is no connection to {self._place}.")
        return made

    def _cancel(self, id: Id) -> bool:
        op = self._session.cancel(id)
        return op is not None and self._send(op)
