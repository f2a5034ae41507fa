"""The neutral interlock: a stick that was held while the robot was stopped otherwise must come to rest before it counts again.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

from dataclasses import dataclass

from bridge.core.codes import Code
from robotside.core.notice import Notice

__all__ = ["LET_GO_SENTENCE", "NeutralInterlock"]

NEUTRAL_PAUSE = 0.5
"""A stick by which nothing was said for this long was at rest [s]: some clients say nothing while it is."""

STANDSTILL_TIME = 0.7
"""A robot that stands for longer though its stick is pushed has stopped in its driver's eyes [s]; less is a hiccup of the link."""

LET_GO_SENTENCE = Notice(
    Code.DRIVE_NOT_RELEASED,
    "Stopped while the stick was held. Release the stick, then push it again.",
)


@dataclass(slots=True)
class _Push:
    """A stick from leaving its rest to coming back to it."""

    given: float
    """When its newest command was given [s]."""
    obeyed: float
    """When it was obeyed last, or began [s]."""
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
        if push is None or given - push.given >= NEUTRAL_PAUSE:
            push = self._pushes[client] = _Push(given, given)
        push.given = max(push.given, given)
        push.void = push.void or now - push.obeyed > STANDSTILL_TIME
        return not push.void

    def obey(self, client: str, now: float) -> None:
        """The command that was heard last moves the robot."""
        if client in self._pushes:
            self._pushes[client].obeyed = now

    def void(self, client: str) -> None:
        """This stick, if it is pushed, no longer counts until it was at rest."""
        if client in self._pushes:
            self._pushes[client].void = True

    def void_all(self) -> None:
        """The robot was stopped by something else than its stick."""
        for push in self._pushes.values():
            push.void = True

    def forget(self, client: str) -> None:
        """A connection ended."""
        self._pushes.pop(client, None)
