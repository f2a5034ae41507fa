"""Expiry of drive commands: those that came late or out of order do not count.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice, Problem
from robotside.core.text import number

__all__ = ["MAX_CLOCK_LEAD", "HOLD_TIME", "MAX_UNSTAMPED_AGE", "VALID_TIME", "CommandExpiry"]

VALID_TIME = 0.3
"""So long after it was given nothing of a drive command is left [s]: the robot has been told to rest."""

HOLD_TIME = 0.25
"""As long after it was given a drive command is in force, and what moves may come [s].

The next look after it comes within a tick (robotside.serving.fleet_server), and a busy computer may take some 30 ms more to look. At
20 Hz it bridges a way of 0.2 s: where the speed has fallen to a crawl anyway.
"""

MAX_CLOCK_LEAD = 1.0
"""A command from further in the future than this comes from a wrong clock [s]."""

MAX_UNSTAMPED_AGE = 0.7
"""A command without a stamp counts when it is certain to be younger than this [s]."""

LEAD_DECAY = 0.02
"""By so much less is a clock taken to be ahead with every second of commands: its owner may set it right [s/s]."""


class CommandExpiry:
    """Judges the commands of all connections by their age and order."""

    def __init__(self) -> None:
        self._newest: dict[str, float] = {}
        self._leads: dict[str, _Lead] = {}

    def given(self, client: Operator, now: float, stamp: float | None) -> float:
        """When a command that has just come was given [s], by the stamp that `fault` was told; now without one.

        What came cannot have been given later than half the quickest way there and back ago. A clock that says so is
        ahead, and what it says is taken for that much older from then on: it may be late all the same.
        """
        if stamp is None or math.isnan(stamp):
            return now
        lead = self._leads.get(client.id)
        return min(stamp - (lead.ahead if lead else 0.0), now)

    def fault(self, client: Operator, now: float, stamp: float | None, *, rest: bool) -> Problem:
        """Why a drive command that has just come does not count, as one sentence; empty when it does.

        `stamp` is when it was given [s]; None and NaN when that is not known: then it counts as old as it can be at most. `rest`
        is for a command of zero, which without a stamp is as right late as in time.
        """
        if stamp is None or math.isnan(stamp):
            return "" if rest else _untold(now - client.answered)
        if not client.asked_time:
            said = "its clock was never compared with the robot's"
            said = f"A drive command was dropped: {said}; ask /rosapi/get_time first."
            return Notice(Code.DRIVE_CLOCK_UNKNOWN, said)
        if stamp - now > MAX_CLOCK_LEAD:
            said = f"A drive command was dropped: its clock is {number(stamp - now)} s ahead of the robot's."
            return Notice(Code.DRIVE_CLOCK_AHEAD, said, seconds=stamp - now)
        self._leads.setdefault(client.id, _Lead()).learn(stamp, now, client.rtt)
        allowed, age = VALID_TIME if rest else HOLD_TIME, now - self.given(client, now, stamp)
        if age > allowed:
            late = f"it came {number(age)} s late and has to come within {allowed} s"
            return Notice(Code.DRIVE_LATE, f"A drive command was dropped: {late}.", age=age, allowed=allowed)
        if stamp <= self._newest.get(client.id, -math.inf):
            said = "A drive command was dropped: a newer one came before it."
            return Notice(Code.DRIVE_OVERTAKEN, said)
        self._newest[client.id] = stamp
        return ""

    def forget(self, client: Operator) -> None:
        """A connection ended."""
        self._newest.pop(client.id, None)
        self._leads.pop(client.id, None)


class _Lead:
    """How far a client's clock is ahead of the robot's at least."""

    def __init__(self) -> None:
        self.ahead = 0.0
        """[s]"""
        self._quickest = math.inf
        self._at = math.inf

    def learn(self, stamp: float, now: float, rtt: float) -> None:
        """A command that was stamped so came now over a way there and back of `rtt` [s], NaN when not known."""
        self._quickest = min(self._quickest, rtt)  # which passes NaN over
        way = self._quickest / 2 if self._quickest < math.inf else 0.0
        passed = min(1.0, max(0.0, now - self._at))  # a silence proves nothing
        self.ahead = max(stamp - (now - way), self.ahead - LEAD_DECAY * passed, 0.0)
        self._at = now


def _untold(age: float) -> Problem:
    if age <= MAX_UNSTAMPED_AGE:
        return ""
    may, allowed = f"it has no stamp and may be {number(age)} s old", f"{MAX_UNSTAMPED_AGE} s is allowed"
    if math.isinf(age):
        may = "it has no stamp, and nothing else says how old it is"
    said = f"A drive command was dropped: {may}; {allowed}."
    return Notice(Code.DRIVE_UNSTAMPED, said, age=age, allowed=MAX_UNSTAMPED_AGE)
