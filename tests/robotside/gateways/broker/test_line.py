"""A line to a broker: it comes back, ever less often while it is lost at once, and hears nothing that waited too long."""

from __future__ import annotations

import asyncio
import time

import pytest

from robotside.gateways.broker import line
from robotside.gateways.broker.line import Line


class Flapping(Line):
    """Is lost at once each time, but for the last one, which has stood for long."""

    faults = (ConnectionError,)
    lives = 0

    async def _connect(self) -> None:
        self.lives += 1
        self._came_up()
        self._up_since = asyncio.get_running_loop().time() - (60 if self.lives > 5 else 0)
        raise ConnectionError("cut")

    def _reason(self, error: Exception) -> str:
        return str(error)

    def _forget(self) -> None:
        assert not self.is_up


async def test_a_line_that_is_lost_at_once_each_time_is_tried_ever_less_often(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    waits: list[float] = []
    sleep = asyncio.sleep

    async def note(seconds: float) -> None:
        waits.append(seconds)
        await sleep(0)

    told: list[str] = []
    with monkeypatch.context() as patch:
        patch.setattr(asyncio, "sleep", note)
        running = asyncio.create_task(Flapping(on_down=told.append).run())
        while len(waits) < 6:
            await sleep(0)
        running.cancel()
        await asyncio.gather(running, return_exceptions=True)
    assert waits[:6] == [0.5, 1.0, 2.0, 4.0, 5.0, 0.25]
    assert set(told) == {"cut"}


class Listening(Flapping):
    """Ends when the loop stood still."""

    ends = 0

    async def _connect(self) -> None:
        self._came_up()
        time.sleep(0.1)  # noqa: ASYNC251 - before it listens nothing waits for it
        self._look_alive()
        await self._watch_loop()
        self.ends += 1


@pytest.mark.parametrize("drops_stale", [True, False])
async def test_a_line_connects_anew_after_the_program_stood_still_unless_it_hears_late_too(
    drops_stale: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(line, "STALL_PERIOD", 0.01)
    monkeypatch.setattr(line, "STALL_TIMEOUT", 0.05)
    told: list[str] = []
    made = Listening(on_down=told.append, drops_stale=drops_stale)
    running = asyncio.create_task(made.run())
    await asyncio.sleep(0)
    assert made.is_up
    time.sleep(0.1)  # noqa: ASYNC251 - the loop stands still
    for _ in range(3):
        await asyncio.sleep(0.02)
    assert (told != []) is drops_stale
    running.cancel()
    await asyncio.gather(running, return_exceptions=True)
