"""Status of a goal that was sent: the run that drives to it, and how that run stands."""

from __future__ import annotations

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import TaskStatus

__all__ = ["GoalStatus"]

TASK = "go_to"
OUTCOMES = {
    "RUNNING": "accepted",
    "PAUSED": "paused",
    "SUCCEEDED": "there",
    "CANCELED": "canceled",
    "FAILED": "failed",
    "INTERRUPTED": "interrupted",
}
"""State of a run to what it means for its goal."""


class GoalStatus:
    """One goal at a time. A run is its own when it began after the goal was sent, or was adopted."""

    def __init__(self) -> None:
        self._newest: TaskStatus | None = None
        self._before = 0
        self._asked = False
        self.run = 0
        """Number of the run that is for the goal; 0 without one."""

    @property
    def is_reported(self) -> bool:
        """The robot reports its runs."""
        return self._newest is not None

    def on_sent(self) -> None:
        """The goal was sent: the next run is for it, and the one of now is not."""
        self._before = self._newest.task_id if self._newest is not None else 0
        self._asked, self.run = True, 0

    def forget(self) -> None:
        """No run is for the goal: it was refused, or it is another goal now."""
        self._asked, self.run = False, 0

    @property
    def going(self) -> int:
        """Number of the run in which the robot goes to a goal now, whoever asked for it; 0 for none."""
        status = self._newest
        if status is None or status.task != TASK or status.state not in ("RUNNING", "PAUSED"):
            return 0
        return status.task_id

    def adopt(self) -> bool:
        """Take the run of now for the goal's own; False where the robot goes to no goal."""
        if self._newest is None or not self.going:
            return False
        self._asked, self.run = False, self.going
        return True

    def on_status(self, status: TaskStatus) -> str | None:
        """How the goal stands: a value of `OUTCOMES`, `waiting`, `unsure` where it may be another place, or empty when the robot does something else by now.

        None: this tells nothing of the goal.
        """
        self._newest = status
        if self._asked and status.task == TASK and status.task_id not in (0, self._before):
            self._asked, self.run = False, status.task_id
        if not self.run:
            return None
        if status.task_id != self.run:
            if status.state == "RUNNING":
                self.run = 0
                return ""
            return None
        if status.state == "RUNNING" and status.phase == "waiting":
            return "waiting"
        if status.code == Code.TASK_PLACE_UNSURE and status.state == "FAILED":
            return "unsure"
        return OUTCOMES.get(status.state, "")
