"""Records in a SQLite file, which is mended when it is broken and backed up."""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Callable, Iterable
from pathlib import Path

from sqlalchemy.engine import URL

from robotside.records.database.audit_rows import AUDIT, Audited, read_file, salvage
from robotside.records.database.files import DatabaseFiles, InUse, is_damage, touch
from robotside.records.database.rows import Put
from robotside.records.database.schema import upgrade
from robotside.records.database.storage import NotWritten, Storage, engine_of, not_written
from robotside.records.database.store import CannotOpen, Opened, Store

__all__ = ["SKIPPED_AFTER_RESTORE", "SqliteStore"]

SKIPPED_AFTER_RESTORE = 100_000
"""Numbers of events left out after a backup was restored: some may have been published and are not in it."""


class SqliteStore(Store):
    """One SQLite file."""

    def __init__(self, path: Path, files: Callable[[Path], DatabaseFiles], patience: float) -> None:
        self._patience = patience
        directory = path.parent
        try:
            self._files = files(path)
            self._files.lock()
        except (FileExistsError, NotADirectoryError) as error:
            why = (error.strerror or str(error)).lower()
            said = f"Nothing can be stored in {str(directory)!r}: {why}; --state names another directory."
            raise CannotOpen(said) from error
        except OSError as error:
            raise CannotOpen((error.strerror or str(error)).lower(), around=True) from error
        except InUse:
            said = (
                f"Another robot side keeps its records in {str(directory)!r}; end it or name another --state."
            )
            raise CannotOpen(said) from None
        self._storage: Storage | None = None

    def open(self) -> Opened:
        """Everything it has; broken, what its newest backup has that can be read.

        NotWritten when what is around the file is in the way: a lock, a permission, the disk.
        """
        self._files.tighten()
        try:
            fault = self._files.missing() or self._files.fault()
            return self._mended(fault) if fault else self._read(self.back_up)
        except (CannotOpen, ImportError):
            raise
        except Exception as error:  # a damaged file makes whatever reads it fail in any way
            problem = _around(error)
            if problem is not None:
                raise problem from error
            return self._mended(" ".join(str(error).split()))

    def write(self, puts: list[Put]) -> None:
        """Write rows, all or none."""
        if self._storage is None:
            raise NotWritten("The database is damaged: nothing was stored.", damaged=True)
        try:
            self._storage.write(puts)
        except NotWritten:
            self._check()
            raise
        self._check()

    def _check(self) -> None:
        """NotWritten when what was written just now is nowhere that a restart would look."""
        lost = self._files.lost()
        if lost:
            raise NotWritten(f"The database is damaged ({lost}).", damaged=True)

    def rebuild(self, puts: list[Put]) -> str:
        """Set the broken file aside and write a new one."""
        self._disconnect()
        try:
            aside = self._files.set_aside()
        except OSError as error:
            raise NotWritten(f"The broken database cannot be moved aside: {error.strerror}.") from error
        kept = [Put(AUDIT, row.id, row) for row in salvage(aside)] if aside.exists() else []
        self._connect(_nothing).write([*kept, *puts])
        became = f"damaged and is set aside as {aside.name}" if aside.exists() else "gone"
        return f"The database was {became}; a new one was written, nothing is lost."

    def audit(self) -> Iterable[Audited]:
        """The rows of the audit log, oldest first."""
        try:
            return list(read_file(self._files.path))
        except sqlite3.Error as error:
            raise not_written(error) from error

    def back_up(self) -> None:
        """Copy it beside itself."""
        try:
            self._files.back_up()
        except (OSError, sqlite3.Error) as error:
            raise not_written(error) from error

    def backup_age(self) -> float:
        """Of the newest backup [s]; infinite when there is none, or it is of the future."""
        return self._files.backup_age()

    def close(self) -> None:
        """Let go of the file."""
        self._disconnect()
        self._files.unlock()

    def _read(self, before: Callable[[], object]) -> Opened:
        """Everything in the file; `before` is called before its tables are changed."""
        content, unread = self._connect(before).load()
        return Opened(content, unread, 0)

    def _connect(self, before: Callable[[], object]) -> Storage:
        touch(self._files.path)
        engine = engine_of(URL.create("sqlite", database=str(self._files.path)), self._patience)
        self._storage = Storage(engine)
        upgrade(engine, before)
        self._files.watch()
        return self._storage

    def _mended(self, fault: str) -> Opened:
        """What the newest backup has that can be read, nothing without one, with a sentence about it."""
        self._disconnect()
        try:
            aside = self._files.set_aside()
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            raise NotWritten(
                f"The database is damaged ({fault[:80]}) and cannot be moved aside: {why}."
            ) from error
        became = f"and is set aside as {aside.name}" if aside.exists() else "and nothing is left of it"
        said = f"The database was damaged ({fault[:80]}) {became}"
        backups = self._files.backups()
        for backup in reversed(backups):
            opened = self._restored(backup)
            if opened is not None:
                put = f"the backup {backup.name} was put in its place, what was stored after it is lost."
                return Opened(opened.content, [f"{said}; {put}", *opened.problems], SKIPPED_AFTER_RESTORE)
        opened = self._read(_nothing)
        none = "no backup of it can be read" if backups else "there was no backup"
        return Opened(opened.content, [f"{said}; {none}, so it starts empty."], SKIPPED_AFTER_RESTORE)

    def _restored(self, backup: Path) -> Opened | None:
        """What is in a backup that was put in the place of the database; None when it cannot be read."""
        opened = None
        try:
            self._files.restore(backup)
            # a damaged one is not worth a backup of its own, which would cost an older one
            opened = None if self._files.fault() else self._read(_nothing)
        except Exception as error:  # as in `open`
            problem = _around(error)
            if problem is not None and not os.access(backup, os.R_OK):
                problem = None
            if problem is not None:
                raise problem from error
        finally:
            if opened is None:
                self._disconnect()
                self._files.clear()
        return opened

    def _disconnect(self) -> None:
        if self._storage is not None:
            self._storage.close()
            self._storage = None


def _around(error: Exception) -> NotWritten | None:
    """What is in the way though the file may be whole, as a sentence; None when the file is damaged."""
    if isinstance(error, NotWritten) and error.__cause__ is None:
        return None if error.damaged else error
    cause: BaseException | None = error.__cause__ if isinstance(error, NotWritten) else error
    cause = getattr(cause, "orig", None) or cause
    if cause is None or is_damage(cause):
        return None
    return error if isinstance(error, NotWritten) else not_written(error)


def _nothing() -> None:
    """No backup is made before the tables are changed."""
