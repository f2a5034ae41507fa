"""Which drive commands are too late to count, and which never were in time.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

import math

from robotside.authority import Operator
from robotside.words import number

__all__ = ["AHEAD", "HELD", "UNSTAMPED", "VALID", "Expiry"]

VALID = 0.3
"""So long after it was given nothing of a drive command is left [s]: the robot has been told to rest."""

HELD = 0.25
"""As long after it was given a drive command is in force, and what moves may come [s].

The next look after it comes within a tick (robotside.serving), and a busy computer may take some 30 ms more to look. At
20 Hz it bridges a way of 0.2 s: where the speed has fallen to a crawl anyway.
"""

AHEAD = 1.0
"""A command from further in the future than this comes from a wrong clock [s]."""

UNSTAMPED = 0.7
"""A command without a stamp counts when it is certain to be younger than this [s]."""


class Expiry:
    """Judges the commands of all connections by their age and order."""

    def __init__(self) -> None:
        self._newest: dict[str, float] = {}

    def fault(self, client: Operator, now: float, stamp: float | None, *, rest: bool) -> str:
        """Why a drive command that has just come does not count, as one sentence; empty when it does.

        `stamp` is when it was given [s]; None and NaN when nobody said: then it is as old as it can be at most. `rest`
        is for a command of zero, which without a stamp is as right late as in time.
        """
        if stamp is None or math.isnan(stamp):
            return "" if rest else _untold(now - client.answered)
        if not client.asked_time:
            said = "its stamp is of a clock that was never compared with the robot's"
            return f"A drive command was dropped: {said}; ask /rosapi/get_time first."
        allowed = VALID if rest else HELD
        if now - stamp > allowed:
            late = f"it came {number(now - stamp)} s late and has to come within {allowed} s"
            return f"A drive command was dropped: {late}."
        if stamp - now > AHEAD:
            return f"A drive command was dropped: its clock is {number(stamp - now)} s ahead of the robot's."
        if stamp <= self._newest.get(client.id, -math.inf):
            return "A drive command was dropped: a newer one came before it."
        self._newest[client.id] = stamp
        return ""

    def forget(self, client: Operator) -> None:
        """A connection ended."""
        self._newest.pop(client.id, None)


def _untold(age: float) -> str:
    if age <= UNSTAMPED:
        return ""
    may, allowed = f"it has no stamp and may be {number(age)} s old", f"{UNSTAMPED} s is allowed"
    return f"A drive command was dropped: {may}; {allowed}."
