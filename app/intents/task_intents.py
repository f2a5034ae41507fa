"""Intents about tasks: when one can be started, paused, resumed or ended, and how it is started."""

from __future__ import annotations

from app.intents.robot_access import RobotAccess
from bridge.msgs.pilothouse_msgs import TaskOrder
from widgets.core.language import tr
from widgets.core.task_words import TASKS, title

__all__ = ["TaskIntents"]


class TaskIntents(RobotAccess):
    """The reasons are one sentence; empty where it can be done."""

    def why_not_pause(self) -> str:
        """Why no task can be paused."""
        if why := self.why_not_asked():
            return why
        if not self._session.robot.offers("/task/pause"):
            return tr("This robot knows no pause.")
        if not self.runs():
            return tr("No task runs that could be paused.")
        return tr("It is paused already.") if self.state() == "PAUSED" else ""

    def why_not_resume(self) -> str:
        """Why no task can be resumed."""
        if why := self.why_not_asked():
            return why
        if self.state() not in ("PAUSED", "INTERRUPTED"):
            return tr("No task is paused.")
        return self.why_latched()

    def why_not_end(self) -> str:
        """Why no task can be ended."""
        return self.why_not_asked() or ("" if self.runs() else tr("No task runs."))

    def why_not_home(self) -> str:
        """Why the robot cannot be sent home."""
        if why := self.why_not_asked() or self.why_latched():
            return why
        session = self._session
        if not (session.robot.knows("go_home") and session.robot.offers("/task/go_home")):
            return tr("This robot cannot go home by itself.")
        return tr("It goes home already.") if self._doing("go_home") else ""

    def _doing(self, task: str) -> bool:
        return self.runs() and self.status is not None and self.status.task == task

    def why_not_task(self, task: str) -> str:
        """Why that task cannot be started in place of the one that runs."""
        session = self._session
        if why := self.why_not_asked() or self.why_latched():
            return why
        if not (session.robot.knows(task) and session.robot.offers("/task/start")):
            return tr("This robot knows no such task: {name}.").format(name=TASKS[task].name)
        return tr("It is {doing} already.").format(doing=TASKS[task].doing) if self._doing(task) else ""

    def start_task(self, task: str) -> None:
        """Start that task, in place of the one that runs."""
        tasking = self._session.tasking
        (tasking.start_instead if self.runs() else tasking.start)(TaskOrder(task=task))

    def chosen(self) -> TaskOrder:
        """The task that is chosen on the tasks screen; a patrol where none is chosen to the end."""
        tasks = self._app.shell.made("tasks")
        if tasks is None:
            return TaskOrder(task="patrol")
        pane = tasks.pane
        if pane.scheduled is None and pane.form.complete and pane.form.task:
            order: TaskOrder = pane.order
            return order
        return TaskOrder(task="patrol")

    def order_of(self, intent: str) -> TaskOrder:
        """The order that `start` or `patrol` would give."""
        return (
            self.chosen() if intent == "start" and self._app.shell is not None else TaskOrder(task="patrol")
        )

    def why_not_order(self, order: TaskOrder) -> str:
        """Why that order cannot be given."""
        session = self._session
        if why := self.why_not_asked() or self.why_latched():
            return why
        if not (session.robot.knows(order.task) and session.robot.offers("/task/start")):
            return tr("This robot knows no such task: {name}.").format(name=TASKS[order.task].name)
        if self.runs() and self.status is not None:
            return tr("{task} runs; end it first.").format(task=title(TaskOrder(task=self.status.task)))
        if order.task == "patrol" and not order.places and session.mission.state == "empty":
            return tr("There are no points on the map to patrol.")
        refused: str = session.refusals.order(order, session.mission.draft)
        return refused

    def start(self, order: TaskOrder) -> None:
        """Give that order; the points on the map go ahead of a patrol of them."""
        session = self._session
        unsent = order.task == "patrol" and not order.places and session.mission.state == "draft"
        session.tasking.start(order, send_first=unsent)
