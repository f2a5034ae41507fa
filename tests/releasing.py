"""Releasing STOP at a real robot side, as a finger on Release does."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import TypeVar

Answer = TypeVar("Answer")

LOOK_PERIOD = 0.05
"""Between two tries to release [s]."""

TRIES = 400
"""Before it is given up."""


async def release_stop(
    call: Callable[[str], Awaitable[Answer]], released: Callable[[Answer], bool]
) -> Answer:
    """Hold Release until the robot takes it; the answer to that, of which `released` says whether it is a success.

    A hold that was over before the release came, on a busy computer, is begun anew.
    """
    for number in range(TRIES):
        if number % 60 == 0:
            await call("/stop/hold")
        answer = await call("/stop/release")
        if released(answer):
            return answer
        await asyncio.sleep(LOOK_PERIOD)
    raise AssertionError(f"STOP was not released: {answer!r}")
