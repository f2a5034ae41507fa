"""The rows in memory: those on the disk, and those on their way there."""

from __future__ import annotations

from collections import deque
from collections.abc import Collection, Iterable

from robotside.records.database.audit_rows import AUDIT, Audited
from robotside.records.database.jobs import Job
from robotside.records.database.rows import Content, Key, Put, rows_of

__all__ = ["RowMemory"]


class RowMemory:
    """Two views of the same rows. A job that fails takes its orders back and leaves its facts to be tried again."""

    def __init__(self, stored: Content) -> None:
        self.stored = stored
        """On the disk."""
        self.current: Content = {
            table: dict(rows) if table != AUDIT else {} for table, rows in stored.items()
        }
        """As they will be when everything was written."""
        self.dirty: set[tuple[str, Key]] = set()
        """Rows of `current` that could not be written."""
        self._pending: deque[Job] = deque()

    @property
    def pending(self) -> int:
        """Jobs that were not tried yet."""
        return len(self._pending)

    def asked(self, tables: Collection[str]) -> bool:
        """An order about one of the `tables` was not tried yet."""
        return any(put.table in tables for job in self._pending for put in job.orders)

    def is_pending(self, table: str, key: Key) -> bool:
        """A change of that row was not tried yet."""
        return any((put.table, put.key) == (table, key) for job in self._pending for put in job.puts)

    def put(self, job: Job) -> None:
        """Note that `job` is on its way; its rows were `apply`n already."""
        self._pending.append(job)

    def apply(self, put: Put) -> None:
        """Have the row in `current`."""
        _set(self.current, put)

    def succeeded(self, job: Job) -> None:
        """The job, the oldest that is pending, is on the disk."""
        self._pending.remove(job)
        for put in job.puts:
            self._written(put)

    def failed(self, job: Job) -> None:
        """The job is not on the disk."""
        if job in self._pending:
            self._pending.remove(job)
        for table, key, _ in job.facts:
            self._owe(table, key)
        later = {(put.table, put.key): put for other in self._pending for put in other.puts}
        for table, key, _ in job.orders:
            if (table, key) not in self.dirty:
                _set(self.current, later.get((table, key)) or Put(table, key, self.stored[table].get(key)))

    def _written(self, put: Put) -> None:
        self.dirty.discard((put.table, put.key))
        if put.table != AUDIT:
            _set(self.stored, put)
            return
        # only what is not on the disk yet is in memory, and the hash of the newest, to which the next one is chained
        if self.current[AUDIT].get(put.key) is put.value:
            del self.current[AUDIT][put.key]
        if isinstance(put.value, Audited) and put.value.id > max(map(int, self.stored[AUDIT]), default=0):
            self.stored[AUDIT] = {put.value.id: put.value.hash}

    def _owe(self, table: str, key: Key) -> None:
        """Have the row tried again; one that came and went without having been on the disk is as it is there."""
        if key in self.current[table] or key in self.stored[table]:
            self.dirty.add((table, key))
        else:
            self.dirty.discard((table, key))

    def again(self) -> list[Put]:
        """The rows to try again, as they are now."""
        return [Put(table, key, self.current[table].get(key)) for table, key in sorted(self.dirty, key=str)]

    def written_anew(self, puts: Iterable[Put]) -> None:
        """The disk has these rows and no others."""
        self.stored = {table: {} for table in self.current}
        for put in puts:
            self._written(put)

    def everything(self) -> list[Put]:
        """All rows as they will be."""
        return rows_of(self.current)


def _set(content: Content, put: Put) -> None:
    if put.value is None:
        content[put.table].pop(put.key, None)
    else:
        content[put.table][put.key] = put.value
