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

__all__ = ["MAX_BACKUPS", "LOCK_TIMEOUT", "DatabaseFiles", "InUse", "is_damage", "touch"]

LOCK_TIMEOUT = 5.0
"""The longest wait for another program that has the database [s]."""

MAX_DAMAGED = 3
"""Broken files that are kept for inspection."""
MAX_BACKUPS = 5
"""Backups that are kept: one half are the newest ones, the others the newest of each of the days before."""
_PARTS = ("", "-wal", "-shm", "-journal")
_PRIVATE, _PRIVATE_DIRECTORY = 0o600, 0o700
"""Modes of files and directories that only their owner reads."""
_SURROUNDINGS = frozenset(
    {
        sqlite3.SQLITE_AUTH,
        sqlite3.SQLITE_BUSY,
        sqlite3.SQLITE_CANTOPEN,
        sqlite3.SQLITE_FULL,
        sqlite3.SQLITE_INTERRUPT,
        sqlite3.SQLITE_IOERR,
        sqlite3.SQLITE_LOCKED,
        sqlite3.SQLITE_NOLFS,
        sqlite3.SQLITE_NOMEM,
        sqlite3.SQLITE_PERM,
        sqlite3.SQLITE_PROTOCOL,
        sqlite3.SQLITE_READONLY,
    }
)
"""Errors that are not in the file, but in what is around it."""
_BAD_SECTORS = frozenset(
    {sqlite3.SQLITE_IOERR_READ, sqlite3.SQLITE_IOERR_SHORT_READ, sqlite3.SQLITE_IOERR_CORRUPTFS}
)
"""Errors of the disk that are this file's alone."""
_VERSIONS = slice(18, 20)
"""The bytes of a file by which SQLite tells whether it may write and read it: 1 or 2 each."""


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
        backups_in: Path | None = None,
    ) -> None:
        """`path` is the database, which need not be there; `now` names backups and broken files.

        `patience` [s] is waited for another process that has it; `backups` are kept `backups_in` that directory,
        by default one beside it; 0 makes none.

        Raises OSError when its directory cannot be made.
        """
        path.parent.mkdir(_PRIVATE_DIRECTORY, parents=True, exist_ok=True)
        self.path = path
        """The database."""
        self.backups_in = backups_in or path.parent / "backups"
        """Where its backups are."""
        self._now, self._patience, self._keep = now, patience, backups
        self._lock = -1
        self._used: os.stat_result | None = None

    def lock(self) -> None:
        """Have the records to ourselves until `unlock` or the end of the process, however it ends.

        InUse when another process does not let go of them in time.
        """
        lock = os.open(
            self.path.with_name(f"{self.path.name}.lock"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, _PRIVATE
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
                database.text_factory = _readable
                found = database.execute("PRAGMA integrity_check(1)").fetchone()
        except Exception as error:  # a damaged file makes SQLite and its reader fail in any way
            if is_damage(error):
                return " ".join(str(error).split())
            raise
        if found and found[0] == "ok":
            return _unwritable(path)
        return str(found[0] if found else "nothing found")

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
        for old in self.set_aside_before()[:-MAX_DAMAGED]:
            self.delete(old)
        _sync(self.path.parent)
        return aside

    def set_aside_before(self) -> list[Path]:
        """Broken files that are kept for inspection, oldest first."""
        return sorted(self.path.parent.glob(f"{self.path.stem}-damaged-*.sqlite3"))

    def delete(self, copy: Path) -> None:
        """Delete a backup or a broken file, with all that belongs to it."""
        for part in _PARTS:
            Path(f"{copy}{part}").unlink(missing_ok=True)

    def restore(self, backup: Path) -> None:
        """Put a backup in the place of the database. Raises OSError, or sqlite3.Error when it cannot be read."""
        _copy(backup, self.path)

    def clear(self) -> None:
        """Let go of what `restore` put in the place of the database."""
        self.delete(self.path)

    def tighten(self) -> None:
        """Have nobody else read the files of the database, which older programs let everybody read."""
        for path in (*self.path.parent.glob(f"{self.path.stem}*"), *self.backups()):
            if path.is_file():
                with suppress(OSError):  # somebody else's, who decides
                    path.chmod(_PRIVATE)

    def backups(self) -> list[Path]:
        """All backups, oldest first."""
        return sorted(self.backups_in.glob(f"{self.path.stem}-*.sqlite3"))

    def back_up(self) -> Path | None:
        """Copy the database as it is to a backup while it goes on being used, and let go of old backups.

        None when none are wanted. Raises OSError or sqlite3.Error when that cannot be done; nothing half is left.
        """
        if not self._keep:
            return None
        self.backups_in.mkdir(_PRIVATE_DIRECTORY, exist_ok=True)
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


def touch(path: Path) -> None:
    """Make the file if it is not there, for its owner alone; what SQLite makes beside it is then likewise."""
    os.close(os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, _PRIVATE))


def is_damage(error: BaseException) -> bool:
    """The error is in the file itself, and not in the disk, the lock or the permission around it."""
    if isinstance(error, OSError | MemoryError):
        return False
    code = getattr(error, "sqlite_errorcode", None)
    if code in _BAD_SECTORS:
        return True
    # the low byte is the kind of error, what is above it the circumstances
    return code is None or code & 0xFF not in _SURROUNDINGS


def _unwritable(path: Path) -> str:
    """Why SQLite would never write the file, whoever asks; empty when it would."""
    with path.open("rb") as file:
        versions = file.read(_VERSIONS.stop)[_VERSIONS]
    return "" if all(version in (1, 2) for version in versions) else "its header names no known format"


def _readable(text: bytes) -> str:
    return text.decode(errors="replace")


def _copy(source: Path, target: Path) -> None:
    """Copy a database to a whole file that is on the disk when this returns."""
    target.unlink(missing_ok=True)
    touch(target)
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
