"""One-shot commands: each is judged by age, executed once and answered, however often it is sent."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Callable

from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from robotside.controls import AHEAD
from robotside.words import number, plain

__all__ = ["KEPT", "KEPT_FOR", "Commands", "Refusal"]

KEPT = 256
"""Answers kept for commands that are sent again."""

KEPT_FOR = 60.0
"""So long is an answer kept [s]; an id that comes later is one that was counted anew."""

LONGEST_ID = 64
"""Characters of a `command_id`; a longer one is refused, since two that are cut could look the same."""

LONGEST = 300
"""Characters kept of a refusal's sentence."""


class Refusal(Exception):
    """The robot will not do it; the text is one sentence for the operator."""


class Commands:
    """Runs commands and remembers what it answered."""

    def __init__(self, now: Callable[[], float]) -> None:
        self._now = now
        self._answers: OrderedDict[tuple[str, str, str], tuple[float, CommandResponse]] = OrderedDict()

    def run(
        self,
        service: str,
        request: CommandRequest,
        action: Callable[[], str],
        *,
        sender: str = "",
        ageless: bool = False,
    ) -> CommandResponse:
        """Do `action` and answer with the sentence it returns, or with the refusal it raises.

        A request with a `command_id` that its `sender` has used on that service gets its first answer again. `ageless`
        ones are done whenever and however often they come: STOP is as right late as in time.
        """
        if ageless:
            return _answer(action)
        if len(request.command_id) > LONGEST_ID:
            said = f"A command_id has at most {LONGEST_ID} characters, not {len(request.command_id)}."
            return CommandResponse(False, said)
        key, now = (sender, service, request.command_id), self._now()
        given, known = self._answers.get(key, (-math.inf, None))
        if known is not None and abs(now - given) <= KEPT_FOR:
            return known
        answer = self._untimely(request) or _answer(action)
        if request.command_id:
            self._answers[key] = now, answer
            self._answers.move_to_end(key)
            while len(self._answers) > KEPT:
                self._answers.popitem(last=False)
        return answer

    def _untimely(self, request: CommandRequest) -> CommandResponse | None:
        if math.isnan(request.stamp):
            return None
        age = self._now() - request.stamp
        if age < -AHEAD:
            ahead, allowed = f"{number(-age)} s ahead of the robot's", f"at most {AHEAD:.0f} s is allowed"
            return CommandResponse(False, f"The command is not done: its clock is {ahead}; {allowed}.")
        if age <= request.valid_for:
            return None
        allowed = f"{number(request.valid_for)} s"
        return CommandResponse(
            False, f"The command is too old: given {number(age)} s ago, valid for {allowed}."
        )


def _answer(action: Callable[[], str]) -> CommandResponse:
    try:
        return CommandResponse(True, action())
    except Refusal as refusal:
        return CommandResponse(False, plain(str(refusal), LONGEST))
