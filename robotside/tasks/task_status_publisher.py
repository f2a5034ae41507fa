"""The publisher of the task's status: begin and end once they are on the disk, so that a restart takes nothing back."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from bridge.msgs.pilothouse_msgs import TaskStatus
from robotside.records import Job, Records

__all__ = ["DISK_TIMEOUT", "TaskStatusPublisher"]

DISK_TIMEOUT = 2.0
"""The longest time that a disk without an answer may delay a status [s]: people beside the robot must know it."""


class TaskStatusPublisher:
    """Passes each status on in its turn."""

    def __init__(
        self, records: Records, publish: Callable[[TaskStatus], None], clock: Callable[[], float]
    ) -> None:
        """`clock` is the operators' [s]."""
        self.note: Callable[[TaskStatus], None] = lambda _: None
        """Keeps a status; what of it a restart must know waits for the disk."""
        self._records, self._publish, self._clock = records, publish, clock
        self._waiting: deque[tuple[TaskStatus, Job, float]] = deque()

    def show(self, status: TaskStatus) -> None:
        """Note a status and publish it, after those that wait; a disk that fails delays nothing."""
        with self._records.together() as job:
            self.note(status)
            waits = bool(self._waiting) or job.binding
            if waits:
                self._waiting.append((status, job, self._clock() + DISK_TIMEOUT))
                job.after.append(self.update)
        if not waits:
            self._publish(status)

    def update(self) -> None:
        """Publish each status that was tried, or has waited for too long; call it each tick."""
        now = self._clock()
        while self._waiting and (self._waiting[0][1].done or now >= self._waiting[0][2]):
            self._publish(self._waiting.popleft()[0])

    @property
    def all_told(self) -> bool:
        """No status waits to be published."""
        return not self._waiting
