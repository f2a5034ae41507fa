"""The thread that writes to the database: only those who need to know that it is done wait for the disk."""

from __future__ import annotations

import math
import queue
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

from robotside.records.database.jobs import Job
from robotside.records.database.rows import Put
from robotside.records.database.storage import NotWritten, Storage
from robotside.records.database.store import Store

__all__ = ["ImmediateWriter", "CallSoon", "WriterThread"]

CallSoon = Callable[..., object]
"""Has a function called with its arguments in the thread of the records; may be called from any thread."""
OnWritten = Callable[[Job, str], None]
"""Hears of a job why it is not written, empty when it is."""

MAX_WAITING = 500
"""Jobs that may wait to be written."""
MAX_BATCH = 50
"""Jobs that are written in one transaction at most."""
RETRY_PERIOD = 5.0
"""From one try to write what could not be written to the next [s]."""
BACKUP_PERIOD = 3600.0
"""From one backup to the next [s], if anything was written."""
CLOSE_TIMEOUT = 10.0
"""The longest time for the last jobs at the end [s]."""


@dataclass(frozen=True, slots=True)
class _Rebuild:
    puts: list[Put]
    told: Callable[[str, str], None]


class _Nothing(Enum):
    YET = 0


_Work: TypeAlias = tuple[Job, OnWritten] | _Rebuild | None


class WriterThread:
    """Writes in a thread of its own, what waits together in one transaction."""

    def __init__(self, store: Store, call_soon: CallSoon) -> None:
        self.on_idle: Callable[[], None] = lambda: None
        """Called now and then, in the thread of the records."""
        self.on_trouble: Callable[[str], None] = lambda _: None
        """Called with one sentence when a backup could not be made, in the thread of the records."""
        self.on_damage: Callable[[], None] = lambda: None
        """Called when the database turns out to be broken, in the thread of the records."""
        self._store = store
        self._call_soon = call_soon
        self._waiting: queue.Queue[_Work] = queue.Queue(MAX_WAITING)
        self._thread = threading.Thread(target=self._run, name="records", daemon=True)
        self._changed = True
        self._broken = False
        self._held: list[tuple[Job, OnWritten]] = []
        self._next_backup = self._next_retry = -math.inf

    def start(self) -> None:
        """Begin to write."""
        self._thread.start()

    def submit(self, job: Job, told: OnWritten) -> bool:
        """Write `job` when its turn comes; False when too many wait."""
        try:
            self._waiting.put_nowait((job, told))
        except queue.Full:
            return False
        return True

    def rebuild(self, puts: list[Put], told: Callable[[str, str], None]) -> bool:
        """Start fresh with these rows; `told` gets what was done and why it could not be. False when too many wait."""
        try:
            self._waiting.put_nowait(_Rebuild(puts, told))
        except queue.Full:
            return False
        return True

    def close(self) -> None:
        """Write what waits and let go of the database; what takes longer than `CLOSE_TIMEOUT` is given up."""
        try:
            self._waiting.put(None, timeout=CLOSE_TIMEOUT)
        except queue.Full:
            return
        self._thread.join(CLOSE_TIMEOUT)

    def _run(self) -> None:
        ended = False
        self._next_backup = time.monotonic() + BACKUP_PERIOD - self._store.backup_age()
        while not ended:
            ended = self._turn()
        self._store.close()

    def _turn(self) -> bool:
        """Write the waiting jobs; True at the end of the thread."""
        work = self._next(RETRY_PERIOD)
        batch: list[tuple[Job, OnWritten]] = []
        while isinstance(work, tuple):
            batch.append(work)
            work = self._next(0.0) if len(batch) < MAX_BATCH else _Nothing.YET
        if batch and self._broken:
            self._hold(batch)
        elif batch:
            self._write(batch)
        if isinstance(work, _Rebuild):
            self._rebuild(work)
        elif work is None:
            self._give_up_held("The database is damaged: nothing was stored.")
        else:
            self._chores()
        return work is None

    def _next(self, patience: float) -> _Work | _Nothing:
        try:
            return self._waiting.get(timeout=patience) if patience else self._waiting.get_nowait()
        except queue.Empty:
            return _Nothing.YET

    def _chores(self) -> None:
        now = time.monotonic()
        if now >= self._next_retry:
            self._next_retry = now + RETRY_PERIOD
            self._call_back(self.on_damage if self._broken else self.on_idle)
        if self._changed and now >= self._next_backup:
            self._next_backup = now + BACKUP_PERIOD
            self._back_up()

    def _write(self, batch: list[tuple[Job, OnWritten]]) -> None:
        """Write all together; when that fails each alone, so that none suffers for another."""
        try:
            self._store.write([put for job, _ in batch for put in job.puts])
        except NotWritten as problem:
            if len(batch) > 1 and not problem.general:
                for each in batch:
                    self._write([each])
                return
            if problem.damaged:
                self._broken, self._held = True, batch
                self._call_back(self.on_damage)
                return
            said = str(problem)
        else:
            said, self._changed = "", True
        for job, told in batch:
            self._call_back(told, job, said)

    def _rebuild(self, work: _Rebuild) -> None:
        """Start fresh; what was held back is among the rows, since it was handed in before them."""
        if not self._broken:
            return  # asked for twice
        self._broken = False
        try:
            said = self._store.rebuild(work.puts)
        except NotWritten as problem:
            self._give_up_held(str(problem))
            self._call_back(work.told, "", str(problem))
            return
        held, self._held = self._held, []
        for job, told in held:
            self._call_back(told, job, "")
        self._call_back(work.told, said, "")

    def _hold(self, batch: list[tuple[Job, OnWritten]]) -> None:
        if len(self._held) < MAX_WAITING:
            self._held += batch
            return
        for job, told in batch:
            self._call_back(told, job, "The database is damaged: nothing was stored.")

    def _give_up_held(self, said: str) -> None:
        held, self._held = self._held, []
        for job, told in held:
            self._call_back(told, job, said)

    def _back_up(self) -> None:
        try:
            self._store.back_up()
        except NotWritten as problem:
            self._call_back(self.on_trouble, f"The backup could not be made. {problem}")
        else:
            self._changed = False

    def _call_back(self, call: Callable[..., None], *arguments: object) -> None:
        try:
            self._call_soon(call, *arguments)
        except RuntimeError:
            return  # the loop has ended: no one waits any more


class ImmediateWriter:
    """Writes in the caller's step."""

    def __init__(self, storage: Storage) -> None:
        self._storage = storage

    def submit(self, job: Job, told: OnWritten) -> bool:
        """Write `job` and call back."""
        try:
            self._storage.write(job.puts)
        except NotWritten as problem:
            told(job, str(problem))
        else:
            told(job, "")
        return True
