"""The answer to STOP: given when the latch is on the disk, so that a computer that fails right afterwards does not forget it."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Generator
from functools import partial
from typing import Any

from msgspec.structs import replace

from bridge.msgs.pilothouse_msgs import CommandResponse
from robotside.station.station import Station

__all__ = ["SAVING_TIMEOUT", "Later", "stop_answer"]

SAVING_TIMEOUT = 0.05
"""So long the answer to STOP waits for the disk [s]; the robot stops before."""


def stop_answer(station: Station, answer: CommandResponse) -> CommandResponse | Awaitable[CommandResponse]:
    """`answer` to a STOP that was pressed just now: at once if the latch is on the disk or cannot be, else a little later.

    Not saved within `SAVING_TIMEOUT`, the answer says so.
    """
    if station.stop.saving:
        return Later(partial(_when_saved, station, answer))
    return _with_doubt(station, answer)


async def _when_saved(station: Station, answer: CommandResponse) -> CommandResponse:
    await station.stop.saved(SAVING_TIMEOUT)
    return _with_doubt(station, answer)


def _with_doubt(station: Station, answer: CommandResponse) -> CommandResponse:
    unkept = station.stop.unkept
    return replace(answer, message=f"{answer.message} {unkept}") if unkept else answer


class Later:
    """An answer that takes its first step when it is awaited; one that is given up before then leaves nothing behind."""

    def __init__(self, begin: Callable[[], Awaitable[CommandResponse]]) -> None:
        self._begin = begin

    def __await__(self) -> Generator[Any, None, CommandResponse]:
        return self._begin().__await__()
