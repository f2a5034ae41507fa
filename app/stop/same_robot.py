"""Addresses of one robot, counted as one.

Two addresses are one robot when both proved the same key, or when neither proved any and both say the same. What is only
said may be a stranger's copy of it: such a group is shown by the address that confirmed least, so that no claim hides a
robot that has not confirmed.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass, replace

__all__ = ["Row", "SameRobots", "Seen"]


@dataclass(frozen=True, slots=True)
class Row:
    """One robot of STOP ALL."""

    url: str
    name: str
    """What people call it, else its address."""
    phase: str
    """As of `stop_state.Verdict`."""
    sentence: str = ""
    foreign: bool = False
    """It has no STOP of its own: zero speed is sent for as long as STOP ALL is held."""
    also: int = 0
    """Other addresses under which it is listed as well; it counts once."""


@dataclass(frozen=True, slots=True)
class Seen:
    """What is known of one address."""

    row: Row
    proven: str = ""
    """Fingerprint of the key that was proved there; empty for none."""
    says: tuple[Hashable, ...] = ()
    """What is said there that tells one robot from another; anybody can say it."""


_CERTAIN = ("released", "moves", "stopped", "sent", "lost", "no_answer")
"""Phases of one robot that proved its key at several addresses: what it says goes before what is not known, the worst first."""
_DOUBTED = ("moves", "no_answer", "lost", "sent", "released", "stopped")
"""Phases of what only says to be one robot: whoever has not confirmed goes before who has."""


class SameRobots:
    """Which addresses lead to one robot; what was one once stays one, for as long as they prove alike."""

    def __init__(self) -> None:
        self._same: dict[str, str] = {}
        """Address to another one of the same robot, which was listed before it."""

    def counted(self, seen: Iterable[Seen]) -> list[Row]:
        """Each robot once, in the order in which they are first listed."""
        listed = list(seen)
        self._note(listed)
        groups: dict[tuple[str, str], list[Row]] = {}
        for one in listed:
            group = ("", one.proven) if one.proven else (self._root(one.row.url), "")
            groups.setdefault(group, []).append(one.row)
        return [_one(rows, _CERTAIN if proven else _DOUBTED) for (_, proven), rows in groups.items()]

    def forget(self) -> None:
        """Nothing is the same any more."""
        self._same.clear()

    def _note(self, listed: list[Seen]) -> None:
        first: dict[Hashable, str] = {}
        for one in listed:
            if one.proven:
                continue  # its key says who it is, and nothing else does
            for mark in filter(None, one.says):
                root, other = self._root(first.setdefault(mark, one.row.url)), self._root(one.row.url)
                if root != other:
                    self._same[other] = root

    def _root(self, url: str) -> str:
        while url in self._same:
            url = self._same[url]
        return url


def _one(rows: list[Row], order: tuple[str, ...]) -> Row:
    best = min(rows, key=lambda row: order.index(row.phase))
    return replace(best, also=len(rows) - 1, foreign=any(row.foreign for row in rows))
