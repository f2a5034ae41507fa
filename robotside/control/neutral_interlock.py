"""The neutral interlock: a stick that was held while the robot stopped must be heard at zero before it counts again.

A pause is never taken for zero: a link that froze, a program that hung and a hand that let go all fall silent alike.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from bridge.core.codes import Code
from robotside.core.notice import Notice

__all__ = ["LET_GO_SENTENCE", "NeutralInterlock"]

LET_GO_SENTENCE = Notice(
    Code.DRIVE_NOT_RELEASED,
    "Stopped while the stick was held. Release it (send zero), then push it again.",
)


@dataclass(slots=True)
class _Push:
    """A stick from leaving its rest to coming back to it."""

    given: float
    """When its newest command was given [s]."""
    due: float = math.inf
    """When the next one has to have come [s]."""
    void: bool = False


class NeutralInterlock:
    """The sticks that are pushed now, by the ids of their clients' connections."""

    def __init__(self) -> None:
        self._pushes: dict[str, _Push] = {}

    def on_command(self, client: str, moving: bool, given: float, now: float) -> bool:
        """A command came that was `given` at that time [s], `moving` or of zero; True when its stick counts."""
        push = self._pushes.get(client)
        given = min(given, now)
        if not moving:
            if push is not None and given >= push.given:
                del self._pushes[client]
            return True
        if push is None:
            push = self._pushes[client] = _Push(given)
        push.given = max(push.given, given)
        push.void = push.void or now >= push.due
        return not push.void

    def obey(self, client: str, due: float) -> None:
        """The command that was heard last moves the robot; unless the next one has come when it is `due` [s], the stick is void.

        That holds even if nobody looked meanwhile: this process may have been frozen.
        """
        if client in self._pushes:
            self._pushes[client].due = due

    def void(self, client: str) -> None:
        """This stick, if it is pushed, no longer counts until it is heard at zero."""
        if client in self._pushes:
            self._pushes[client].void = True

    def void_all(self) -> None:
        """The robot was stopped by something else than its stick."""
        for push in self._pushes.values():
            push.void = True

    def forget(self, client: str) -> None:
        """A connection ended."""
        self._pushes.pop(client, None)
