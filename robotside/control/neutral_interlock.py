"""The neutral interlock: a stick that was held while the robot stopped must be heard at zero before it counts again.

A pause is never taken for zero: a link that froze, a program that hung and a hand that let go all fall silent alike. A
connection that ends while its stick is pushed is such a pause too: who comes back from there has to be heard at zero.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from bridge.core.codes import Code
from robotside.core.notice import Notice

__all__ = ["LET_GO_SENTENCE", "MAX_REMEMBERED", "MEMORY_TIME", "NeutralInterlock", "Origin"]

LET_GO_SENTENCE = Notice(
    Code.DRIVE_NOT_RELEASED,
    "Stopped while the stick was held. Release it, then push it again.",
)


MEMORY_TIME = 60.0
"""So long it is remembered that a connection ended while its stick was pushed [s]."""
MAX_REMEMBERED = 256
"""As many such connections are remembered."""


class Origin(NamedTuple):
    """Where a client's commands come from, over one connection and the next."""

    host: str
    """Its address, without the port."""
    name: str
    """Its proven identity, else the id it gave itself; empty without one."""

    def may_be(self, other: Origin) -> bool:
        """Both may be one hand: they go by one name, or at least one goes by none and both come from one host."""
        if self.name and other.name:
            return self.name == other.name
        return self.host == other.host


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
        self._left: dict[Origin, float] = {}
        """When the newest command was given [s] of a stick whose connection ended while it was pushed."""

    def on_command(
        self, client: str, moving: bool, given: float, now: float, origin: Callable[[], Origin]
    ) -> bool:
        """A command came that was `given` at that time [s], `moving` or of zero; True when its stick counts.

        `origin` is asked where it came from only when that matters.
        """
        push = self._pushes.get(client)
        given = min(given, now)
        if not moving:
            if push is not None and given >= push.given:
                del self._pushes[client]
            if self._left:
                self._let_go(origin(), given)
            return True
        if push is None:
            push = self._pushes[client] = _Push(
                given, void=bool(self._left) and self._was_left(origin(), now)
            )
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

    def forget(self, client: str, origin: Origin) -> None:
        """A connection ended, that of somebody at `origin`."""
        push = self._pushes.pop(client, None)
        if push is not None:
            self._left.pop(origin, None)
            self._left[origin] = push.given
        while len(self._left) > MAX_REMEMBERED:
            del self._left[next(iter(self._left))]

    def _was_left(self, origin: Origin, now: float) -> bool:
        """Somebody who may be at `origin` went while the stick was pushed, and was not heard at zero since."""
        self._left = {each: given for each, given in self._left.items() if now - given <= MEMORY_TIME}
        return any(each.may_be(origin) for each in self._left)

    def _let_go(self, origin: Origin, given: float) -> None:
        """The stick of who is at `origin` was at zero then."""
        self._left = {
            each: before for each, before in self._left.items() if before > given or not each.may_be(origin)
        }
