"""Services as commands: done once, not when too old, and answered when the change is on the disk."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from functools import partial
from typing import Any

from msgspec.structs import replace

from bridge.codec import to_json
from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from robotside.core.notice import Notice, coded
from robotside.core.refusal import Refusal
from robotside.records import Job, NotRecorded
from robotside.records.database.rows import Answered
from robotside.services.audit_trail import AuditTrail
from robotside.services.command_log import CommandLog
from robotside.services.stop_answer import Later, stop_answer
from robotside.station.station import Station

__all__ = ["Action", "CommandService", "sender_of"]

DISK_TIMEOUT = 10.0
"""How long an answer waits for the disk [s]."""

UNKEPT_SENTENCE = "This could not be saved and would be lost on restart."
"""Said of what was done and is not on the disk."""

Action = Callable[[Operator, Any], str | CommandResponse]
"""Does it and returns the sentence of success or the whole answer; raises Refusal or NotRecorded."""

_Key = tuple[str, str, str]
"""The sender's id, the service and the `command_id` of a command."""


class CommandService:
    """The answers of one station."""

    def __init__(self, station: Station, trail: AuditTrail | None = None) -> None:
        """What is done is recorded in `trail`, by default one of its own."""
        self._station = station
        self._trail = trail or AuditTrail(station.records.audit, station.clock)
        self._commands = CommandLog(station.clock)
        self._unwritten: dict[_Key, Job] = {}
        for answered in station.records.answers.all():
            self._commands.remember(*answered)

    def service(
        self,
        name: str,
        action: Action,
        kind: str = "Command",
        request: type[CommandRequest] = CommandRequest,
        response: type[CommandResponse] = CommandResponse,
        *,
        ageless: bool = False,
    ) -> Service:
        """A service that runs `action` as a command. One that is `ageless` is STOP, which waits for the disk for a moment only."""

        def call(client: Operator, asked: CommandRequest) -> CommandResponse | Awaitable[CommandResponse]:
            station = self._station
            station.controls.introduce(client, asked.client_id, asked.client_name)
            sender = sender_of(station, client)
            station.readiness.on_operator_time(asked.stamp)
            done: list[bool] = []
            before = None if ageless else station.controls.settled(station.clock())
            with station.records.together() as job:
                answer = self._commands.run(
                    name,
                    asked,
                    lambda: _done(action, client, asked, done),
                    sender=sender,
                    ageless=ageless,
                    response=response,
                )
                if not (ageless or answer.success):
                    station.controls.give_back(client, before)  # what is refused has no effect
                station.publish_control()
                if job.binding and asked.command_id and answer.success:
                    told = Answered(sender, name, asked.command_id, to_json(answer).decode())
                    station.records.answers.keep(told)
                if done:
                    self._record(client, name, asked, answer, job)
            if ageless:
                return stop_answer(station, answer)
            return self._answer((sender, name, asked.command_id), answer, job)

        return Service(name, f"pilothouse_msgs/{kind}", request, response, call)

    def _record(
        self, client: Operator, name: str, asked: CommandRequest, answer: CommandResponse, job: Job
    ) -> None:
        """Record what was done, together with it; and if it cannot be written, that it came to nothing."""
        self._trail.command(client, name, asked, answer)

        def unwritten() -> None:
            if job.problem and answer.success:
                refused = CommandResponse(
                    False, job.problem, **coded(Notice(Code.RECORDS_UNWRITTEN, job.problem))
                )
                self._trail.command(client, name, asked, refused)

        job.after.append(unwritten)

    def _answer(
        self, key: _Key, answer: CommandResponse, job: Job
    ) -> CommandResponse | Awaitable[CommandResponse]:
        """Answer at once if nothing has to be waited for; a command that is sent again waits with the first one."""
        job = self._unwritten.get(key, job)
        if job.done:
            return self._judged(key, answer, job)
        if not job.binding:
            return answer
        if key[2]:
            self._unwritten[key] = job
        return Later(partial(self._when_kept, key, answer, job))

    async def _when_kept(self, key: _Key, answer: CommandResponse, job: Job) -> CommandResponse:
        await job.kept(DISK_TIMEOUT)
        if job.done:
            self._unwritten.pop(key, None)
        return self._judged(key, answer, job)

    def _judged(self, key: _Key, answer: CommandResponse, job: Job) -> CommandResponse:
        """What was asked to be kept is refused when it is not; what was done all the same says that it is not kept."""
        if not (job.trouble and job.binding and answer.success):
            return answer
        if job.orders:
            unwritten = coded(Notice(Code.RECORDS_UNWRITTEN, job.trouble))
            judged = type(answer)(False, job.trouble, **unwritten)
        else:
            judged = replace(answer, message=f"{answer.message} {UNKEPT_SENTENCE} {job.trouble}")
        self._commands.amend(*key, judged)
        return judged


def sender_of(station: Station, client: Operator) -> str:
    """Whose commands are counted together: those of a proven identity, or of one `client_id` on one machine.

    A stranger elsewhere that repeats the ids of a command does not get its answer.
    """
    if client.identity.proven:
        return client.identity.id
    return f"{station.controls.id(client)}@{client.address.rpartition(':')[0]}"


def _done(action: Action, client: Operator, asked: CommandRequest, done: list[bool]) -> str | CommandResponse:
    """Do it, and note in `done` that it was tried."""
    done.append(True)
    try:
        return action(client, asked)
    except NotRecorded as problem:
        raise Refusal(problem.notice) from problem
