"""One-shot commands: each is judged by age, executed once and answered, however often it is sent."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Callable

from bridge.codec import from_json
from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from robotside.control.command_expiry import MAX_CLOCK_LEAD
from robotside.core.notice import Notice, Problem, coded
from robotside.core.refusal import Refusal
from robotside.core.text import number, plain
from robotside.records.answers import MAX_ANSWERS

__all__ = ["ANSWER_LIFETIME", "CommandLog", "refused"]

ANSWER_LIFETIME = 60.0
"""So long is an answer kept [s]; an id that comes later is one that was counted anew."""

MAX_ID_LENGTH = 64
"""Characters of a `command_id`; a longer one is refused, since two that are cut could look the same."""

MAX_REASON_LENGTH = 300
"""Characters kept of a refusal's sentence."""


class CommandLog:
    """Runs commands and remembers what it answered."""

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._answers: OrderedDict[tuple[str, str, str], tuple[float, CommandResponse | str]] = OrderedDict()

    def run(
        self,
        service: str,
        request: CommandRequest,
        action: Callable[[], str | CommandResponse],
        *,
        sender: str = "",
        ageless: bool = False,
        response: type[CommandResponse] = CommandResponse,
    ) -> CommandResponse:
        """Do `action` and answer with the sentence or the answer it returns, or with the refusal it raises.

        A request with a `command_id` that its `sender` has used on that service gets its first answer again. `ageless`
        ones are done whenever and however often they come: STOP is as right late as in time.
        """
        if ageless:
            return _answer(action, response)
        if len(request.command_id) > MAX_ID_LENGTH:
            count = len(request.command_id)
            said = f"A command_id has at most {MAX_ID_LENGTH} characters, not {count}."
            return refused(Notice(Code.COMMAND_ID_INVALID, said, length=count, max=MAX_ID_LENGTH), response)
        key, now = (sender, service, request.command_id), self._now()
        given, known = self._answers.get(key, (-math.inf, None))
        if known is not None and abs(now - given) <= ANSWER_LIFETIME:
            return from_json(known, response) if isinstance(known, str) else known
        untimely = self._untimely(request)
        answer = refused(untimely, response) if untimely else _answer(action, response)
        if request.command_id:
            self._answers[key] = now, answer
            self._answers.move_to_end(key)
            while len(self._answers) > MAX_ANSWERS:
                self._answers.popitem(last=False)
        return answer

    def remember(self, sender: str, service: str, command_id: str, answer: CommandResponse | str) -> None:
        """Answer so to a command that was done before a restart; a text is the answer as JSON."""
        self._answers[sender, service, command_id] = self._now(), answer

    def amend(self, sender: str, service: str, command_id: str, answer: CommandResponse) -> None:
        """Answer so from now on to a command that was done: it came to something else."""
        key = (sender, service, command_id)
        if key in self._answers:
            self._answers[key] = self._answers[key][0], answer

    def _untimely(self, request: CommandRequest) -> Problem:
        """Why it is not done, empty when it is in time."""
        if math.isnan(request.stamp):
            return ""
        age = self._now() - request.stamp
        if age < -MAX_CLOCK_LEAD:
            ahead, allowed = (
                f"{number(-age)} s ahead of the robot's",
                f"at most {MAX_CLOCK_LEAD:.0f} s is allowed",
            )
            said = f"The command is not done: its clock is {ahead}; {allowed}."
            return Notice(Code.COMMAND_AHEAD, said, seconds=-age, allowed=MAX_CLOCK_LEAD)
        if age <= request.valid_for:
            return ""
        valid = request.valid_for
        said = f"The command is too old: given {number(age)} s ago, valid for {number(valid)} s."
        return Notice(Code.COMMAND_LATE, said, age=age, allowed=valid)


def _answer(action: Callable[[], str | CommandResponse], response: type[CommandResponse]) -> CommandResponse:
    try:
        done = action()
    except Refusal as refusal:
        return refused(refusal.notice, response)
    return done if isinstance(done, CommandResponse) else response(True, done)


def refused(notice: Notice, response: type[CommandResponse]) -> CommandResponse:
    """The answer that refuses, with the notice's sentence and code."""
    return response(False, plain(notice, MAX_REASON_LENGTH), **coded(notice))
