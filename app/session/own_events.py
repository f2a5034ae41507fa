"""What a robot calls this handheld in its sentences, and which of them are about it.

Two handhelds may have one name: a robot calls the second of them `tablet (2)`. What is said of a name that this one is
not known to have is left as the robot says it. A STOP that was guessed from a gesture or a word is told with what gave it,
so that a false one is known from a finger's.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import msgspec

from bridge.msgs.pilothouse_msgs import ControlStatus, Event, TaskStatus

__all__ = ["OwnName"]

PATIENCE = 1.0
"""What happened so long before this handheld came is not about it [s]: clocks differ a little."""

SAYS = {
    "{} has control.": "You have control.",
    "STOP pressed by {}.": "You pressed STOP.",
    "STOP released by {}.": "You released STOP.",
    "Stopped by {}.": "STOP paused the task.",
    "Paused by {}.": "You paused.",
    "Canceled by {}.": "You canceled it.",
    "Discarded by {}.": "You discarded it.",
}
"""A robot's sentence about somebody, and what is said to the one whom it is about."""
PRESSED_STOP = "STOP pressed by {}."


class OwnName:
    """The name of one handheld at one robot. Everything here happens in the UI thread."""

    def __init__(self, client_id: str, client_name: str, now: Callable[[], float]) -> None:
        """`client_name` is what it calls itself; `now` is our clock [s]."""
        self._id, self._now, self._since = client_id, now, now()
        name = rf"{re.escape(client_name)}(?: \(\d+\))?"
        self._like = {
            re.compile(re.escape(said).replace(re.escape("{}"), f"({name})")): words
            for said, words in SAYS.items()
            if client_name
        }
        self.known = ""
        """What the robot calls it; empty until that is known."""

    def hear(self, status: ControlStatus) -> None:
        """The robot names who has control and who asks for it, with their ids."""
        for client_id, name in (
            (status.driver_id, status.driver),
            (status.requested_by_id, status.requested_by),
        ):
            if client_id == self._id and name:
                self.known = name

    def undecided(self, event: Event, clock: float) -> bool:
        """Whether `event` may be about it, which the robot's next word of control tells; `clock` as in `said`."""
        return not self.known and event.kind == "control" and self._words(event, clock) is not None

    def said(self, event: Event, clock: float, *, asked: bool = False, how: str = "") -> Event:
        """`event` as it is told here, by the operators' `clock` [s].

        `asked` when this handheld has just asked for that; `how` says what gave its STOP, empty for a hand on a button.
        """
        found = self._words(event, clock)
        if found is None:
            return event
        name, words = found
        mine = name == self.known if self.known else asked
        if mine and how and words == SAYS[PRESSED_STOP]:
            words = how
        if not mine:
            return event
        # the alarm is its STOP, told before; what came of it takes nobody's eye from that
        level = "info" if words == SAYS["Stopped by {}."] else event.level
        return msgspec.structs.replace(event, text=words, level=level)

    def task(self, status: TaskStatus, clock: float) -> TaskStatus:
        """`status` with its reason as it is told here; `clock` as in `said`."""
        found = self._found(status.reason, status.stamp.seconds, clock)
        if found is None or found[0] != self.known:
            return status
        stopped = found[1] == SAYS["Stopped by {}."]
        return msgspec.structs.replace(status, reason=SAYS[PRESSED_STOP] if stopped else found[1])

    def _words(self, event: Event, clock: float) -> tuple[str, str] | None:
        """Of whom it tells, and the words for that one; None when it is surely about another."""
        return self._found(event.text, event.stamp.seconds, clock)

    def _found(self, text: str, stamp: float, clock: float) -> tuple[str, str] | None:
        age = clock - stamp
        if math.isfinite(age) and stamp > 0 and age > self._now() - self._since + PATIENCE:
            return None
        for like, words in self._like.items():
            found = like.fullmatch(text)
            if found is not None:
                return found[1], words
        return None
