"""Tasks as ROS actions: a client starts one and receives its progress and its result."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable

import msgspec

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Action, Operator, Service
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    CommandResponse,
    RunTaskFeedback,
    RunTaskGoal,
    RunTaskResult,
    TaskProgress,
    TaskStatus,
)
from robotside.core.notice import Notice
from robotside.services.command_service import CommandService
from robotside.services.task_services import TaskOrders
from robotside.station.station import Station

__all__ = ["goal_service", "task_actions"]

_OVER = ("SUCCEEDED", "CANCELED", "FAILED")


def task_actions(station: Station, answering: CommandService) -> Iterable[Action]:
    """The action that runs a task of `station`."""
    goals = _Goals(station, answering)
    yield Action(
        "/task/run", "pilothouse_msgs/RunTask", RunTaskGoal, RunTaskResult, RunTaskFeedback, goals.run
    )


def goal_service(station: Station, answering: CommandService) -> Service:
    """The service by which a goal begins its task: refused while another task has not ended."""
    return answering.service("/task/run", TaskOrders(station).run, request=RunTaskGoal)


class _Goals:
    """Follows the tasks that were begun as goals."""

    def __init__(self, station: Station, answering: CommandService) -> None:
        self._station = station
        self._begin = goal_service(station, answering).call

    async def run(self, client: Operator, goal: RunTaskGoal, tell: Callable[[Msg], None]) -> RunTaskResult:
        """Begin a task as `/task/start` does and wait for its end; cancelled, it ends the task.

        Raises Refused with the sentence for the client: why it was not begun, or why it did not succeed.
        """
        begun = self._begin(client, goal)
        task_id, controls = self._station.autonomy.engine.status.task_id, self._station.controls
        who = controls.id(client), controls.name(client)
        end: asyncio.Future[TaskStatus] = asyncio.get_running_loop().create_future()

        def watch(_: str, msg: Msg) -> None:
            if isinstance(msg, TaskProgress) and msg.task_id == task_id:
                tell(RunTaskFeedback(**msgspec.structs.asdict(msg)))
            elif isinstance(msg, TaskStatus) and not end.done() and _over(msg, task_id):
                end.set_result(msg)

        leave = [self._station.bus.subscribe(topic, watch) for topic in ("/task/progress", "/task/status")]
        try:
            answer = begun if isinstance(begun, Msg) else await begun
            if not (isinstance(answer, CommandResponse) and answer.success):
                raise Refused(answer.message if isinstance(answer, CommandResponse) else "It was not begun.")
            return _result(await end)
        except asyncio.CancelledError:
            self._take_back(client, who, task_id)
            raise
        finally:
            for end_of in leave:
                end_of()

    def _take_back(self, client: Operator, who: tuple[str, str], task_id: int) -> None:
        """End the task of `client`, by its id and name, unless it is over or somebody else has taken it over.

        Refused with the name of who has.
        """
        problem = self._station.controls.objection(client)
        if problem:
            raise Refused(problem)
        engine = self._station.autonomy.engine
        if engine.active and engine.status.task_id == task_id:
            (client_id, name), there = who, self._station.controls.knows(client)
            code, said = Code.TASK_CANCELED, f"Canceled by {name}."
            if not there:
                code, said = Code.TASK_ASKER_GONE, f"Canceled: {name}, who started it, is gone."
            engine.cancel(Notice(code, said, actor_id=client_id, name=name))


def _over(status: TaskStatus, task_id: int) -> bool:
    return status.task_id > task_id or (status.task_id == task_id and status.state in _OVER)


def _result(status: TaskStatus) -> RunTaskResult:
    if status.state != "SUCCEEDED":
        raise Refused(Notice.of(status.reason, status))
    return RunTaskResult(status.task_id, status.state, status.reason, status.visited)
