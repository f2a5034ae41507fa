"""Records where nothing can be written: what is there is read once, and every change is refused with the reason."""

from __future__ import annotations

import shutil
import tempfile
from contextlib import suppress
from functools import partial
from pathlib import Path

from robotside.records.database.files import DatabaseFiles
from robotside.records.database.rows import Put, empty
from robotside.records.database.sqlite_store import SqliteStore
from robotside.records.database.storage import NotWritten
from robotside.records.database.store import CannotOpen, Opened, Store

__all__ = ["UnkeptStore"]


class UnkeptStore(Store):
    """A SQLite file beside which nothing can be written: a file system that is read-only, a directory of somebody else's."""

    def __init__(self, path: Path, patience: float, why: str) -> None:
        """`why` it is so, as part of a sentence or as one."""
        self._path, self._patience = path, patience
        self._said = (
            f"Nothing can be stored in {str(path.parent)!r} ({why.rstrip('.')}); "
            "mend that and start the robot side again."
        )

    def open(self) -> Opened:
        """What is there, read from a copy, since SQLite reads no file beside which it may not write; else nothing."""
        with suppress(OSError, NotWritten, CannotOpen), tempfile.TemporaryDirectory() as folder:
            return self._read(Path(folder))
        return Opened(empty(), ["What was stored cannot be read, so it starts empty."], 0)

    def write(self, puts: list[Put]) -> None:
        """Raises NotWritten."""
        raise NotWritten(self._said)

    def _read(self, folder: Path) -> Opened:
        for part in ("", "-wal"):
            with suppress(FileNotFoundError):
                shutil.copyfile(f"{self._path}{part}", folder / f"{self._path.name}{part}")
        files = partial(DatabaseFiles, backups_in=self._path.parent / "backups", backups=0)
        store = SqliteStore(folder / self._path.name, files, self._patience)
        try:
            return store.open()
        finally:
            store.close()
