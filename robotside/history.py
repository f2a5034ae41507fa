"""Notes of each task what becomes of it, as the history has it."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import TaskOrder, TaskProgress, TaskRun, TaskStatus
from bridge.msgs.std_msgs import Time
from robotside.database.runs import Runs

__all__ = ["History"]

_OVER = ("SUCCEEDED", "CANCELED", "FAILED")


class History:
    """Hears how the task is and keeps what is new of it; the number of a run is that of its TaskStatus."""

    def __init__(self, runs: Runs, clock: Callable[[], float], driver: Callable[[], str]) -> None:
        """`clock` is the operators' [s]; `driver` is who has control, empty for nobody."""
        self._runs, self._clock, self._driver = runs, clock, driver
        self._run = TaskRun()
        self._distance = 0.0

    def hear(self, _: str, msg: Msg) -> None:
        """Take one message of `/task/status` or `/task/progress`."""
        if isinstance(msg, TaskProgress):
            self._distance = msg.distance_driven
        elif isinstance(msg, TaskStatus):
            self._note(msg)

    def _note(self, status: TaskStatus) -> None:
        fresh = status.task_id > self._runs.last
        if fresh and status.task:
            self._distance = 0.0
            order = TaskOrder(task=status.task, places=status.places)
            begun = TaskRun(
                order=order, started=Time.at(self._clock()), state=status.state, by=self._driver()
            )
            self._run = self._runs.begin(begun)
        if not self._run.id or status.task_id != self._run.id or self._run.ended.seconds > 0:
            return
        ended = Time.at(self._clock()) if status.state in _OVER else Time()
        run = msgspec.structs.replace(
            self._run, state=status.state, reason=status.reason, visited=status.visited, ended=ended
        )
        if run != self._run:
            self._run = msgspec.structs.replace(run, distance=self._distance)
            self._runs.note(self._run)
