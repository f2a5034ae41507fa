"""Asyncio tasks: their cancellation, and waiting with a time limit."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Iterable
from typing import Any

__all__ = ["UntilClosed", "cancel_all", "is_cancelled_from_outside", "wait"]


async def cancel_all(tasks: Iterable[asyncio.Future[Any]]) -> None:
    """Cancel `tasks` and wait until they have ended, whatever they raise."""
    left = list(tasks)
    for task in left:
        task.cancel()
    await asyncio.gather(*left, return_exceptions=True)


async def wait(wake: asyncio.Event, timeout: float | None) -> None:
    """Wait until `wake` is set, for `timeout` [s] at most, None for ever; `wake` is clear afterwards."""
    timer = None if timeout is None else asyncio.get_running_loop().call_later(timeout, wake.set)
    try:
        await wake.wait()
    finally:
        wake.clear()
        if timer is not None:
            timer.cancel()


def is_cancelled_from_outside() -> bool:
    """Whether the running task itself was cancelled, not only the one that it waits for."""
    task = asyncio.current_task()
    return task is not None and task.cancelling() > 0


class UntilClosed:
    """Work that goes on until it is closed, also when that comes before its first turn."""

    def __init__(self, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """`work` is begun by `run`."""
        self._begin = work
        self._work: asyncio.Task[None] | None = None
        self.closed = False
        """It was closed: it does not begin any more."""

    async def run(self) -> None:
        """Work until `close()`; returns at once after that, and raises what the work raises. Runs once at a time."""
        if self.closed:
            return
        self._work = asyncio.create_task(self._begin())
        try:
            await self._work
        except asyncio.CancelledError:
            if is_cancelled_from_outside():
                raise

    async def close(self) -> None:
        """Have the work end for good, and wait for that; `run` returns."""
        self.closed = True
        if self._work is not None and not self._work.done():
            self._work.cancel()
            await asyncio.wait({self._work})
