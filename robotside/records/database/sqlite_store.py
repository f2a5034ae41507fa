"""Records in a SQLite file, which is mended when it is broken and backed up."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from pathlib import Path

from sqlalchemy.engine import URL

from robotside.records.database.files import DatabaseFiles, InUse
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
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            said = f"Nothing can be stored in {str(directory)!r}: {why}; --state names another directory."
            raise CannotOpen(said) from error
        except InUse:
            said = (
                f"Another robot side keeps its records in {str(directory)!r}; end it or name another --state."
            )
            raise CannotOpen(said) from None
        self._storage: Storage | None = None

    def open(self) -> Opened:
        """Everything it has; broken, what its newest backup has."""
        problems, skip = [], 0
        try:
            fault = self._files.missing() or self._files.fault()
        except sqlite3.Error as error:
            raise not_written(error) from error
        if fault:
            problems.append(self._mend(fault))
            skip = SKIPPED_AFTER_RESTORE
        storage = self._connect()
        content, unread = storage.load()
        return Opened(storage, content, problems + unread, skip)

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
        if self._storage is not None:
            self._storage.close()
            self._storage = None
        try:
            aside = self._files.set_aside()
        except OSError as error:
            raise NotWritten(f"The broken database cannot be moved aside: {error.strerror}.") from error
        self._connect().write(puts)
        became = f"damaged and is set aside as {aside.name}" if aside.exists() else "gone"
        return f"The database was {became}; a new one was written, nothing is lost."

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
        if self._storage is not None:
            self._storage.close()
            self._storage = None
        self._files.unlock()

    def _connect(self) -> Storage:
        engine = engine_of(URL.create("sqlite", database=str(self._files.path)), self._patience)
        self._storage = Storage(engine)
        upgrade(engine, self.back_up)
        self._files.watch()
        return self._storage

    def _mend(self, fault: str) -> str:
        try:
            aside = self._files.set_aside()
            backup = self._files.restore()
        except (OSError, sqlite3.Error) as error:
            raise CannotOpen(
                f"The database is damaged ({fault}) and cannot be moved aside: {error}."
            ) from error
        became = f"and is set aside as {aside.name}" if aside.exists() else "and nothing is left of it"
        said = f"The database was damaged ({fault[:80]}) {became}"
        if backup is None:
            return f"{said}; there was no backup, so it starts empty."
        return f"{said}; the backup {backup.name} was put in its place, what was stored after it is lost."
