"""The recorder of each task's progress, for the history and for a restart."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskProgress, TaskRun, TaskStatus
from bridge.msgs.std_msgs import Time
from robotside.records.runs import Runs
from robotside.tasks.engine import Engine

__all__ = ["TaskHistory"]

_OVER = ("SUCCEEDED", "CANCELED", "FAILED")

NOTE_PERIOD = 5.0
"""A task that takes a time is noted so often beside its changes [s], operators' clock."""


class TaskHistory:
    """Hears how the task is and keeps what is new of it; the number of a run is that of its TaskStatus."""

    def __init__(self, runs: Runs, engine: Engine, clock: Callable[[], float]) -> None:
        """`clock` is the operators' [s]."""
        self._runs, self._engine, self._clock = runs, engine, clock
        cut = runs.under_way
        self._run = cut.run if cut else TaskRun()
        self._course = cut.course if cut else ""
        self._distance = self._run.distance
        self._due = 0.0

    def on_message(self, _: str, msg: Msg) -> None:
        """Take one message of `/task/progress`."""
        if isinstance(msg, TaskProgress):
            self._distance = msg.distance_driven
            if self._clock() >= self._due and msg.task_id == self._run.id:
                self._keep(self._run)

    def note(self, status: TaskStatus) -> None:
        """Keep what is new of a task; that it began or ended is waited for (`Job.binding`)."""
        if status.task_id > self._runs.last and status.task:
            self._begin(status)
        if not self._run.id or status.task_id != self._run.id or self._run.ended.seconds > 0:
            return
        ended = Time.at(self._clock()) if status.state in _OVER else Time()
        run = msgspec.structs.replace(
            self._run,
            state=status.state,
            reason=status.reason,
            visited=status.visited,
            ended=ended,
            code=status.code,
            actor_id=status.actor_id,
            parameters=status.parameters,
        )
        if run != self._run:
            self._keep(run)

    def _begin(self, status: TaskStatus) -> None:
        self._distance = 0.0
        task = self._engine.task
        order = task.order if task else TaskOrder(task=status.task, places=status.places)
        begun = TaskRun(
            order=order,
            started=Time.at(self._clock()),
            state=status.state,
            by=task.by if task else "",
        )
        self._run = self._runs.begin(begun)

    def _keep(self, run: TaskRun) -> None:
        self._due = self._clock() + NOTE_PERIOD
        self._run = msgspec.structs.replace(run, distance=self._distance)
        if self._engine.active:
            self._course = msgspec.json.encode(self._engine.noted).decode()
        self._runs.note(self._run, self._course)
