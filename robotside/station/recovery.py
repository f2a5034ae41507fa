"""The task after a restart: the history goes on, and a task that was cut is offered."""

from __future__ import annotations

from collections.abc import Callable

from robotside.autonomy.autonomy import Autonomy
from robotside.core.bus import Bus
from robotside.records import Records
from robotside.tasks.interrupted_task import InterruptedTask
from robotside.tasks.task_history import TaskHistory

__all__ = ["recover_task"]


def recover_task(
    records: Records, autonomy: Autonomy, bus: Bus, clock: Callable[[], float]
) -> InterruptedTask | None:
    """Show how the last task ended and keep the history from now on; the task that a restart cut, None for none.

    `clock` is the operators' [s].
    """
    cut, engine = records.runs.under_way, autonomy.engine
    engine.recall(records.runs.last, records.runs.newest)
    history = TaskHistory(records.runs, engine, clock)
    bus.subscribe("/task/progress", history.on_message)
    autonomy.status_publisher.note = history.note
    return InterruptedTask(cut, engine) if cut else None
