"""What was asked of the other side and is not answered yet: calls of services and goals of actions."""

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
"""Called once with what became of the goal, or with None when nobody will say."""


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
        """How many wait for their answer."""
        return len(self._waiting)

    def ask(self, op: CallService, answer: Answer) -> CallService:
        """Remember a call; gives it with the id to send. ProtocolError when too many wait."""
        if len(self._waiting) >= self._most:
            raise ProtocolError(
                f"{op.service} cannot be called: {self._most} calls wait for their answer already."
            )
        named = msgspec.structs.replace(op, id=f"{self._prefix}:{op.service}:{next(self._numbers)}")
        self._waiting[named.id] = _Call(absolute(op.service), answer)
        return named

    def on_response(self, op: ServiceResponse) -> bool:
        """Pass an answer to whoever waits for it; False when nobody does."""
        call = self._waiting.pop(op.id, None)
        if call is not None:
            call.answer(op)
        return call is not None

    def forget(self, id: Id) -> bool:
        """Nobody waits for this answer any more; False when nobody did."""
        return self._waiting.pop(id, None) is not None

    def lose(self, service: str | None = None) -> None:
        """Nothing will be answered any more: by this service, or at all."""
        gone = [id for id, call in self._waiting.items() if service in (None, call.service)]
        _tell_all([self._waiting.pop(id).answer for id in gone])


class Goals:
    """Goals that the other side carries out, until it says what became of them."""

    def __init__(self, prefix: str, most: int) -> None:
        """The ids are `PREFIX:ACTION:NUMBER`; at most `most` may be under way."""
        self._prefix = prefix
        self._most = most
        self._waiting: dict[Id, _Goal] = {}
        self._numbers = itertools.count(1)

    def __len__(self) -> int:
        """How many are under way."""
        return len(self._waiting)

    def __iter__(self) -> Iterator[SendActionGoal]:
        """Those under way, as they were sent."""
        return iter([goal.op for goal in self._waiting.values()])

    def send(self, op: SendActionGoal, feedback: Feedback | None, result: Result) -> SendActionGoal:
        """Remember a goal; gives it with the id to send. ProtocolError when too many are under way."""
        if len(self._waiting) >= self._most:
            raise ProtocolError(f"{op.action} takes no goal: {self._most} are under way already.")
        named = msgspec.structs.replace(
            op, id=f"{self._prefix}:{op.action}:{next(self._numbers)}", feedback=feedback is not None
        )
        self._waiting[named.id] = _Goal(named, feedback, result)
        return named

    def cancel(self, id: Id) -> CancelActionGoal | None:
        """What to send to take a goal back; its result is still to come. None when it is not under way."""
        goal = self._waiting.get(id)
        return None if goal is None else CancelActionGoal(id=id, action=goal.op.action)

    def on_feedback(self, op: ActionFeedback) -> bool:
        """Pass on how far a goal is; False when nobody wants to know."""
        goal = self._waiting.get(op.id)
        if goal is None or goal.feedback is None:
            return False
        goal.feedback(op)
        return True

    def on_result(self, op: ActionResult) -> bool:
        """Pass on what became of a goal; False when nobody waits for it."""
        goal = self._waiting.pop(op.id, None)
        if goal is not None:
            goal.result(op)
        return goal is not None

    def forget(self, id: Id) -> bool:
        """Nobody waits for this goal any more; False when nobody did."""
        return self._waiting.pop(id, None) is not None

    def lose(self, action: str | None = None) -> None:
        """Nobody will say any more what becomes of the goals: of this action, or of all."""
        gone = [id for id, goal in self._waiting.items() if action in (None, absolute(goal.op.action))]
        _tell_all([self._waiting.pop(id).result for id in gone])


def _tell_all(those: list[Callable[[None], object]]) -> None:
    """Tell each, also when one before it raises."""
    with contextlib.ExitStack() as stack:
        for tell in reversed(those):
            stack.callback(tell, None)
