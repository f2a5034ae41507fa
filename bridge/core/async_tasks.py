"""Asyncio tasks: their cancellation, and waiting with a time limit."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from typing import Any

__all__ = ["cancel_all", "is_cancelled_from_outside", "wait"]


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
