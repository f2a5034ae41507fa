"""Tasks of a link are held until they are done, and end with it."""

from __future__ import annotations

import asyncio
import gc

from app.link.task_set import TaskSet


async def test_a_task_that_nothing_else_holds_is_done() -> None:
    done, tasks = asyncio.Event(), TaskSet()

    async def work() -> None:
        await asyncio.sleep(0)
        gc.collect()
        done.set()

    task = tasks.start(work())
    await task
    assert done.is_set()


async def test_every_task_but_the_one_that_asks_is_cancelled() -> None:
    tasks, ended = TaskSet(), []

    async def wait(name: str) -> None:
        try:
            await asyncio.Event().wait()
        finally:
            ended.append(name)

    async def end() -> None:
        await tasks.cancel()
        ended.append("who asked")

    tasks.start(wait("one"))
    tasks.start(wait("two"))
    await asyncio.sleep(0)
    await tasks.start(end())
    assert sorted(ended[:2]) == ["one", "two"]
    assert ended[2:] == ["who asked"]
