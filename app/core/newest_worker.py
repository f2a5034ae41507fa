"""A thread that works on the newest thing it was given and skips what it had no time for."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

__all__ = ["NewestWorker"]

T = TypeVar("T")


class NewestWorker(Generic[T]):
    """Runs `work` in its own thread, on one item at a time; the thread starts with the first."""

    def __init__(self, work: Callable[[T], None], name: str) -> None:
        """`work` deals with its own errors; `name` is the thread's."""
        self._work, self._name = work, name
        self._ready = threading.Condition()
        self._waiting: list[T] = []
        self._closed = self._busy = False
        self._thread: threading.Thread | None = None
        self.skipped = 0
        """Items that were replaced by a newer one before their turn."""

    def put(self, item: T) -> None:
        """Give the next item, from any thread; it takes the place of one that still waits."""
        with self._ready:
            if self._closed:
                return
            self.skipped += len(self._waiting)
            self._waiting = [item]
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()
            self._ready.notify_all()

    def flush(self, limit: float) -> bool:
        """Wait until nothing waits or is worked on, `limit` [s] at most; whether that is so."""
        with self._ready:
            return self._ready.wait_for(lambda: not self._waiting and not self._busy, limit)

    def close(self) -> None:
        """Finish the item that waits and end the thread; later items are ignored."""
        with self._ready:
            self._closed = True
            self._ready.notify_all()
        if self._thread is not None:
            self._thread.join(5.0)

    def drop(self) -> None:
        """End the thread without waiting for it: what waits is not done, and later items are ignored."""
        with self._ready:
            self._closed, self._waiting = True, []
            self._ready.notify_all()

    def _run(self) -> None:
        while True:
            with self._ready:
                self._ready.wait_for(lambda: self._waiting or self._closed)
                if not self._waiting:
                    return
                item, self._busy = self._waiting.pop(), True
            try:
                self._work(item)
            finally:
                with self._ready:
                    self._busy = False
                    self._ready.notify_all()
