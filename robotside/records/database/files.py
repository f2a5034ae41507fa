"""The SQLite file of the records: its lock, its integrity, its backups."""

from __future__ import annotations

import fcntl
import math
import os
import sqlite3
import time
from collections.abc import Callable
from contextlib import closing, suppress
from datetime import UTC, datetime
from pathlib import Path

__all__ = ["MAX_BACKUPS", "LOCK_TIMEOUT", "DatabaseFiles", "InUse"]

LOCK_TIMEOUT = 5.0
"""The longest wait for another program that has the database [s]."""

MAX_DAMAGED = 3
"""Broken files that are kept for inspection."""
MAX_BACKUPS = 5
"""Backups that are kept: one half are the newest ones, the others the newest of each of the days before."""
_PARTS = ("", "-wal", "-shm", "-journal")


class InUse(Exception):
    """Another process has the records."""


class DatabaseFiles:
    """The records in one file, and what lies beside it."""

    def __init__(
        self,
        path: Path,
        now: Callable[[], float] = time.time,
        patience: float = LOCK_TIMEOUT,
        backups: int = MAX_BACKUPS,
    ) -> None:
        """`path` is the database, which need not be there; `now` names backups and broken files.

        `patience` [s] is waited for another process that has it; `backups` are kept, 0 makes none.

        Raises OSError when its directory cannot be made.
        """
        path.parent.mkdir(parents=True, exist_ok=True)
        self.path = path
        """The database."""
        self.backups_in = path.parent / "backups"
        """Where its backups are."""
        self._now, self._patience, self._keep = now, patience, backups
        self._lock = -1
        self._used: os.stat_result | None = None

    def lock(self) -> None:
        """Have the records to ourselves until `unlock` or the end of the process, however it ends.

        InUse when another process does not let go of them in time.
        """
        lock = os.open(
            self.path.with_name(f"{self.path.name}.lock"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644
        )
        end = time.monotonic() + self._patience
        while True:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                if time.monotonic() > end:
                    os.close(lock)
                    raise InUse from None
                time.sleep(0.05)
            else:
                self._lock = lock
                return

    def unlock(self) -> None:
        """Let others have the records."""
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1

    def fault(self, path: Path | None = None) -> str:
        """The damage of a database, this one by default; empty when it is whole or not there.

        Raises sqlite3.OperationalError when that cannot be found out: it is locked, or may not be read.
        """
        path = path or self.path
        if not path.exists():
            return ""
        try:
            with closing(sqlite3.connect(path, timeout=self._patience)) as database:
                found = database.execute("PRAGMA quick_check(1)").fetchone()
        except sqlite3.OperationalError as error:
            if "malformed" in str(error):
                return str(error)
            raise
        except sqlite3.DatabaseError as error:
            return str(error)
        return "" if found and found[0] == "ok" else str(found[0] if found else "nothing found")

    def missing(self) -> str:
        """Why there is nothing where backups say that there was something; empty when there is, or never was."""
        if not self.backups():
            return ""
        try:
            return "" if self.path.stat().st_size else "it is empty"
        except FileNotFoundError:
            return "it is gone"

    def watch(self) -> None:
        """Note which file is in use from now on."""
        self._used = self.path.stat()

    def lost(self) -> str:
        """The loss of the file in use, with all that was written to it; empty while it is there and whole."""
        try:
            now, log = self.path.stat(), Path(f"{self.path}-wal").stat()
        except FileNotFoundError:
            return "it is gone"
        before, self._used = self._used, now
        if before is None or (now.st_ino, now.st_dev) != (before.st_ino, before.st_dev):
            return "another file is in its place"
        return "it was cut short" if now.st_size < before.st_size or not log.st_size else ""

    def set_aside(self) -> Path:
        """Move the broken database out of the way; returns where it is now."""
        aside = self.path.with_name(f"{self.path.stem}-damaged-{self._stamp()}.sqlite3")
        for part in _PARTS:
            with suppress(FileNotFoundError):
                Path(f"{self.path}{part}").rename(f"{aside}{part}")
        for old in sorted(self.path.parent.glob(f"{self.path.stem}-damaged-*.sqlite3"))[:-MAX_DAMAGED]:
            for part in _PARTS:
                Path(f"{old}{part}").unlink(missing_ok=True)
        _sync(self.path.parent)
        return aside

    def restore(self) -> Path | None:
        """Put the newest backup that is whole in the place of the database; None when there is none."""
        for backup in reversed(self.backups()):
            try:
                if self.fault(backup):
                    continue
            except sqlite3.Error:
                continue
            _copy(backup, self.path)
            return backup
        return None

    def backups(self) -> list[Path]:
        """All backups, oldest first."""
        return sorted(self.backups_in.glob(f"{self.path.stem}-*.sqlite3"))

    def back_up(self) -> Path | None:
        """Copy the database as it is to a backup while it goes on being used, and let go of old backups.

        None when none are wanted. Raises OSError or sqlite3.Error when that cannot be done; nothing half is left.
        """
        if not self._keep:
            return None
        self.backups_in.mkdir(exist_ok=True)
        fresh = self.backups_in / "fresh.new"
        try:
            _copy(self.path, fresh)
            backup = self.backups_in / f"{self.path.stem}-{self._stamp()}.sqlite3"
            fresh.replace(backup)
        finally:
            for part in _PARTS:
                Path(f"{fresh}{part}").unlink(missing_ok=True)
        _sync(self.backups_in)
        self._thin()
        return backup

    def backup_age(self) -> float:
        """Of the newest backup [s]; infinite when there is none, or its time is yet to come."""
        backups = self.backups()
        age = self._now() - backups[-1].stat().st_mtime if backups else math.inf
        return age if age >= 0.0 else math.inf

    def _thin(self) -> None:
        backups = self.backups()
        newest = backups[-((self._keep + 1) // 2) :]
        days = {backup.name.rsplit("-", 2)[0]: backup for backup in backups if backup not in newest}
        older = sorted(days.values())[::-1][: self._keep - len(newest)]
        for backup in set(backups) - {*newest, *older}:
            backup.unlink(missing_ok=True)

    def _stamp(self) -> str:
        return datetime.fromtimestamp(self._now(), UTC).strftime("%Y%m%d-%H%M%S-%f")


def _copy(source: Path, target: Path) -> None:
    """Copy a database to a whole file that is on the disk when this returns."""
    target.unlink(missing_ok=True)
    with (
        closing(sqlite3.connect(source, timeout=LOCK_TIMEOUT)) as old,
        closing(sqlite3.connect(target)) as new,
    ):
        old.backup(new)
        new.execute("PRAGMA journal_mode=DELETE")
    with target.open("rb") as file:
        os.fsync(file.fileno())
    _sync(target.parent)


def _sync(directory: Path) -> None:
    opened = os.open(directory, os.O_RDONLY)
    try:
        os.fsync(opened)
    finally:
        os.close(opened)
