"""The audit log: who did what by which way in, in rows that are only ever added."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable

import msgspec

from robotside.core.text import plain
from robotside.records.database.audit_rows import (
    AUDIT,
    UNPROVEN,
    Audited,
    Erase,
    Prune,
    chained,
    erased,
    first_bad,
)
from robotside.records.ledger import Ledger

__all__ = ["MAX_ROWS", "Audit", "Entry"]

log = logging.getLogger(__name__)

MAX_ROWS = 50_000
"""Rows that are kept; a row before the first of them says so."""
PRUNE_PERIOD = 100
"""From one time that old rows are let go of to the next [rows]."""
MAX_UNWRITTEN = 1000
"""Rows that wait in memory for a disk that fails."""
MAX_TEXT = 200
"""Characters of each text."""


class Entry(msgspec.Struct, frozen=True):
    """Something that somebody did."""

    operation: str
    """What, as in `call /task/start`."""
    outcome: str = "done"
    """`done`, or `refused` with the code of the refusal."""
    person_id: str = ""
    """Public id of who did it; empty when it is not known."""
    name: str = ""
    """The name, for people; one that is not proven says so."""
    role: str = ""
    """The word of the role that it was done with."""
    way: str = ""
    """The gateway."""
    address: str = ""
    """The host that it came from."""
    parameters: str = ""
    """The most important parameters; neither secrets nor where people are."""


class Audit:
    """Adds rows and reads them; nothing that is done ever waits for it or fails by it."""

    def __init__(self, ledger: Ledger, read: Callable[[], Iterable[Audited]]) -> None:
        """`read` gives the rows that are on the disk, oldest first."""
        self._ledger, self._read = ledger, read
        newest = ledger.stored(AUDIT)
        self._number: int = max(newest, default=0)
        self._hash: str = newest.get(self._number, "")
        self._missed, self._failed = 0, False

    def record(self, entry: Entry, stamp: float) -> None:
        """Add a row, in the transaction that is open if one is; `stamp` is when it was [s, operators' clock]."""
        try:
            self._record(entry, stamp)
        except Exception:
            if not self._failed:
                log.exception("The audit log failed at %s", entry.operation)
            self._failed = True

    def _record(self, entry: Entry, stamp: float) -> None:
        if len(self._ledger.rows(AUDIT)) >= MAX_UNWRITTEN:
            self._missed += 1
            return
        with self._ledger.together():
            if self._missed:
                self._add(Entry("audit", f"{self._missed} rows could not be kept"), stamp)
                self._missed = 0
            self._add(entry, stamp)

    def _add(self, entry: Entry, stamp: float) -> None:
        number = self._number + 1
        texts = {key: plain(value, MAX_TEXT) for key, value in msgspec.structs.asdict(entry).items()}
        row = chained(Audited(number, round(stamp * 1e9), **texts), self._hash)
        self._ledger.fact(AUDIT, number, row)
        self._number, self._hash = number, row.hash
        if number > MAX_ROWS and number % PRUNE_PERIOD == 0:
            self._ledger.fact(AUDIT, number - MAX_ROWS, Prune())

    def erase(self, name: str) -> None:
        """Erase a person's name and addresses in all rows; what was done stays, and the chain holds."""
        with self._ledger.together():
            for number, row in list(self._ledger.rows(AUDIT).items()):
                if isinstance(row, Audited) and row.name in (name, name + UNPROVEN):
                    self._ledger.fact(AUDIT, number, erased(row))
            self._ledger.fact(AUDIT, f"erase {name}", Erase(name))

    def rows(self) -> list[Audited]:
        """All rows, oldest first, those too that are not on the disk yet. May be called from any thread, and may take a second."""
        waiting = list(self._ledger.rows(AUDIT).values())
        kept = {row.id: row for row in self._read()}
        kept.update({row.id: row for row in waiting if isinstance(row, Audited)})
        return [kept[number] for number in sorted(kept)]

    def verify(self) -> int | None:
        """The number of the first row that is missing or not as it was written; None when all are whole."""
        rows = self.rows()
        bad = first_bad(rows)
        last = rows[-1].id if rows else 0
        return last + 1 if bad is None and last < self._number else bad
