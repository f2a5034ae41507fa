"""The task that a crash or a power cut interrupted: it is offered, and goes on only when an operator asks for it."""

from __future__ import annotations

import msgspec

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskStatus
from robotside.core.notice import Notice, coded
from robotside.records.runs import UnderWay
from robotside.tasks.behaviours.course import Noted
from robotside.tasks.engine import Engine, Task
from robotside.tasks.task_factory import TaskFactory, words_for

__all__ = ["InterruptedTask"]


class InterruptedTask:
    """The one task that was cut, until an operator has decided about it."""

    def __init__(self, cut: UnderWay, engine: Engine) -> None:
        """Offer it."""
        self._cut, self._engine = cut, engine
        run = cut.run
        offer = "choose Resume to go on, or Discard"
        said = f"The robot's computer restarted in the middle of {words_for(run.order.task)}; {offer}."
        cut_off = Notice(Code.TASK_INTERRUPTED, said, task=run.order.task)
        engine.offer(
            TaskStatus(
                task_id=run.id,
                task=run.order.task,
                state="INTERRUPTED",
                reason=said,
                visited=run.visited,
                places=run.order.places,
                **coded(cut_off),
            )
        )

    def task(self, task_factory: TaskFactory) -> Task:
        """The task as it goes on from where it was; Refusal when it cannot be done any more."""
        run = self._cut.run
        task = task_factory.task(run.order, run.by)
        task.course.take_up(_noted(self._cut.course))
        return task

    def resume(self, task: Task, now: float) -> None:
        """Go on with `task`, which is that of `task()`, under its old number, at `now` [s, robot clock]."""
        run = self._cut.run
        self._engine.start(task, now, task_id=run.id, driven=run.distance)


def _noted(text: str) -> Noted:
    """How far it was; the start when nothing was noted that can be read."""
    try:
        return msgspec.json.decode(text, type=Noted)
    except msgspec.DecodeError:
        return Noted()
