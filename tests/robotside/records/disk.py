"""A disk that takes its time."""

from __future__ import annotations

from collections.abc import Callable

from robotside.records.database.jobs import Job

__all__ = ["Disk"]


class Disk:
    """Writes when it is told to."""

    def __init__(self) -> None:
        self.waiting: list[tuple[Job, Callable[[Job, str], None]]] = []
        self.room = 10

    def submit(self, job: Job, told: Callable[[Job, str], None]) -> bool:
        if len(self.waiting) >= self.room:
            return False
        self.waiting.append((job, told))
        return True

    def answer(self, problem: str = "") -> None:
        job, told = self.waiting.pop(0)
        told(job, problem)
