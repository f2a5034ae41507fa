"""An action server as ROS 1 has them: five topics, one message each."""

from __future__ import annotations

import asyncio
import itertools
import math
from collections.abc import Callable, Coroutine
from typing import Any

import msgspec

from bridge.client.client import BridgeClient
from bridge.core.errors import Refused
from bridge.msgs import TYPES, Msg
from bridge.msgs.std_msgs import Header, Time

__all__ = ["ActionlibServer", "Begin", "Run"]

Begin = Callable[[Coroutine[Any, Any, Any]], asyncio.Task[Any]]
"""Runs a coroutine as a task that somebody ends."""
Run = Callable[[Any, Callable[[Msg], None]], Coroutine[Any, Any, Msg]]
"""Carries a goal out: gets it and what to call with feedback, and returns the result. Raises Refused."""

MAX_GOALS = 20
"""Most goals at a time."""
STATUS_PERIOD = 0.2
"""Time between two messages of the status [s]."""


class ActionlibServer:
    """Carries out the goals that come on `NAME/goal`; several at a time."""

    def __init__(self, client: BridgeClient, begin: Begin, name: str, kind: str, run: Run) -> None:
        """`kind` is the ROS name of the action, as in `actionlib_tutorials/Fibonacci`."""
        self._client, self._begin, self._name, self._run = client, begin, name, run
        self._result_type, self._feedback_type = TYPES[f"{kind}ActionResult"], TYPES[f"{kind}ActionFeedback"]
        self._nothing = TYPES[f"{kind}Result"]
        self._status: Any = TYPES["actionlib_msgs/GoalStatus"]
        self._statuses = TYPES["actionlib_msgs/GoalStatusArray"]
        self._goals: dict[str, tuple[Msg, asyncio.Task[Any]]] = {}
        self._numbers = itertools.count(1)
        for part, type in (
            ("status", self._statuses),
            ("feedback", self._feedback_type),
            ("result", self._result_type),
        ):
            client.advertise(f"{name}/{part}", type)
        client.subscribe(f"{name}/goal", TYPES[f"{kind}ActionGoal"], self._on_goal, queue_length=MAX_GOALS)
        client.subscribe(f"{name}/cancel", TYPES["actionlib_msgs/GoalID"], self._on_cancel, queue_length=100)
        begin(self._tell_status())

    def _on_goal(self, msg: Any, _: float) -> None:
        id = msg.goal_id.id or f"{self._name}-{next(self._numbers)}"
        if id in self._goals or len(self._goals) >= MAX_GOALS:
            self._end(
                msgspec.structs.replace(msg.goal_id, id=id), self._status.REJECTED, "There are too many."
            )
            return
        goal_id = msgspec.structs.replace(msg.goal_id, id=id)
        self._goals[id] = goal_id, self._begin(self._carry_out(goal_id, msg.goal))

    def _on_cancel(self, msg: Any, _: float) -> None:
        """An empty id means all goals."""
        for id, (_, task) in list(self._goals.items()):
            if msg.id in ("", id):
                task.cancel()

    async def _carry_out(self, goal_id: Any, goal: Msg) -> None:
        active = self._status(goal_id, self._status.ACTIVE)

        def on_feedback(feedback: Msg) -> None:
            self._client.publish(f"{self._name}/feedback", self._feedback_type(self._now(), active, feedback))

        try:
            result = await self._run(goal, on_feedback)
        except asyncio.CancelledError:
            self._end(goal_id, self._status.PREEMPTED, "It was cancelled.")
            raise
        except Refused as refusal:
            self._end(goal_id, self._status.ABORTED, str(refusal))
        else:
            self._end(goal_id, self._status.SUCCEEDED, "", result)
        finally:
            self._goals.pop(goal_id.id, None)

    def _end(self, goal_id: Msg, status: int, text: str, result: Msg | None = None) -> None:
        ended = self._status(goal_id, status, text)
        self._client.publish(f"{self._name}/status", self._statuses(self._now(), [ended]))
        self._client.publish(
            f"{self._name}/result", self._result_type(self._now(), ended, result or self._nothing())
        )

    async def _tell_status(self) -> None:
        while True:
            active = [self._status(goal_id, self._status.ACTIVE) for goal_id, _ in self._goals.values()]
            self._client.publish(f"{self._name}/status", self._statuses(self._now(), active))
            await asyncio.sleep(STATUS_PERIOD)

    def _now(self) -> Header:
        now = self._client.robot_time()
        return Header(Time.at(now) if math.isfinite(now) else Time())
