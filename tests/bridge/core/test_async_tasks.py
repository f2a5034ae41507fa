"""Cancellation of tasks, and waiting with a time limit."""

from __future__ import annotations

import asyncio

import pytest

from bridge.core.async_tasks import UntilClosed, cancel_all, is_cancelled_from_outside, wait


async def test_cancelled_tasks_have_ended_whatever_they_raise():
    ended = []

    async def work(error: Exception | None) -> None:
        try:
            await asyncio.Event().wait()
        finally:
            await asyncio.sleep(0)
            ended.append(error)
            if error is not None:
                raise error

    tasks = [asyncio.create_task(work(error)) for error in (None, ValueError("broken"))]
    await asyncio.sleep(0)
    await cancel_all(tasks)
    assert [task.done() for task in tasks] == [True, True]
    assert len(ended) == 2


@pytest.mark.parametrize("timeout", [None, 3600.0])
async def test_waiting_ends_when_it_is_woken_and_the_event_is_clear_again(timeout):
    wake = asyncio.Event()
    waiting = asyncio.create_task(wait(wake, timeout))
    await asyncio.sleep(0)
    assert not waiting.done()
    wake.set()
    await waiting
    assert not wake.is_set()


async def test_waiting_ends_after_its_time():
    wake = asyncio.Event()
    async with asyncio.timeout(5.0):
        await wait(wake, 0.0)
    assert not wake.is_set()


@pytest.mark.parametrize("outside", [False, True])
async def test_a_task_knows_whether_it_was_cancelled_itself(outside):
    inner = asyncio.create_task(asyncio.Event().wait())
    found = []

    async def outer() -> None:
        try:
            await inner
        except asyncio.CancelledError:
            found.append(is_cancelled_from_outside())

    task = asyncio.create_task(outer())
    await asyncio.sleep(0)
    (task if outside else inner).cancel()
    await asyncio.gather(task, return_exceptions=True)
    assert found == [outside]


@pytest.mark.parametrize("turns", [0, 1, 3])
async def test_work_ends_when_it_is_closed_also_before_its_first_turn(turns):
    """With no turn its task was made, and nothing of it has run."""
    work = UntilClosed(asyncio.Event().wait)
    running = asyncio.create_task(work.run())
    for _ in range(turns):
        await asyncio.sleep(0)
    await work.close()
    async with asyncio.timeout(5.0):
        await running
        await work.run()


async def test_a_fault_of_the_work_is_raised_and_closing_is_quiet_then():
    async def work() -> None:
        raise ValueError("broken")

    broken = UntilClosed(work)
    with pytest.raises(ValueError, match="broken"):
        await broken.run()
    await broken.close()
