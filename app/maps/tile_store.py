"""Tiles that were fetched, in one file of bounded size; what was not looked at for longest makes room.

Every method may be called from any thread. A file that is damaged is begun anew: it holds nothing that cannot be fetched again.
"""

from __future__ import annotations

import contextlib
import logging
import sqlite3
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from widgets.core.language import tr
from widgets.map.tiles.tile_reader import Key

__all__ = ["LOOKED_PERIOD", "Stored", "TileStore"]

log = logging.getLogger(__name__)

LOOKED_PERIOD = 3600.0
"""How exactly it is remembered when a tile was last looked at [s]: each note of it is a write."""
SPARE = 0.9
"""When it is full, the oldest go until this share of the limit is left."""
BUSY_TIMEOUT = 2.0
"""How long another process may hold the file [s]."""
VERSION = 1
TABLES = """
CREATE TABLE IF NOT EXISTS tiles (source TEXT, zoom INT, x INT, y INT, data BLOB, etag TEXT, modified TEXT,
  expires REAL, looked REAL, size INT, PRIMARY KEY (source, zoom, x, y)) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS by_look ON tiles (looked);
"""


@dataclass(frozen=True, slots=True)
class Stored:
    """A tile as it was fetched."""

    data: bytes | None
    """The picture's file; None where the server has none."""
    etag: str = ""
    modified: str = ""
    """The server's `ETag` and `Last-Modified`; empty for none."""
    expires: float = 0.0
    """Until when it need not be asked for again [s], by the system's clock."""


class TileStore:
    """One file, opened when it is first needed. Where it cannot be opened, nothing is kept and `problem` says so."""

    def __init__(self, path: Path, limit: int) -> None:
        """`limit` is in bytes of pictures."""
        self.path, self._limit = path, limit
        self.problem = ""
        """Why nothing is kept, in one sentence; empty when all is well."""
        self._lock = threading.Lock()
        self._file: sqlite3.Connection | None = None
        self._size = 0
        self._closed = False

    @property
    def size(self) -> int:
        """Bytes of pictures in it."""
        with self._lock:
            self._open()
            return self._size

    def get(self, source: str, tile: Key, now: float) -> Stored | None:
        """What is kept of that tile, however old; None for nothing."""
        with self._lock:
            row = self._ask(
                "SELECT data, etag, modified, expires, looked FROM tiles WHERE source=? AND zoom=? AND x=? AND y=?",
                (source, *tile),
            )
            if not row:
                return None
            data, etag, modified, expires, looked = row[0]
            if abs(now - looked) > LOOKED_PERIOD:
                self._ask(
                    "UPDATE tiles SET looked=? WHERE source=? AND zoom=? AND x=? AND y=?",
                    (now, source, *tile),
                )
            return Stored(data, etag, modified, expires)

    def put(self, source: str, tile: Key, stored: Stored, now: float) -> None:
        """Keep it, in place of what was kept of that tile."""
        size = len(stored.data or b"")
        with self._lock:
            if size > self._limit:
                return
            self._delete("source=? AND zoom=? AND x=? AND y=?", (source, *tile))
            self._ask(
                "INSERT INTO tiles VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (source, *tile, stored.data, stored.etag, stored.modified, stored.expires, now, size),
            )
            self._size += size
            self._make_room()

    def set_limit(self, limit: int) -> None:
        """Keep no more than so many bytes of pictures."""
        with self._lock:
            self._limit = limit
            self._make_room()

    def clear(self, source: str = "") -> None:
        """Forget the tiles of that source, or all."""
        with self._lock:
            self._delete("source=?", (source,)) if source else self._delete("1=1", ())
            self._ask("PRAGMA incremental_vacuum", ())

    def close(self) -> None:
        """Close the file; what comes later is neither found nor kept."""
        with self._lock:
            self._closed = True
            if self._file is not None:
                self._file.close()
                self._file = None

    def _make_room(self) -> None:
        if self._size <= self._limit:
            return
        while self._size > SPARE * self._limit:
            oldest = self._ask(
                "SELECT source, zoom, x, y FROM tiles WHERE size > 0 ORDER BY looked LIMIT 64", ()
            )
            if not oldest:
                return
            for row in oldest:
                if self._size <= SPARE * self._limit:
                    break
                self._delete("source=? AND zoom=? AND x=? AND y=?", row)
        self._ask("PRAGMA incremental_vacuum", ())

    def _delete(self, where: str, values: tuple[object, ...]) -> None:
        """`where` is one of this file's own."""
        row = self._ask(f"SELECT COALESCE(SUM(size), 0) FROM tiles WHERE {where}", values)  # noqa: S608
        if row and self._ask(f"DELETE FROM tiles WHERE {where}", values) is not None:  # noqa: S608
            self._size -= row[0][0]

    def _ask(self, statement: str, values: tuple[object, ...]) -> list[tuple[Any, ...]] | None:
        """Rows; None where the file cannot be used."""
        file = self._open()
        if file is None:
            return None
        try:
            return file.execute(statement, values).fetchall()
        except (
            sqlite3.OperationalError
        ) as fault:  # the disk is full or the file is locked: what is kept stays
            log.warning("%s: %s", self.path, fault)
            return None
        except sqlite3.DatabaseError as fault:
            log.warning("%s: %s", self.path, fault)
            self._begin_anew(fault)
            return None

    def _open(self) -> sqlite3.Connection | None:
        if self._file is not None or self._closed or self.problem:
            return self._file
        try:
            self._file = self._connect()
        except (sqlite3.Error, OSError) as fault:
            self._begin_anew(fault)
        return self._file

    def _connect(self) -> sqlite3.Connection:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        file = sqlite3.connect(self.path, timeout=BUSY_TIMEOUT, isolation_level=None, check_same_thread=False)
        try:
            file.execute("PRAGMA auto_vacuum=INCREMENTAL")
            file.execute("PRAGMA journal_mode=WAL")
            file.execute("PRAGMA synchronous=NORMAL")
            (version,) = file.execute("PRAGMA user_version").fetchone()
            if version not in (0, VERSION):
                raise sqlite3.DatabaseError(
                    tr("version {version} of the file is not known").format(version=version)
                )
            file.executescript(TABLES)
            file.execute(f"PRAGMA user_version={VERSION}")
            (self._size,) = file.execute("SELECT COALESCE(SUM(size), 0) FROM tiles").fetchone()
        except sqlite3.Error:
            file.close()
            raise
        return file

    def _begin_anew(self, fault: Exception) -> None:
        """A damaged file is deleted, once; where that does not help, nothing is kept."""
        if self._file is not None:
            self._file.close()
            self._file = None
        log.warning("the tiles that were kept are forgotten: %s: %s", self.path, fault)
        self._size = 0
        try:
            for name in (self.path, *(self.path.with_name(self.path.name + end) for end in ("-wal", "-shm"))):
                with contextlib.suppress(FileNotFoundError):
                    name.unlink()
            self._file = self._connect()
        except (sqlite3.Error, OSError) as second:
            self.problem = tr("Tiles of maps cannot be kept: {second}.").format(second=second)
            log.warning("%s", self.problem)
