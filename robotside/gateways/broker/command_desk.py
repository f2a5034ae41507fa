"""Commands that come by a broker: STOP for anyone, and the rest from clients that are known by name and token."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable, Coroutine
from typing import Any, NamedTuple

import msgspec

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.core.notice import Notice
from robotside.gateways.broker.topic_feed import TopicFeed
from robotside.gateways.plain.visitor import STOP, Visitor, refusal
from robotside.gateways.plain.visitors import Visitors

__all__ = [
    "BYE",
    "CALL",
    "CANCEL",
    "LEAVE",
    "PUBLISH",
    "READ",
    "RUN",
    "VERBS",
    "Command",
    "CommandDesk",
]

PUBLISH, CALL, RUN, CANCEL, READ, LEAVE, BYE = "publish", "call", "run", "cancel", "read", "leave", "bye"
VERBS = (PUBLISH, CALL, RUN, CANCEL, READ, LEAVE)
"""What a client asks for by the name of a topic, service or action. `BYE` has none: the client is gone."""
MAX_CALLS = 256
"""Calls and goals of this gateway that may wait for their answer at a time; STOP always may."""
MAX_GOALS = 8
"""Goals of one client that may run at a time."""


def _ignore(_: object) -> None:
    """Nobody wants it."""


class Command(NamedTuple):
    """What a client asks for."""

    client: str
    """How it calls itself."""
    verb: str
    """One of `VERBS`, or `BYE`."""
    name: str
    """Absolute name of a topic, service or action; empty for `BYE`."""
    payload: bytes
    """JSON."""
    answer: Callable[[bytes], None]
    """Sends an answer, JSON."""
    feedback: Callable[[bytes], None] = _ignore
    """Sends how far a goal is, JSON."""
    token: str = ""
    stamp: float = math.nan
    """When it was meant [s, operators' clock]; NaN where that was not said."""
    dated: bool = False
    """Something else than a stamp says that it is fresh."""
    id: bytes = b""
    """Which of several goals is meant."""


class CommandDesk:
    """Has commands carried out and sees that each is answered; owns what still runs of them."""

    def __init__(self, visitors: Visitors, feed: TopicFeed) -> None:
        self._visitors, self._feed = visitors, feed
        self._tasks: set[asyncio.Task[None]] = set()

    async def close(self) -> None:
        """End what still runs."""
        await cancel_all(self._tasks)

    def start(self, work: Coroutine[Any, Any, None]) -> asyncio.Task[None]:
        """A task of its own that ends with the desk."""
        task = asyncio.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    def press_stop(self, command: Command) -> None:
        """Press STOP for anyone: a wrong token, or too many clients, are no reason not to."""
        try:
            visitor = self._visitors.newcomer(command.client, command.token)
        except Refused:
            visitor = self._visitors.newcomer(command.client)
        answer = visitor.call(STOP, command.payload)
        if isinstance(answer, bytes):
            command.answer(answer)
            self._visitors.leave(visitor)
        else:
            self._answer_later(command, answer, lambda _: self._visitors.leave(visitor))

    def obey(self, command: Command) -> None:
        """Carry out what is asked for; raises BridgeError when it is not."""
        if command.verb == BYE:
            self._visitors.leave_name(command.client, command.token)
            return
        visitor = self._visitors.visit(command.client, command.token)
        if command.verb == PUBLISH:
            visitor.publish(command.name, command.payload, command.stamp, dated=command.dated)
        elif command.verb == CALL:
            self._call(visitor, command)
        elif command.verb == RUN:
            self._run(visitor, command)
        elif command.verb == CANCEL:
            self._cancel(visitor, command)
        elif command.verb == READ:
            _confirm(command, self._feed.read(visitor, command.name))
        elif command.verb == LEAVE:
            visitor.leave_topic(command.name)
            _confirm(command, f"{command.name} is not asked for by you any more.")
        else:
            raise Refused(f"A command is one of {', '.join(VERBS)}, not {command.verb[:60]!r}.")

    def _call(self, visitor: Visitor, command: Command) -> None:
        self._check_room()
        answer = visitor.call(command.name, command.payload, command.stamp, dated=command.dated)
        if isinstance(answer, bytes):
            command.answer(answer)
        else:
            self._answer_later(command, answer)

    def _run(self, visitor: Visitor, command: Command) -> None:
        """Begin a goal, which ends with its client."""
        self._check_room()
        key = command.name, command.id
        if key in visitor.goals:
            raise Refused(f"A goal of {command.name} with this id runs already; give another id.")
        if len(visitor.goals) >= MAX_GOALS:
            raise Refused(f"{MAX_GOALS} goals of this client run already.")
        result = visitor.run(
            command.name, command.payload, command.stamp, dated=command.dated, on_feedback=command.feedback
        )

        def end(cancelled: bool) -> None:
            visitor.goals.pop(key, None)
            if cancelled:
                said = f"The goal of {command.name} was cancelled."
                command.answer(refusal(Refused(Notice(Code.GATEWAY_CANCELLED, said, operation=command.name))))

        visitor.goals[key] = self._answer_later(command, result, end)

    def _cancel(self, visitor: Visitor, command: Command) -> None:
        """Take a client's goals of one action back: that with the id, all of them without one."""
        found = [
            task
            for (name, id), task in visitor.goals.items()
            if name == command.name and command.id in (b"", id)
        ]
        for task in found:
            task.cancel()
        if not found:
            raise Refused(f"No goal of {command.name[:100]} runs for you.")

    def _check_room(self) -> None:
        if len(self._tasks) >= MAX_CALLS:
            raise Refused(f"{MAX_CALLS} calls by this gateway wait for their answer already.")

    def _answer_later(
        self, command: Command, answer: Coroutine[Any, Any, bytes], on_end: Callable[[bool], None] = _ignore
    ) -> asyncio.Task[None]:
        """Send the answer when it is there. `on_end` is told in the end, also where it never began, whether it was cancelled."""
        task = self.start(_send(command, answer))

        def end(ended: asyncio.Task[None]) -> None:
            answer.close()  # of a task that was cancelled before it began nobody waits for it
            on_end(ended.cancelled())

        task.add_done_callback(end)
        return task


async def _send(command: Command, answer: Awaitable[bytes]) -> None:
    command.answer(await answer)


def _confirm(command: Command, text: str) -> None:
    command.answer(msgspec.json.encode({"success": True, "message": text}))
