"""Whether who asked for something still waits for it: a command of a client that gave up long ago is not carried out."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, MutableMapping
from typing import Any

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.core.notice import Notice
from robotside.gateways.plain.standstills import STALL_TIMEOUT, Standstills

__all__ = ["GONE", "READ", "Presence", "note_presence", "presence_of"]

READ = "pilothouse.read"
"""Key in the state of a request: when it was read, by the loop's clock [s]."""
GONE = "pilothouse.gone"
"""Key in the state of a request: a call that says whether its connection has ended."""
_PRESENCE = "pilothouse.presence"
_SAFE = ("GET", "HEAD", "OPTIONS")
_ROUNDS = 2
"""Rounds of the loop in which the end of a connection is read that came along with the request."""

Scope = MutableMapping[str, Any]


class Presence:
    """One request and its client."""

    def __init__(
        self, standstills: Standstills, read: float, gone: Callable[[], bool], *, changes: bool
    ) -> None:
        """It was `read` then [s]. One that changes nothing always counts."""
        self._standstills, self._read, self._gone, self._changes = standstills, read, gone, changes

    def check(self) -> None:
        """Raises Refused when the request does not count any more."""
        if not self._changes:
            return
        if self._standstills.touches(self._read):
            said = f"Not done: the robot stood still for more than {STALL_TIMEOUT:g} s while this was on its way; ask again."
            raise Refused(Notice(Code.GATEWAY_STALE, said))
        if self._gone():
            raise Refused(Notice(Code.GATEWAY_STALE, "Not done: who asked for it has gone."))

    async def confirm(self) -> None:
        """As `check`, with a look for an end of the connection that came along with the request."""
        for _ in range(_ROUNDS if self._changes else 0):
            await asyncio.sleep(0)
        self.check()


def note_presence(scope: Scope, standstills: Standstills) -> Presence:
    """Put into the state of a request what its applications ask by `presence_of`."""
    state = scope["state"]
    read, gone = state.get(READ, standstills.now()), state.get(GONE, _never)
    made = Presence(standstills, read, gone, changes=scope["method"] not in _SAFE)
    state[_PRESENCE] = made
    return made


def presence_of(scope: Scope) -> Presence:
    """That of a request; to be asked right before anything is done that it wants, but for STOP, which is always pressed."""
    found = scope["state"][_PRESENCE]
    if not isinstance(found, Presence):
        raise TypeError(f"The doorkeeper noted {found!r}.")
    return found


def _never() -> bool:
    return False
