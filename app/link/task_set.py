"""Tasks of one link in the network thread, each held until it is done."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

from bridge.core.async_tasks import cancel_all

__all__ = ["TaskSet"]


class TaskSet:
    """The event loop holds tasks only weakly; here none is lost, and all can be ended."""

    def __init__(self) -> None:
        self._tasks: set[asyncio.Task[Any]] = set()

    def start(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        """Start `work` in the running loop."""
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    async def cancel(self) -> None:
        """Cancel every task but the one that asks for it, and wait until each has ended."""
        await cancel_all(self._tasks - {asyncio.current_task()})
