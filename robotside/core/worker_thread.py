"""A worker in a thread of its own, so that planning and new maps leave no gap in the loop."""

from __future__ import annotations

import threading
from collections import deque
from types import TracebackType
from typing import Any, Generic, Self, TypeVar

from robotside.core.worker import Job, Work

__all__ = ["WorkerThread"]

T = TypeVar("T")

MAX_WAITING = 16
"""Jobs that may wait for their turn."""

CLOSE_TIMEOUT = 5.0
"""A step that lasts longer than this at the end is left to end with the process [s]."""


class WorkerThread:
    """Does work in a thread, one piece after the other; who makes it closes it."""

    def __init__(self, name: str = "planning") -> None:
        self._changed = threading.Condition()
        self._waiting: deque[_ThreadJob[Any]] = deque()
        self._running: _ThreadJob[Any] | None = None
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def __enter__(self) -> Self:
        """Start the thread."""
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Drop all work and end the thread."""
        with self._changed:
            self._closed = True
            for job in (*self._waiting, *([self._running] if self._running else [])):
                job.cancel()
            self._waiting.clear()
            self._changed.notify()
        self._thread.join(CLOSE_TIMEOUT)

    def submit(self, work: Work[T]) -> Job[T]:
        """Begin with `work` when its turn comes. RuntimeError when the worker has ended or too many wait."""
        job = _ThreadJob(work)
        with self._changed:
            for old in [old for old in self._waiting if old.cancelled]:
                self._waiting.remove(old)
            if self._closed or len(self._waiting) >= MAX_WAITING:
                why = "has ended" if self._closed else f"has {MAX_WAITING} jobs waiting already"
                raise RuntimeError(f"The worker thread {why}.")
            self._waiting.append(job)
            self._changed.notify()
        return job

    def _run(self) -> None:
        while (job := self._next()) is not None:
            job.run()
            with self._changed:
                self._running = None

    def _next(self) -> _ThreadJob[Any] | None:
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._closed)
            self._running = self._waiting.popleft() if self._waiting else None
            return self._running


class _ThreadJob(Generic[T]):
    """Written by the worker's thread until `_done` is set, and only read afterwards."""

    def __init__(self, work: Work[T]) -> None:
        self._work = work
        self._found: list[T] = []
        self._fault: Exception | None = None
        self._done, self._cancelled = threading.Event(), threading.Event()

    @property
    def cancelled(self) -> bool:
        """Its result is not wanted any more."""
        return self._cancelled.is_set()

    def run(self) -> None:
        """Do all of it, in the worker's thread, unless it is dropped before its end."""
        try:
            while not self._cancelled.is_set():
                next(self._work)
            self._work.close()
        except StopIteration as end:
            self._found.append(end.value)
        except Exception as fault:  # noqa: BLE001 - who asks for the result gets the fault, of any kind
            self._fault = fault
        else:
            return
        self._done.set()

    def poll(self) -> bool:
        """Whether it has ended by itself."""
        return self._done.is_set() and not self._cancelled.is_set()

    def result(self) -> T:
        """What it has found."""
        if self._fault is not None:
            raise self._fault
        return self._found[0]

    def cancel(self) -> None:
        """Have the thread go on to the next job at the end of this step."""
        self._cancelled.set()
