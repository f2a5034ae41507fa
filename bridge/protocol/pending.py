"""Pending requests to the other side: calls of services and goals of actions."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import msgspec

from bridge.core.errors import ProtocolError
from bridge.protocol.names import absolute
from bridge.protocol.ops import (
    ActionFeedback,
    ActionResult,
    CallService,
    CancelActionGoal,
    Id,
    SendActionGoal,
    ServiceResponse,
)

__all__ = ["Answer", "Calls", "Feedback", "Goals", "Result"]

Answer = Callable[[ServiceResponse | None], object]
"""Called once with the answer, or with None when there will be none."""
Feedback = Callable[[ActionFeedback], object]
Result = Callable[[ActionResult | None], object]
"""Called once with the result, or with None when it will never be known."""


@dataclass(frozen=True, slots=True)
class _Call:
    service: str
    answer: Answer


@dataclass(frozen=True, slots=True)
class _Goal:
    op: SendActionGoal
    feedback: Feedback | None
    result: Result


class Calls:
    """Calls of the other side's services, until answered."""

    def __init__(self, prefix: str, most: int) -> None:
        """The ids are `PREFIX:SERVICE:NUMBER`; at most `most` may wait."""
        self._prefix = prefix
        self._most = most
        self._waiting: dict[Id, _Call] = {}
        self._numbers = itertools.count(1)

    def __len__(self) -> int:
        """Number of calls that wait."""
        return len(self._waiting)

    def ask(self, op: CallService, answer: Answer) -> CallService:
        """Add a call; returns it with the id to send. ProtocolError when too many wait."""
        if len(self._waiting) >= self._most:
            raise ProtocolError(
                f"{op.service} cannot be called: {self._most} calls wait for their answer already."
            )
        named = msgspec.structs.replace(op, id=f"{self._prefix}:{op.service}:{next(self._numbers)}")
        self._waiting[named.id] = _Call(absolute(op.service), answer)
        return named

    def on_response(self, op: ServiceResponse) -> bool:
        """Pass a response to its caller; False when none waits for it."""
        call = self._waiting.pop(op.id, None)
        if call is not None:
            call.answer(op)
        return call is not None

    def forget(self, id: Id) -> bool:
        """Remove a call; False when it was not waiting."""
        return self._waiting.pop(id, None) is not None

    def fail_all(self, service: str | None = None) -> None:
        """End the calls that will never be answered: of this service, or all."""
        gone = [id for id, call in self._waiting.items() if service in (None, call.service)]
        _tell_all([self._waiting.pop(id).answer for id in gone])


class Goals:
    """Goals that the other side carries out, until their result."""

    def __init__(self, prefix: str, most: int) -> None:
        """The ids are `PREFIX:ACTION:NUMBER`; at most `most` may be under way."""
        self._prefix = prefix
        self._most = most
        self._waiting: dict[Id, _Goal] = {}
        self._numbers = itertools.count(1)

    def __len__(self) -> int:
        """Number of goals under way."""
        return len(self._waiting)

    def __iter__(self) -> Iterator[SendActionGoal]:
        """The goals under way, as they were sent."""
        return iter([goal.op for goal in self._waiting.values()])

    def send(self, op: SendActionGoal, feedback: Feedback | None, result: Result) -> SendActionGoal:
        """Add a goal; returns it with the id to send. ProtocolError when too many are under way."""
        if len(self._waiting) >= self._most:
            raise ProtocolError(f"{op.action} takes no goal: {self._most} are under way already.")
        named = msgspec.structs.replace(
            op, id=f"{self._prefix}:{op.action}:{next(self._numbers)}", feedback=feedback is not None
        )
        self._waiting[named.id] = _Goal(named, feedback, result)
        return named

    def cancel(self, id: Id) -> CancelActionGoal | None:
        """The operation that cancels a goal; its result is still to come. None when it is not under way."""
        goal = self._waiting.get(id)
        return None if goal is None else CancelActionGoal(id=id, action=goal.op.action)

    def on_feedback(self, op: ActionFeedback) -> bool:
        """Pass feedback on to the goal's sender; False when it is not wanted."""
        goal = self._waiting.get(op.id)
        if goal is None or goal.feedback is None:
            return False
        goal.feedback(op)
        return True

    def on_result(self, op: ActionResult) -> bool:
        """Pass a result on to the goal's sender; False when none waits for it."""
        goal = self._waiting.pop(op.id, None)
        if goal is not None:
            goal.result(op)
        return goal is not None

    def forget(self, id: Id) -> bool:
        """Remove a goal; False when it was not under way."""
        return self._waiting.pop(id, None) is not None

    def fail_all(self, action: str | None = None) -> None:
        """End the goals whose result will never be known: of this action, or all."""
        gone = [id for id, goal in self._waiting.items() if action in (None, absolute(goal.op.action))]
        _tell_all([self._waiting.pop(id).result for id in gone])


def _tell_all(those: list[Callable[[None], object]]) -> None:
    """Call each with None, also when one before it raises."""
    with contextlib.ExitStack() as stack:
        for tell in reversed(those):
            stack.callback(tell, None)
