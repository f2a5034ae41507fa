"""Commands that take a while: each is done once, however often it is sent meanwhile, and answered when it is done."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from bridge.core.async_tasks import cancel_all
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from robotside.core.refusal import Refusal
from robotside.services.audit_trail import AuditTrail
from robotside.services.command_log import CommandLog, refused
from robotside.services.command_service import sender_of
from robotside.services.stop_answer import Later
from robotside.station.station import Station

__all__ = ["LastingCommands", "Work"]

log = logging.getLogger(__name__)

Work = Callable[[Operator, Any], Callable[[], Awaitable[str]]]
"""Judges it at once, by Refusal, and returns what does it and gives the sentence of success, or raises Refusal."""

_Key = tuple[str, str, str]
"""The sender's id, the service and the `command_id` of a command."""


class LastingCommands:
    """The commands of one station that are under way, with the tasks that carry them out."""

    def __init__(self, station: Station, trail: AuditTrail) -> None:
        """What is done, or was tried, is recorded in `trail`."""
        self._station, self._trail = station, trail
        self._log = CommandLog(station.clock)
        self._tasks: set[asyncio.Task[CommandResponse]] = set()
        self._under_way: dict[_Key, asyncio.Task[CommandResponse]] = {}

    def service(
        self,
        name: str,
        work: Work,
        kind: str,
        request: type[CommandRequest],
        response: type[CommandResponse],
    ) -> Service:
        """A service that does `work` as a command; who asked may go meanwhile, it is done all the same."""

        def call(client: Operator, asked: CommandRequest) -> CommandResponse | Awaitable[CommandResponse]:
            station, trail = self._station, self._trail
            station.controls.introduce(client, asked.client_id, asked.client_name)
            key = (sender_of(station, client), name, asked.command_id)
            tried: list[asyncio.Task[CommandResponse] | None] = []

            def begin() -> CommandResponse:
                tried.append(None)
                done = work(client, asked)
                told = partial(trail.command, client, name, asked)
                tried[0] = task = asyncio.create_task(self._carry_out(key, done, response, told))
                self._tasks.add(task)
                task.add_done_callback(self._tasks.discard)
                return response(True)

            answer = self._log.run(name, asked, begin, sender=key[0], response=response)
            task = tried[0] if tried else self._under_way.get(key)
            if task is None:
                if tried:
                    trail.command(client, name, asked, answer)
                return answer
            if asked.command_id:
                self._under_way[key] = task
            return Later(partial(_answer, task))

        return Service(name, f"pilothouse_msgs/{kind}", request, response, call)

    async def close(self) -> None:
        """End what is under way; nothing of it is left."""
        await cancel_all(self._tasks)

    async def _carry_out(
        self,
        key: _Key,
        work: Callable[[], Awaitable[str]],
        response: type[CommandResponse],
        told: Callable[[CommandResponse], None],
    ) -> CommandResponse:
        try:
            answer = response(True, await work())
        except Refusal as refusal:
            answer = refused(refusal.notice, response)
        except Exception:
            log.exception("%s failed", key[1])
            answer = response(False, f"The robot failed at {key[1]}; its log says why.")
        finally:
            self._under_way.pop(key, None)
        self._log.amend(*key, answer)
        told(answer)
        return answer


async def _answer(task: asyncio.Task[CommandResponse]) -> CommandResponse:
    """The answer, for one of those who wait for it; Refused when the robot ends before."""
    try:
        return await asyncio.shield(task)
    except asyncio.CancelledError:
        if not task.cancelled():
            raise
        raise Refused("The robot's program is about to end.") from None
