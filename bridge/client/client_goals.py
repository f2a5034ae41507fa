"""Goals of actions on the client's side: sent once, with feedback, a result, and cancellation."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from typing import Any, Generic, TypeVar, cast

import msgspec
from msgspec import Raw

from bridge.codec import from_json
from bridge.core.errors import NoReply, NotConnected, ProtocolError, Refused
from bridge.msgs import TYPES, Msg
from bridge.msgs.action_msgs import GoalStatus
from bridge.protocol import ActionFeedback, ActionResult, goal_status

__all__ = ["Goal", "action_of", "part_of", "reason"]

log = logging.getLogger(__name__)
R = TypeVar("R", bound=Msg)


class Goal(Generic[R]):
    """One goal under way; made by `BridgeClient.goal` and used in its event loop."""

    def __init__(
        self,
        action: str,
        result: type[R],
        feedback: type[Msg] | None,
        on_feedback: Callable[[Any], object] | None,
        cancel: Callable[[], bool],
    ) -> None:
        self.action = action
        self.status = GoalStatus.STATUS_EXECUTING
        """As in action_msgs/GoalStatus: 2 executing, 4 succeeded, 5 canceled, 6 aborted; 0 when it is not known."""
        self._type = result
        self._feedback = feedback
        self._on_feedback = on_feedback
        self._cancel = cancel
        self._outcome: asyncio.Future[ActionResult | None] = asyncio.get_running_loop().create_future()

    @property
    def done(self) -> bool:
        """Whether the result is known or will never be known."""
        return self._outcome.done()

    def cancel(self) -> bool:
        """Ask for cancellation; `result` gives the outcome. False when the goal has ended or there is no connection."""
        return not self.done and self._cancel()

    async def result(self, timeout: float | None = None) -> R:
        """Wait for the result, for `timeout` [s] at most; the goal itself continues after that.

        Raises Refused when the goal was refused, aborted or cancelled, NotConnected when the connection was cut,
        NoReply after `timeout`, ProtocolError when the answer is no such result.
        """
        try:
            async with asyncio.timeout(timeout):
                found = await asyncio.shield(self._outcome)
        except TimeoutError as error:
            raise NoReply(f"The robot did not finish {self.action} within {timeout:g} s.") from error
        if found is None:
            raise NotConnected(f"The connection was cut before {self.action} was finished.")
        if not found.result:
            raise Refused(reason(found.values) or f"The robot refused {self.action}.")
        if self.status in (GoalStatus.STATUS_CANCELED, GoalStatus.STATUS_ABORTED):
            word = "cancelled" if self.status == GoalStatus.STATUS_CANCELED else "aborted"
            raise Refused(f"{self.action} was {word}.")
        return from_json(found.values, self._type)

    def on_feedback(self, op: ActionFeedback) -> None:
        """Handle feedback of the robot; what does not fit is logged and skipped."""
        if self._on_feedback is None or self._feedback is None:
            return
        try:
            self._on_feedback(from_json(op.values, self._feedback))
        except ProtocolError as error:
            log.warning("Feedback of %s is left out: %s", self.action, error)
        except Exception:
            log.exception("Handling the feedback of %s failed", self.action)

    def on_result(self, op: ActionResult | None) -> None:
        """Handle the result of the robot; None when it will never be known."""
        if self._outcome.done():
            return
        self.status = 0 if op is None else goal_status(op)
        self._outcome.set_result(op)


def action_of(goal: Msg) -> str:
    """The ROS name of the action that `goal` belongs to; ProtocolError when it is not the goal of an action."""
    name = goal.MSGTYPE
    if not name.endswith("Goal"):
        raise ProtocolError(f"{name or type(goal).__name__} is not the goal of an action.")
    return name.removesuffix("Goal")


def reason(values: Raw) -> str:
    """The reason of a refusal, which stands in the place of the values; empty when there is none."""
    found = cast(object, msgspec.json.decode(values))
    return found if isinstance(found, str) else ""


def part_of(name: str, part: str) -> type[Msg]:
    """The class of a service's or action's `Request`, `Response`, `Goal`, `Result` or `Feedback`; ProtocolError when
    it is not known."""
    found = TYPES.get(f"{name}{part}")
    if found is None:
        raise ProtocolError(f"{name}{part} is no known type.")
    return found
