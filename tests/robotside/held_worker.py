"""A worker in the hand of a test: it does all work at once, or keeps it until the test lets it go."""

from __future__ import annotations

from typing import Generic, TypeVar

from robotside.core.worker import Job, Work, completed

__all__ = ["HeldWorker"]

T = TypeVar("T")


class HeldWorker:
    """Like a thread that takes as long as the test wants."""

    def __init__(self) -> None:
        self.holds = False
        self.submitted = self.cancelled = self.taken = 0

    def submit(self, work: Work[T]) -> Job[T]:
        self.submitted += 1
        return _HeldJob(work, self)


class _HeldJob(Generic[T]):
    def __init__(self, work: Work[T], worker: HeldWorker) -> None:
        self._work, self._worker = work, worker

    def poll(self) -> bool:
        return not self._worker.holds

    def result(self) -> T:
        self._worker.taken += 1
        return completed(self._work)

    def cancel(self) -> None:
        self._worker.cancelled += 1
        self._work.close()
