"""The line to a broker by itself: its end comes through whatever the library does with a cancellation."""

from __future__ import annotations

import asyncio

from robotside.gateways.mqtt.broker_line import uncut


async def test_a_cancellation_that_comes_with_a_result_is_not_lost() -> None:
    found: asyncio.Future[int] = asyncio.get_running_loop().create_future()
    went_on = []

    async def work() -> None:
        went_on.append(await uncut(asyncio.wait_for(found, 60)))

    task = asyncio.create_task(work())
    await asyncio.sleep(0)
    found.set_result(1)
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)
    assert task.cancelled()
    assert not went_on


async def test_what_is_not_cancelled_gives_its_result() -> None:
    assert await uncut(asyncio.sleep(0, 7)) == 7
