"""The signals that are wanted now, topic by topic: newest wins, none leaves late, and one that is held ends in its rest.

Nothing here knows a socket: the sender asks `SignalSlot.due` what to send, and says by `sent` what left.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass

from bridge.msgs import Msg

__all__ = ["HOLD_PERIOD", "HOLD_TIMEOUT", "ONCE_TIMEOUT", "REST_REPEATS", "SEND_PERIOD", "Due", "SignalSlot"]

SEND_PERIOD = 0.05
"""Least time between two messages of one topic, but before a rest [s]."""
HOLD_PERIOD = 0.1
"""Between two messages of a signal that is held [s]."""
HOLD_TIMEOUT = 0.3
"""A held signal that the user interface has not said again for longer is let go of [s]."""
ONCE_TIMEOUT = 0.5
"""A signal said once that could not leave for longer is dropped [s]."""
REST_REPEATS = 3
"""How often the rest of a held signal is said."""
_INSTANT = 1e-9


@dataclass(frozen=True, slots=True)
class Due:
    """What has to be sent now."""

    topic: str
    msg: Msg
    kind: str
    """`rest`, `held` or `once`."""


@dataclass
class _Line:
    """One topic."""

    once: Msg | None = None
    """To be said once."""
    once_at: float = -math.inf
    held: Msg | None = None
    held_at: float = -math.inf
    rest: Msg | None = None
    """What ends a held signal."""
    blocked: bool = False
    """A held signal was dropped, and the finger on it has not been lifted since."""
    on: bool = False
    """The robot was told the held signal, and no rest since, over this link or one before."""
    rests: int = 0
    """How often the rest is still to be said."""
    sent_at: float = -math.inf


class SignalSlot:
    """What is wanted is set in any thread; `due` and `sent` are for the one that sends."""

    def __init__(self, now: Callable[[], float]) -> None:
        """`now` is our monotonic clock [s]."""
        self._now = now
        self._lock = threading.Lock()
        self._lines: dict[str, _Line] = {}
        self._unsent: set[str] = set()

    def say(self, topic: str, msg: Msg) -> None:
        """Say it once; what is still unsent of that topic is dropped."""
        with self._lock:
            line = self._lines.setdefault(topic, _Line())
            line.once, line.once_at = msg, self._now()

    def hold(self, topic: str, msg: Msg, rest: Msg) -> None:
        """Say it again and again for as long as this is called, then `rest`."""
        with self._lock:
            line = self._lines.setdefault(topic, _Line())
            line.rest, line.held_at = rest, self._now()
            if not line.blocked:
                line.held = msg

    def let_go(self, topic: str) -> None:
        """The finger is lifted: its rest is said, where anything else was; it may be held anew."""
        with self._lock:
            line = self._lines.get(topic)
            if line is not None:
                line.held, line.blocked = None, False

    def drop(self) -> None:
        """Forget everything unsent, as when STOP is pressed or the link is lost: what is held must be pressed anew.

        The rest of what the robot was told is still owed.
        """
        with self._lock:
            for topic, line in self._lines.items():
                self._forget(topic, line)
                self._block(line)

    def take_unsent(self) -> set[str]:
        """Topics of which something to be said once was dropped since this was asked last."""
        with self._lock:
            unsent, self._unsent = self._unsent, set()
        return unsent

    def _forget(self, topic: str, line: _Line) -> None:
        if line.once is not None:
            line.once = None
            self._unsent.add(topic)

    @staticmethod
    def _block(line: _Line) -> None:
        if line.held is not None:
            line.held, line.blocked = None, True

    @property
    def busy(self) -> bool:
        """Something is held, waits, or is owed."""
        with self._lock:
            lines = self._lines.values()
            return any(
                line.on or line.rests or line.held is not None or line.once is not None for line in lines
            )

    def due(self, allowed: Callable[[str, Msg], bool]) -> list[Due]:
        """What has to be sent now. What is not `allowed` is dropped, a held one with a rest, which is right at any time."""
        with self._lock:
            found = [self._due(topic, line, allowed) for topic, line in self._lines.items()]
        return [one for one in found if one is not None]

    def _due(self, topic: str, line: _Line, allowed: Callable[[str, Msg], bool]) -> Due | None:
        now = self._now()
        if line.held is not None and (now - line.held_at > HOLD_TIMEOUT or not allowed(topic, line.held)):
            self._block(line)
        if line.once is not None and (now - line.once_at > ONCE_TIMEOUT or not allowed(topic, line.once)):
            self._forget(topic, line)
        if line.on and line.held is None and not line.rests:
            line.rests = REST_REPEATS
        since = now - line.sent_at + _INSTANT
        if line.rests and line.rest is not None:
            return Due(topic, line.rest, "rest") if line.on or since >= SEND_PERIOD else None
        if line.held is not None:
            return (
                Due(topic, line.held, "held") if since >= (HOLD_PERIOD if line.on else SEND_PERIOD) else None
            )
        return Due(topic, line.once, "once") if line.once is not None and since >= SEND_PERIOD else None

    def sent(self, due: Due) -> None:
        """It has left."""
        with self._lock:
            line = self._lines[due.topic]
            line.sent_at = self._now()
            if due.kind == "rest":
                line.on, line.rests = False, line.rests - 1
            elif due.kind == "held":
                line.on = True
            elif line.once is due.msg:
                line.once = None
